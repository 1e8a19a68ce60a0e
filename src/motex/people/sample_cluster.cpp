// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/sample_cluster.h"

#include <cstddef>

namespace motex {

SampleCluster::SampleCluster(double noise) {
  const double reach = 4 * noise + 2;
  reach_ = static_cast<float>(reach * reach);
}

SampleCluster::Result SampleCluster::around(const LevelTriple& centre) const {
  Result result;
  LevelTriple sum{};
  for (const LevelTriple& sample : samples_) {
    if (squared_distance(sample, centre) > reach_) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += sample[c];
    ++result.count;
  }
  for (std::size_t c = 0; c < 3 && result.count > 0; ++c) result.mean[c] = sum[c] / static_cast<float>(result.count);
  return result;
}

SampleCluster::Result SampleCluster::largest() const {
  Result best;
  for (const LevelTriple& sample : samples_) {
    const Result found = around(sample);
    if (found.count > best.count) best = found;
    if (static_cast<std::size_t>(best.count) * 5 >= samples_.size() * 3) break;
  }
  // Once more around the mean: the first centre was one noisy sample.
  return best.count == 0 ? best : around(best.mean);
}

}  // namespace motex
