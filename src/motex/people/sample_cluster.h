// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/flat_colours.h"

namespace motex {

inline float squared_distance(const LevelTriple& a, const LevelTriple& b) {
  const float r = a[0] - b[0], g = a[1] - b[1], blue = a[2] - b[2];
  return r * r + g * g + blue * blue;
}

/// The colour that a pixel shows most often, from samples over time.
class SampleCluster {
 public:
  /// noise: deviation of a channel, grey levels; samples within 4 deviations + 2 levels of one another are one colour.
  explicit SampleCluster(double noise);

  struct Result {
    LevelTriple mean{};
    int count = 0;  ///< of samples in the cluster
  };

  void clear() { samples_.clear(); }
  void add(const LevelTriple& sample) { samples_.push_back(sample); }
  /// The cluster with the most samples; among equals the one whose first sample is earliest. Quadratic cost only where
  /// no colour has a clear majority.
  Result largest() const;

 private:
  Result around(const LevelTriple& centre) const;
  float reach_;  // squared
  std::vector<LevelTriple> samples_;
};

}  // namespace motex
