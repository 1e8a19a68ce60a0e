// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion/contacts.h"

namespace motex {

/// Horizontal correction d_0 … d_{n−1} of one foot over the frames in sight:
///
///   min Σ_s  hold_s |d_s − d_{s−1} + slide_s|²  +  |d_s|²  +  bend |d_s − 2 d_{s−1} + d_{s−2}|²
///
/// given d_{−1}, d_{−2}: planted feet do not slide, corrections are small and come and go softly. The normal equations
/// have five diagonals; cost about 40 · n operations. No allocation after resize.
class CorrectionSolver {
 public:
  struct Step {
    double hold = 0;                                  ///< 0 where the foot is free
    Eigen::Vector2d slide = Eigen::Vector2d::Zero();  ///< x, z: how far the foot moves into this frame by itself
    bool pinned = false;                              ///< d_s ≈ 0 whatever it costs
  };
  void resize(Index max_steps);
  Step& step(Index s) { return steps_[static_cast<std::size_t>(s)]; }
  /// d_0.
  Eigen::Vector2d solve(Index num_steps, double bend, const Eigen::Vector2d& last, const Eigen::Vector2d& before_last);

 private:
  struct Row {
    double diagonal, next, second;  // A(s, s), A(s, s+1), A(s, s+2)
    Eigen::Vector2d right;
  };
  std::vector<Step> steps_;
  std::vector<Row> rows_;
};

/// A leg of two bones between a moved hip and a moved ankle; the foot keeps its rotation in the world.
struct LegSolution {
  Quat thigh, shank;  ///< in the world
  double missing =
      0;  ///< by how much the ankle's target is farther than the leg reaches; negative: nearer than it bends
  double steepness = 0;  ///< cosine between the leg and the vertical
};
/// pose: before. The knee bends in its own plane, then the whole leg swings the shortest way. Near the straight leg
/// both stretching and bending fade out, so that the knee does not pop; `missing` is what is left for the pelvis to do.
LegSolution solve_leg(const Pose& pose, const Leg& leg, const Vector3& hip_shift, const Vector3& ankle_shift);

}  // namespace motex
