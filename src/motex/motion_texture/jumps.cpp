// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motex {
namespace {

constexpr double kJumpWeight = 0.3;

}  // namespace

Index hand_over_row(const MotionTexture& model, const Instance& instance) {
  const Run& run = model.runs[static_cast<std::size_t>(instance.run_idx)];
  return std::min(instance.row + instance.length, run.row + run.length - 2);
}

double key_pose_distance(const FrameMatrixF& corpus, Index row_a, Index row_b) {
  return std::sqrt(0.5 * static_cast<double>((corpus.middleRows(row_a, 2) - corpus.middleRows(row_b, 2)).squaredNorm()));
}

TransitionMatrix transitions_with_jumps(const MotionTexture& model) {
  TransitionMatrix out(static_cast<int>(model.textons.size()), 0);
  const auto& all = model.instances;
  for (std::size_t a = 0; a < all.size(); ++a) {
    const bool has_successor = a + 1 < all.size() && all[a + 1].run_idx == all[a].run_idx;
    if (has_successor) out.add_count(all[a].texton, all[a + 1].texton);
    const Index end = hand_over_row(model, all[a]);
    double best = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (std::size_t b = 0; b < all.size(); ++b) {
      if (b == a || (has_successor && b == a + 1)) continue;
      const double distance = key_pose_distance(model.corpus, end, all[b].row);
      if (distance < best) best = distance, nearest = all[b].texton;
    }
    if (nearest >= 0) out.add_count(all[a].texton, nearest, kJumpWeight);
  }
  return out;
}

}  // namespace motex
