// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/template_match.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "motex/core/wide.h"

namespace motex {
namespace {

constexpr double kApart = 0.6;
constexpr double kRival = 0.2;
constexpr double kFlat = 1e-10;

void normalise(Pattern& pattern) {
  for (Index s = 0; s < pattern.cols(); ++s) {
    const double mean = pattern.col(s).mean();
    pattern.col(s).array() -= mean;
    if (!(pattern.col(s).norm() > kFlat * std::abs(mean))) pattern.col(s).setZero();
  }
  const double norm = pattern.norm();
  if (norm > 0) pattern /= norm;
}

constexpr int kLanes = 4;
constexpr int kVectors = 8;  // half of AVX2's registers
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

/// out[i] += Σ_t weights[t] x[i + t], one t after another.
MOTEX_WIDE void add_products(const double* x, const double* weights, int m, int count, double* out) {
  int first = 0;
  for (; first + kLanes * kVectors <= count; first += kLanes * kVectors) {
    Lanes sum[kVectors];
    std::memcpy(sum, out + first, sizeof sum);
    for (int t = 0; t < m; ++t) {
      const double* from = x + first + t;
      for (int v = 0; v < kVectors; ++v) {
        Lanes y;
        std::memcpy(&y, from + v * kLanes, sizeof y);
        sum[v] += weights[t] * y;
      }
    }
    std::memcpy(out + first, sum, sizeof sum);
  }
  for (; first < count; ++first)
    for (int t = 0; t < m; ++t) out[first] += weights[t] * x[first + t];
}

}  // namespace

int played_length(int rows, double tempo) { return std::max(4, static_cast<int>(std::lround(rows * tempo))); }

Pattern stretched(const Pattern& pattern, int rows) {
  Pattern out(rows, pattern.cols());
  const double step = rows > 1 ? static_cast<double>(pattern.rows() - 1) / (rows - 1) : 0;
  for (int t = 0; t < rows; ++t) {
    const double at = t * step;
    const Index low = std::min<Index>(static_cast<Index>(at), std::max<Index>(0, pattern.rows() - 2));
    const double part = at - static_cast<double>(low);
    out.row(t) = (1 - part) * pattern.row(low) + part * pattern.row(std::min(low + 1, pattern.rows() - 1));
  }
  normalise(out);
  return out;
}

PatternSearch::PatternSearch(const FrameMatrix& series, const std::vector<FrameSpan>& stretches)
    : num_frames_(static_cast<int>(series.rows())), num_signals_(static_cast<int>(series.cols())) {
  const auto size = static_cast<std::size_t>(num_frames_);
  run_end_.assign(size, 0);
  std::vector<FrameSpan> parts = stretches;
  if (parts.empty()) parts.push_back({0, num_frames_});
  for (const FrameSpan& part : parts) {
    int end = part.end();
    for (int frame = part.end() - 1; frame >= part.start; --frame) {
      if (!series.row(frame).allFinite()) end = frame;
      run_end_[static_cast<std::size_t>(frame)] = end;
    }
  }
  for (int s = 0; s < num_signals_; ++s) {
    std::vector<double> x(size), sums(size + 1, 0), squares(size + 1, 0);
    double mean = 0, count = 0;
    for (int t = 0; t < num_frames_; ++t)
      if (std::isfinite(series(t, s))) {
        mean += series(t, s);
        count += 1;
      }
    mean = count > 0 ? mean / count : 0;
    for (std::size_t t = 0; t < size; ++t) {
      const double value = series(static_cast<Index>(t), s);
      x[t] = std::isfinite(value) ? value - mean : 0;
      sums[t + 1] = sums[t] + x[t];
      squares[t + 1] = squares[t] + x[t] * x[t];
    }
    values_.push_back(std::move(x));
    sums_.push_back(std::move(sums));
    squares_.push_back(std::move(squares));
  }
}

bool PatternSearch::whole(int start, int length) const {
  return start >= 0 && start + length <= num_frames_ && start + length <= run_end_[static_cast<std::size_t>(start)];
}

double PatternSearch::amplitude(int start, int length) const {
  const auto a = static_cast<std::size_t>(start), b = static_cast<std::size_t>(start + length);
  double sum = 0;
  for (std::size_t s = 0; s < values_.size(); ++s) {
    const double mean = (sums_[s][b] - sums_[s][a]) / length;
    const double square = (squares_[s][b] - squares_[s][a]) / length;
    const double variance = square - mean * mean;
    if (variance > kFlat * square) sum += variance;
  }
  return std::sqrt(sum);
}

Pattern PatternSearch::pattern(int start, int length, int rows) const {
  Pattern window(length, num_signals_);
  for (int s = 0; s < num_signals_; ++s)
    for (int t = 0; t < length; ++t)
      window(t, s) = values_[static_cast<std::size_t>(s)][static_cast<std::size_t>(start + t)];
  return stretched(window, rows);
}

void PatternSearch::correlate(const Pattern& pattern, std::vector<double>& out) const {
  const int m = static_cast<int>(pattern.rows()), num_windows = num_frames_ - m + 1;
  std::vector<double> weights(static_cast<std::size_t>(m)), dots(static_cast<std::size_t>(num_windows), 0);
  for (int s = 0; s < num_signals_; ++s) {
    for (int t = 0; t < m; ++t) weights[static_cast<std::size_t>(t)] = pattern(t, s);
    add_products(values_[static_cast<std::size_t>(s)].data(), weights.data(), m, num_windows, dots.data());
  }
  const auto known = std::find_if(norms_.begin(), norms_.end(), [m](const Norms& norms) { return norms.length == m; });
  const std::vector<double> computed = known == norms_.end() ? norms(m) : std::vector<double>{};
  const std::vector<double>& norm = known == norms_.end() ? computed : known->values;
  for (std::size_t k = 0; k < dots.size(); ++k) out[k] = norm[k] < 0 ? -1 : norm[k] > 0 ? dots[k] / norm[k] : 0;
}

std::vector<double> PatternSearch::norms(int length) const {
  const double root = std::sqrt(static_cast<double>(length));
  std::vector<double> out;
  for (int start = 0; start + length <= num_frames_; ++start)
    out.push_back(whole(start, length) ? amplitude(start, length) * root : -1);
  return out;
}

void PatternSearch::prepare(int rows) {
  norms_.clear();
  for (const double tempo : kTempos)
    if (const int length = played_length(rows, tempo); length <= num_frames_) norms_.push_back({length, norms(length)});
}

Match PatternSearch::closest(const Pattern& pattern, int middle, int reach) const {
  const int m = static_cast<int>(pattern.rows());
  Match best;
  for (const double tempo : kTempos) {
    const int length = played_length(m, tempo);
    const Pattern played = length == m ? pattern : stretched(pattern, length);
    for (int start = middle - reach - length / 2; start <= middle + reach - length / 2; ++start) {
      if (!whole(start, length)) continue;
      double dot = 0;
      for (int s = 0; s < num_signals_; ++s)
        for (int t = 0; t < length; ++t)
          dot += played(t, s) * values_[static_cast<std::size_t>(s)][static_cast<std::size_t>(start + t)];
      const double own = amplitude(start, length), norm = own * std::sqrt(static_cast<double>(length));
      if (norm > 0 && dot > best.correlation * norm) best = {start, length, dot / norm, own, 0};
    }
  }
  return best;
}

std::vector<Match> PatternSearch::matches(const Pattern& pattern, double least) const {
  const int m = static_cast<int>(pattern.rows());
  std::vector<Match> best(static_cast<std::size_t>(num_frames_));  // by the middle of the window
  std::vector<double> correlation(static_cast<std::size_t>(num_frames_));
  for (std::size_t k = 0; k < kTempos.size(); ++k) {
    const int length = played_length(m, kTempos[k]);
    if (length > num_frames_) continue;
    correlate(length == m ? pattern : stretched(pattern, length), correlation);
    for (int start = 0; start + length <= num_frames_; ++start) {
      Match& match = best[static_cast<std::size_t>(start + length / 2)];
      const double value = correlation[static_cast<std::size_t>(start)];
      if (value > match.correlation) match = {start, length, value, k < kMatchedTempos ? 0.0 : -1.0, 0};
    }
  }
  std::vector<int> peaks;
  for (int c = 0; c < num_frames_; ++c) {
    const double value = best[static_cast<std::size_t>(c)].correlation;
    if (value < least) continue;
    if (c > 0 && best[static_cast<std::size_t>(c - 1)].correlation > value) continue;
    if (c + 1 < num_frames_ && best[static_cast<std::size_t>(c + 1)].correlation > value) continue;
    peaks.push_back(c);
  }
  std::stable_sort(peaks.begin(), peaks.end(), [&](int a, int b) {
    return best[static_cast<std::size_t>(a)].correlation > best[static_cast<std::size_t>(b)].correlation;
  });
  std::vector<unsigned char> taken(static_cast<std::size_t>(num_frames_), 0);
  const int apart = std::max(1, static_cast<int>(kApart * m));
  std::vector<Match> out;
  for (const int c : peaks) {
    if (taken[static_cast<std::size_t>(c)] != 0) continue;
    Match match = best[static_cast<std::size_t>(c)];
    if (match.amplitude >= 0) {
      match.amplitude = amplitude(match.start, match.length);
      for (const int other : peaks)
        if (std::abs(other - c) >= kRival * m && std::abs(other - c) < apart)
          match.rival = std::max(match.rival, best[static_cast<std::size_t>(other)].correlation);
      out.push_back(match);
    }
    std::fill(taken.begin() + std::max(0, c - apart + 1), taken.begin() + std::min(num_frames_, c + apart), 1);
  }
  return out;
}

}  // namespace motex
