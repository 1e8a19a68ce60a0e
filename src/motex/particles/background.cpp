// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/background.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr double kLowShare = 0.2;
constexpr double kSmoothSigma = 12;
constexpr std::size_t kFewestForMedian = 5;

void check_sizes(const Planes& frame, const std::vector<Planes>& frames) {
  for (const Planes& other : frames)
    if (other.size() != frame.size() || other.empty() || other[0].width != frame[0].width ||
        other[0].height != frame[0].height)
      throw InvalidInput("the frames of a background must have one size and number of planes");
}

Planes flat(const Planes& frame) {
  Planes out = frame;
  for (Plane& plane : out) {
    double sum = 0;
    for (const float value : plane.values) sum += value;
    plane.values.assign(plane.values.size(), static_cast<float>(sum / static_cast<double>(plane.values.size())));
  }
  return out;
}

Planes smooth(const Planes& frame) {
  Planes out;
  for (const Plane& plane : frame) out.push_back(gaussian_blur(plane, kSmoothSigma));
  return out;
}

double mean_distance(const Planes& a, const Planes& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].values.size(); ++i) sum += std::abs(a[k].values[i] - b[k].values[i]);
  return sum;
}

}  // namespace

Planes quantile_over_time(const std::vector<Planes>& frames, double share) {
  if (frames.empty()) throw InvalidInput("a background needs at least one frame");
  check_sizes(frames[0], frames);
  Planes out = frames[0];
  std::vector<float> column(frames.size());
  const auto place = static_cast<std::ptrdiff_t>(std::floor(share * static_cast<double>(frames.size() - 1) + 0.5));
  for (std::size_t k = 0; k < out.size(); ++k)
    for (std::size_t i = 0; i < out[k].values.size(); ++i) {
      for (std::size_t t = 0; t < frames.size(); ++t) column[t] = frames[t][k].values[i];
      std::nth_element(column.begin(), column.begin() + place, column.end());
      out[k].values[i] = column[static_cast<std::size_t>(place)];
    }
  return out;
}

Planes estimate_background(const Planes& frame, const std::vector<Planes>& frames, BackgroundKind& kind) {
  if (frame.empty() || frame[0].values.empty()) throw InvalidInput("an empty frame has no background");
  check_sizes(frame, frames);
  if (kind == BackgroundKind::kFlat) return flat(frame);
  if (kind == BackgroundKind::kSmooth) return smooth(frame);
  if (kind == BackgroundKind::kMedian) return quantile_over_time(frames, 0.5);
  if (kind == BackgroundKind::kLow) return quantile_over_time(frames, kLowShare);
  kind = BackgroundKind::kSmooth;
  Planes blurred = smooth(frame);
  if (frames.size() < kFewestForMedian) return blurred;
  Planes median = quantile_over_time(frames, 0.5);
  if (mean_distance(frame, blurred) < mean_distance(frame, median)) return blurred;
  kind = BackgroundKind::kMedian;
  return median;
}

const char* name_of(BackgroundKind kind) {
  constexpr const char* kNames[] = {"auto", "median", "low", "smooth", "flat"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace motex
