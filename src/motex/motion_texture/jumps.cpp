// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motex {
namespace {

constexpr double kJumpWeight = 0.3;

/// Nothing precedes the first instance of a run: the nearest end leads there.
void lead_into_first_instances(const MotionTexture& model, TransitionMatrix& transitions) {
  const auto& all = model.instances;
  for (std::size_t b = 0; b < all.size(); ++b) {
    if (b > 0 && all[b - 1].run_idx == all[b].run_idx) continue;
    double best = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (std::size_t a = 0; a < all.size(); ++a) {
      if (a == b) continue;
      const double distance = key_pose_distance(model.corpus, hand_over_row(model, all[a]), all[b].row);
      if (distance < best) best = distance, nearest = all[a].texton;
    }
    if (nearest >= 0) transitions.add_count(nearest, all[b].texton, kJumpWeight);
  }
}

}  // namespace

Index hand_over_row(const MotionTexture& model, const Instance& instance) {
  const Run& run = model.runs[static_cast<std::size_t>(instance.run_idx)];
  return std::min(instance.row + instance.length, run.row + run.length - 2);
}

double key_pose_distance(const FrameMatrixF& corpus, Index row_a, Index row_b) {
  return std::sqrt(0.5 *
                   static_cast<double>((corpus.middleRows(row_a, 2) - corpus.middleRows(row_b, 2)).squaredNorm()));
}

double usual_jump_distance(const MotionTexture& model) {
  std::vector<double> nearest;
  for (std::size_t a = 0; a < model.instances.size(); ++a) {
    const Index end = hand_over_row(model, model.instances[a]);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < model.instances.size(); ++b)
      if (b != a && b != a + 1) best = std::min(best, key_pose_distance(model.corpus, end, model.instances[b].row));
    if (std::isfinite(best)) nearest.push_back(best);
  }
  if (nearest.empty()) return 1;
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return std::max(*middle, 1e-6);
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
  lead_into_first_instances(model, out);
  return out;
}

}  // namespace motex
