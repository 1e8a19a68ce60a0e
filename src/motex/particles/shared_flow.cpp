// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/shared_flow.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kBin = 0.5;          // pixels
constexpr double kLargestSpeed = 32;  // pixels a frame, unless told otherwise
constexpr int kBlurBins = 2;          // deviation of a displacement: 1 px
constexpr double kSpreadRadius = 5;   // pixels around the peak that belong to it

double extent_of(const std::vector<std::vector<Base>>& frames) {
  double extent = 0;
  for (const auto& frame : frames)
    for (const Base& base : frame) extent = std::max({extent, base.x, base.y});
  return extent;
}

/// Counts of displacements in bins of half a pixel, 2 · half + 1 each way.
class DisplacementHistogram {
 public:
  explicit DisplacementHistogram(double max_speed)
      : half_(static_cast<int>(std::ceil(max_speed / kBin))),
        counts_(static_cast<std::size_t>(size()) * static_cast<std::size_t>(size())) {}

  void count(const std::vector<Base>& from, std::vector<Base> to) {
    const auto by_y = [](const Base& a, const Base& b) { return a.y < b.y; };
    std::sort(to.begin(), to.end(), by_y);
    const double reach = half_ * kBin;
    num_from_ += static_cast<double>(from.size());
    for (const Base& a : from) {
      const auto first =
          std::lower_bound(to.begin(), to.end(), a.y - reach, [](const Base& base, double y) { return base.y < y; });
      for (auto b = first; b != to.end() && b->y <= a.y + reach; ++b)
        if (std::abs(b->x - a.x) <= reach) ++at(bin(b->x - a.x), bin(b->y - a.y));
    }
  }

  /// Binomial smoothing, kBlurBins² / (1/2) times both ways.
  void smooth() {
    std::vector<double> line(static_cast<std::size_t>(size()));
    for (int pass = 0; pass < 2 * kBlurBins * kBlurBins; ++pass)
      for (const bool is_across : {false, true})
        for (int i = 0; i < size(); ++i) {
          const auto cell = [&](int k) -> double& { return is_across ? at(k, i) : at(i, k); };
          for (int k = 0; k < size(); ++k) line[static_cast<std::size_t>(k)] = cell(k);
          for (int k = 0; k < size(); ++k) {
            const double before = k > 0 ? line[static_cast<std::size_t>(k) - 1] : 0;
            const double after = k + 1 < size() ? line[static_cast<std::size_t>(k) + 1] : 0;
            cell(k) = 0.25 * (before + 2 * line[static_cast<std::size_t>(k)] + after);
          }
        }
  }

  FlowEstimate peak() const {
    FlowEstimate out;
    const auto top = std::max_element(counts_.begin(), counts_.end());
    if (top == counts_.end() || *top <= 0) return out;
    std::vector<double> sorted = counts_;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double level = sorted[sorted.size() / 2];
    const auto place = static_cast<int>(top - counts_.begin());
    // A level of a hundredth of a displacement a bin says nothing about its ratio to the peak.
    out.flow.peak_ratio = *top / std::max(level, 0.01);
    out.is_trusted = out.flow.peak_ratio >= kTrustedPeakRatio;
    measure_around(place % size(), place / size(), level, out);
    return out;
  }

 private:
  int size() const { return 2 * half_ + 1; }
  int bin(double displacement) const {
    return std::clamp(static_cast<int>(std::lround(displacement / kBin)) + half_, 0, size() - 1);
  }
  double& at(int x, int y) { return counts_[index(x, y)]; }
  double at(int x, int y) const { return counts_[index(x, y)]; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size()) + static_cast<std::size_t>(x);
  }

  /// Mean and deviation of what rises above the level around the peak.
  void measure_around(int top_x, int top_y, double level, FlowEstimate& out) const {
    double x = top_x, y = top_y;
    const double radius = kSpreadRadius / kBin;
    for (int step = 0; step < 10; ++step) {
      double sum = 0, sx = 0, sy = 0, sxx = 0, syy = 0;
      for (int v = 0; v < size(); ++v)
        for (int u = 0; u < size(); ++u) {
          const double dx = u - x, dy = v - y;
          if (dx * dx + dy * dy > radius * radius) continue;
          const double weight = std::max(0.0, at(u, v) - level);
          sum += weight;
          sx += weight * dx;
          sy += weight * dy;
          sxx += weight * dx * dx;
          syy += weight * dy * dy;
        }
      if (sum <= 0) break;
      out.share = num_from_ > 0 ? sum / num_from_ : 0;
      const double mx = sx / sum, my = sy / sum, blur = kBlurBins * kBlurBins;
      out.spread_x = kBin * std::sqrt(std::max(0.25, sxx / sum - mx * mx - blur));
      out.spread_y = kBin * std::sqrt(std::max(0.25, syy / sum - my * my - blur));
      x += mx;
      y += my;
      if (std::hypot(mx, my) < 0.01) break;
    }
    out.flow.vx = (x - half_) * kBin;
    out.flow.vy = (y - half_) * kBin;
  }

  int half_;
  double num_from_ = 0;
  std::vector<double> counts_;
};

}  // namespace

FlowEstimate estimate_flow(const std::vector<std::vector<Base>>& frames, double max_speed) {
  if (max_speed <= 0) max_speed = std::clamp(0.25 * extent_of(frames), 2.0, kLargestSpeed);
  DisplacementHistogram histogram(max_speed);
  for (std::size_t t = 1; t < frames.size(); ++t) histogram.count(frames[t - 1], frames[t]);
  histogram.smooth();
  return histogram.peak();
}

}  // namespace motex
