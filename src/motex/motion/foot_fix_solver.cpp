// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/foot_fix_solver.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

/// Share of the whole leg from which stretching fades, and which it does not pass.
constexpr double kSoftReach = 0.96, kFullReach = 0.998;

/// The identity up to kSoftReach · length, bent smoothly to stay below kFullReach · length.
double soft_reach(double reach, double length) {
  const double from = kSoftReach * length, room = (kFullReach - kSoftReach) * length;
  return reach <= from ? reach : from + room * -std::expm1(-(reach - from) / room);
}

/// Angle between two bones of lengths a, b whose far ends are c apart; 0 = straight.
double bend_angle(double a, double b, double c) {
  return std::acos(std::clamp((c * c - a * a - b * b) / (2 * a * b), -1.0, 1.0));
}

}  // namespace

void CorrectionSolver::resize(Index max_steps) {
  steps_.resize(static_cast<std::size_t>(max_steps));
  rows_.resize(static_cast<std::size_t>(max_steps));
}

Eigen::Vector2d CorrectionSolver::solve(Index num_steps, double bend, const Eigen::Vector2d& last,
                                        const Eigen::Vector2d& before_last) {
  constexpr double kPin = 1e8;
  const auto n = static_cast<std::size_t>(num_steps);
  for (std::size_t s = 0; s < n; ++s) rows_[s] = {steps_[s].pinned ? kPin : 1, 0, 0, Eigen::Vector2d::Zero()};
  for (std::size_t s = 0; s < n; ++s) {
    const auto& [hold, slide, pinned] = steps_[s];
    Row& row = rows_[s];
    row.diagonal += hold + bend;
    row.right -= hold * slide;
    if (s == 0) {
      row.right += hold * last + bend * (2 * last - before_last);
      continue;
    }
    Row& above = rows_[s - 1];
    above.diagonal += hold + 4 * bend;
    above.next -= hold + 2 * bend;
    above.right += hold * slide;
    if (s == 1) {
      row.right -= bend * last;
      above.right += 2 * bend * last;
      continue;
    }
    Row& second = rows_[s - 2];
    second.diagonal += bend;
    second.next -= 2 * bend;
    second.second += bend;
  }
  // Elimination from the far end, so that d_0 comes out without a second pass.
  for (std::size_t s = n; s-- > 1;) {
    const Row& row = rows_[s];
    const double to_above = rows_[s - 1].next / row.diagonal;
    rows_[s - 1].diagonal -= to_above * rows_[s - 1].next;
    rows_[s - 1].right -= to_above * row.right;
    if (s == 1) break;
    const double to_second = rows_[s - 2].second / row.diagonal;
    rows_[s - 2].diagonal -= to_second * rows_[s - 2].second;
    rows_[s - 2].next -= to_second * rows_[s - 1].next;
    rows_[s - 2].right -= to_second * row.right;
  }
  return rows_[0].right / rows_[0].diagonal;
}

LegSolution solve_leg(const Pose& pose, const Leg& leg, const Vector3& hip_shift, const Vector3& ankle_shift) {
  const Vector3 thigh = pose.positions.col(leg.knee_idx) - pose.positions.col(leg.hip_idx);
  const Vector3 shank = pose.positions.col(leg.ankle_idx) - pose.positions.col(leg.knee_idx);
  const Vector3 target = thigh + shank + ankle_shift - hip_shift;
  const double a = thigh.norm(), b = shank.norm(), now = (thigh + shank).norm(), wanted = target.norm();
  LegSolution solution{pose.rotation(leg.hip_idx), pose.rotation(leg.knee_idx), 0, 0};
  if (a < 1e-9 || b < 1e-9 || now < 1e-9 || wanted < 1e-9) return solution;
  const double reach = std::clamp(now + soft_reach(wanted, a + b) - soft_reach(now, a + b), 1.001 * std::abs(a - b),
                                  std::max(now, (1 - 1e-6) * (a + b)));
  // Nearly straight, the two bones no longer tell the plane in which the knee bends: the usual axis takes over.
  const Vector3 normal = thigh.cross(shank) / (a * b);
  const double lost = std::max(0.0, 1 - normal.norm() / 0.15);
  const Vector3 axis = (normal + 0.05 * lost * lost * (solution.thigh * leg.knee_axis)).normalized();
  const Quat knee_turn(Eigen::AngleAxisd(bend_angle(a, b, reach) - bend_angle(a, b, now), axis));
  const Quat swing = Quat::FromTwoVectors(thigh + knee_turn * shank, target);
  solution.thigh = swing * solution.thigh;
  solution.shank = swing * knee_turn * solution.shank;
  solution.missing = wanted - reach;
  solution.steepness = -target.y() / wanted;
  return solution;
}

}  // namespace motex
