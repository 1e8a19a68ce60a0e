// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/audio/beat_tracking.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "motex/audio/fourier.h"
#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kRate = 100;
constexpr double kWindowSecs = 0.046;
constexpr int kBands = 40;
constexpr double kLowest = 40, kHighest = 8000;  // Hz
constexpr double kUsualTempo = 120, kTempoOctaves = 0.9;
constexpr double kSlowest = 40, kFastest = 240;  // beats a minute
constexpr double kTightness = 100;
constexpr double kLeastSecs = 2;

/// First bin of each band and the end of the last; bands of at least one bin.
std::vector<std::size_t> band_edges(double rate, std::size_t n) {
  std::vector<std::size_t> edges;
  const double highest = std::min(kHighest, 0.5 * rate);
  for (int b = 0; b <= kBands; ++b) {
    const double hz = kLowest * std::pow(highest / kLowest, static_cast<double>(b) / kBands);
    auto bin = static_cast<std::size_t>(std::lround(hz * static_cast<double>(n) / rate));
    if (!edges.empty()) bin = std::max(bin, edges.back() + 1);
    if (bin > n / 2) break;
    edges.push_back(bin);
  }
  return edges;
}

/// Log energies of the bands, a row a moment.
FrameMatrix band_energies(const Sound& sound) {
  const auto length = static_cast<std::size_t>(std::max(8.0, kWindowSecs * sound.rate));
  const std::size_t n = std::bit_ceil(length);
  const std::vector<std::size_t> edges = band_edges(sound.rate, n);
  if (edges.size() < 2) throw InvalidInput("the sound has too low a rate to find beats in");
  std::vector<double> window(length);
  for (std::size_t i = 0; i < length; ++i)
    window[i] =
        0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(length));
  const auto moments = static_cast<Index>(sound.duration_secs() * kRate) + 1;
  FrameMatrix out(moments, static_cast<Index>(edges.size()) - 1);
  const FourierTransform transform(n);
  std::vector<std::complex<double>> values;
  for (Index t = 0; t < moments; ++t) {
    const auto first = std::lround(static_cast<double>(t) * sound.rate / kRate) - static_cast<long>(length / 2);
    values.assign(n, 0);
    for (std::size_t i = 0; i < length; ++i) {
      const long at = first + static_cast<long>(i);
      if (at >= 0 && at < std::ssize(sound.samples))
        values[i] = window[i] * static_cast<double>(sound.samples[static_cast<std::size_t>(at)]);
    }
    transform(values);
    for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
      double energy = 0;
      for (std::size_t k = edges[b]; k < edges[b + 1]; ++k) energy += std::norm(values[k]);
      out(t, static_cast<Index>(b)) = energy;
    }
  }
  const double floor = 1e-12 + 1e-6 * out.maxCoeff();  // 60 dB below the loudest: what is quieter is silence
  return (out.array() + floor).log().matrix();
}

/// Lag of the best weighted autocorrelation, in steps, refined between steps by a parabola.
double find_period(const Vector& onsets) {
  const auto shortest = static_cast<Index>(60 * kRate / kFastest);
  const Index longest = std::min(static_cast<Index>(60 * kRate / kSlowest), onsets.size() / 2);
  Vector scores = Vector::Zero(longest + 2);
  for (Index lag = shortest; lag <= longest + 1 && lag < onsets.size(); ++lag) {
    const double octaves = std::log2(60 * kRate / static_cast<double>(lag) / kUsualTempo);
    scores[lag] = onsets.head(onsets.size() - lag).dot(onsets.tail(onsets.size() - lag)) /
                  static_cast<double>(onsets.size() - lag) * std::exp(-0.5 * std::pow(octaves / kTempoOctaves, 2));
  }
  Index best = 0;
  scores.segment(shortest, longest - shortest + 1).maxCoeff(&best);
  best += shortest;
  const double before = scores[best - 1], here = scores[best], after = scores[best + 1];
  const double bend = before - 2 * here + after;
  const double shift = bend < 0 && best > shortest && best < longest ? 0.5 * (before - after) / bend : 0;
  return static_cast<double>(best) + std::clamp(shift, -0.5, 0.5);
}

/// The moment of a beat between steps: top of the parabola through the onset strength around it.
double refined(const Vector& onsets, Index t) {
  if (t < 1 || t + 1 >= onsets.size()) return static_cast<double>(t);
  const double bend = onsets[t - 1] - 2 * onsets[t] + onsets[t + 1];
  if (bend >= 0) return static_cast<double>(t);
  return static_cast<double>(t) + std::clamp(0.5 * (onsets[t - 1] - onsets[t + 1]) / bend, -0.5, 0.5);
}

}  // namespace

OnsetStrength onset_strength(const Sound& sound) {
  if (!(sound.rate > 0) || sound.duration_secs() < kLeastSecs)
    throw InvalidInput("the sound is shorter than 2 s: no beat can be found in it");
  const FrameMatrix energies = band_energies(sound);
  Vector flux = Vector::Zero(energies.rows());
  for (Index t = 1; t < energies.rows(); ++t) flux[t] = (energies.row(t) - energies.row(t - 1)).cwiseMax(0).sum();
  OnsetStrength out;
  out.rate = kRate;
  out.values.resize(flux.size());
  const auto half = static_cast<Index>(kRate / 2);
  for (Index t = 0; t < flux.size(); ++t) {
    const Index first = std::max<Index>(0, t - half), end = std::min(flux.size(), t + half + 1);
    out.values[t] = flux[t] - flux.segment(first, end - first).mean();
  }
  const double deviation = std::sqrt(out.values.squaredNorm() / static_cast<double>(out.values.size()));
  if (!(deviation > 1e-9)) throw InvalidInput("nothing begins in the sound: no beat can be found in it");
  out.values /= deviation;
  return out;
}

BeatTrack track_beats(const OnsetStrength& onsets) {
  const Vector& o = onsets.values;
  if (static_cast<double>(o.size()) < kLeastSecs * kRate)
    throw InvalidInput("the sound is shorter than 2 s: no beat can be found in it");
  const double period = find_period(o);
  Vector score = o;
  std::vector<Index> before(static_cast<std::size_t>(o.size()), -1);
  for (Index t = 0; t < o.size(); ++t) {
    const auto first = std::max<Index>(0, t - static_cast<Index>(2 * period)), end = t - static_cast<Index>(period / 2);
    double best = 0;
    for (Index p = first; p < end; ++p) {
      const double stretch = std::log(static_cast<double>(t - p) / period);
      const double value = score[p] - kTightness * stretch * stretch;
      if (value > best) best = value, before[static_cast<std::size_t>(t)] = p;
    }
    score[t] += best;
  }
  Index last = 0;
  score.tail(std::min<Index>(o.size(), static_cast<Index>(1.5 * period))).maxCoeff(&last);
  last += std::max<Index>(0, o.size() - static_cast<Index>(1.5 * period));
  std::vector<Index> beats;
  for (Index t = last; t >= 0; t = before[static_cast<std::size_t>(t)]) beats.push_back(t);
  std::reverse(beats.begin(), beats.end());
  double strength = 0;
  for (const Index t : beats) strength += std::max(0.0, o[t]);
  const double weak = 0.25 * strength / static_cast<double>(beats.size());
  while (beats.size() > 1 && o[beats.front()] < weak) beats.erase(beats.begin());
  while (beats.size() > 1 && o[beats.back()] < weak) beats.pop_back();
  BeatTrack out;
  out.tempo_bpm = 60 * onsets.rate / period;
  for (const Index t : beats) out.beat_secs.push_back(refined(o, t) / onsets.rate);
  return out;
}

BeatTrack track_beats(const Sound& sound) { return track_beats(onset_strength(sound)); }

}  // namespace motex
