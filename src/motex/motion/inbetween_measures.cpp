// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/inbetween_measures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr Index kWindow = 65, kStep = 20, kPlacedBy = 9;

/// Turn about the vertical and shift that bring a pose's joint to the origin with heading 0.
struct Placing {
  Quat turn = Quat::Identity();
  Vector3 origin = Vector3::Zero();
};
Placing placing_of(const Clip& clip, Index frame, int joint) {
  Pose pose;
  forward_kinematics(clip, frame, pose);
  const Quat q = pose.rotation(joint);
  const double heading = 2 * std::atan2(q.y(), q.w());
  return {Quat(std::cos(heading / 2), 0, -std::sin(heading / 2), 0),
          {pose.positions(0, joint), 0, pose.positions(2, joint)}};
}

/// Placed world poses of frames first … first + count − 1.
struct WorldPoses {
  FrameMatrix positions;  ///< count × 3 · joints
  FrameMatrix rotations;  ///< count × 4 · joints: w, x, y, z
};
WorldPoses world_poses(const Clip& clip, Index first, Index count, const Placing& placing) {
  const Index joints = clip.skeleton.num_joints();
  WorldPoses out{FrameMatrix(count, 3 * joints), FrameMatrix(count, 4 * joints)};
  Pose pose;
  for (Index t = 0; t < count; ++t) {
    forward_kinematics(clip, first + t, pose);
    for (int j = 0; j < joints; ++j) {
      const Vector3 p = placing.turn * (Vector3(pose.positions.col(j)) - placing.origin);
      const Quat q = placing.turn * pose.rotation(j);
      out.positions.block<1, 3>(t, 3 * j) = p.transpose();
      out.rotations.block<1, 4>(t, 4 * j) << q.w(), q.x(), q.y(), q.z();
    }
  }
  return out;
}

/// Gives every quaternion of `series` the sign nearer to the one at the same place in `like`.
template <typename Series, typename Like>
void match_signs(Series&& series, const Like& like) {
  for (Index c = 0; c + 4 <= series.cols(); c += 4)
    if (series.template segment<4>(c).dot(like.template segment<4>(c)) < 0) series.template segment<4>(c) *= -1;
}

/// Columns: Σ over t of e^{−2πi k t / n} for each k.
Eigen::MatrixXcd fourier_matrix(Index n) {
  Eigen::MatrixXcd out(n, n);
  for (Index k = 0; k < n; ++k)
    for (Index t = 0; t < n; ++t)
      out(k, t) = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * t % n) / static_cast<double>(n));
  return out;
}

/// Σ_k |Σ_{i ≤ k} (a_i/Σa − b_i/Σb)|; a series without power counts as all in the mean.
double earth_movers_distance(const Vector& a, const Vector& b) {
  const double total_a = a.sum(), total_b = b.sum();
  double distance = 0, way = 0;
  for (Index k = 0; k < a.size(); ++k) {
    way += (total_a > 0 ? a[k] / total_a : k == 0) - (total_b > 0 ? b[k] / total_b : k == 0);
    distance += std::abs(way);
  }
  return distance;
}

void check_gap(const Clip& clip, Index first, Index count) {
  if (first < 1 || count < 1 || first + count >= clip.num_frames())
    throw InvalidInput(clip.name + ": the gap of " + std::to_string(count) + " frames from frame " +
                       std::to_string(first) + " on has no frame on both sides; the clip has " +
                       std::to_string(clip.num_frames()));
}

}  // namespace

Vector window_position_deviations(std::span<const Clip> clips, int travelling_joint) {
  Vector sum, squares;
  double count = 0;
  for (const Clip& clip : clips) {
    if (sum.size() == 0) sum = squares = Vector::Zero(3 * clip.skeleton.num_joints());
    for (Index first = 0; first + kWindow <= clip.num_frames(); first += kStep) {
      const WorldPoses poses = world_poses(clip, first, kWindow, placing_of(clip, first + kPlacedBy, travelling_joint));
      sum += poses.positions.colwise().sum().transpose();
      squares += poses.positions.colwise().squaredNorm().transpose();
      count += kWindow;
    }
  }
  if (count == 0) throw InvalidInput("no clip has " + std::to_string(kWindow) + " frames to measure positions by");
  const Vector variance = (squares / count - (sum / count).cwiseAbs2()).cwiseMax(0);
  const Vector deviation = variance.cwiseSqrt();
  return deviation.cwiseMax(std::max(1e-300, 1e-6 * deviation.maxCoeff()));
}

InbetweenMeasures::InbetweenMeasures(Vector position_deviations, int travelling_joint)
    : deviations_(std::move(position_deviations)), travelling_joint_(travelling_joint) {}

void InbetweenMeasures::add(const Clip& truth, const Clip& made, Index first) {
  const Index count = made.num_frames();
  check_gap(truth, first, count);
  const std::string difference = skeleton_difference(truth.skeleton, made.skeleton);
  if (!difference.empty()) throw InvalidInput(made.name + ": " + difference);
  const Placing placing = placing_of(truth, first - 1, travelling_joint_);
  WorldPoses real = world_poses(truth, first, count, placing), guess = world_poses(made, 0, count, placing);
  for (Index t = 0; t < count; ++t) {
    if (t > 0) match_signs(real.rotations.row(t), real.rotations.row(t - 1));
    match_signs(guess.rotations.row(t), real.rotations.row(t));
    positions_ +=
        ((guess.positions.row(t) - real.positions.row(t)).array() / deviations_.transpose().array()).matrix().norm();
    quaternions_ += (guess.rotations.row(t) - real.rotations.row(t)).norm();
  }
  add_spectra(real.rotations, guess.rotations);
  num_frames_ += count;
  ++num_gaps_;
}

void InbetweenMeasures::add_spectra(const FrameMatrix& truth, const FrameMatrix& made) {
  const Eigen::MatrixXcd fourier = fourier_matrix(truth.rows());
  const Eigen::MatrixXcd real = fourier * truth, guess = fourier * made;
  for (Index c = 0; c < truth.cols(); ++c) {
    const Vector powers[2][2] = {{real.col(c).cwiseAbs2(), guess.col(c).cwiseAbs2()},
                                 {real.col(c).real().cwiseAbs2(), guess.col(c).real().cwiseAbs2()}};
    for (int i = 0; i < 2; ++i) {
      const double power = powers[i][0].sum();
      shifted_power_[i] += power * earth_movers_distance(powers[i][0], powers[i][1]);
      power_[i] += power;
    }
  }
}

InbetweenErrors InbetweenMeasures::errors() const {
  InbetweenErrors out;
  out.num_gaps = num_gaps_;
  if (num_gaps_ == 0) return out;
  out.l2p = positions_ / static_cast<double>(num_frames_);
  out.l2q = quaternions_ / static_cast<double>(num_frames_);
  out.npss = shifted_power_[0] / power_[0];
  out.npss_real = shifted_power_[1] / power_[1];
  return out;
}

Clip interpolate_gap(const Clip& clip, Index first, Index count) {
  check_gap(clip, first, count);
  Clip out = slice(clip, first, count);
  for (Index t = 0; t < count; ++t) {
    const double u = static_cast<double>(t + 1) / static_cast<double>(count + 1);
    out.translations.row(t) = (1 - u) * clip.translations.row(first - 1) + u * clip.translations.row(first + count);
    for (int j = 0; j < clip.skeleton.num_joints(); ++j)
      out.set_rotation(t, j, clip.rotation(first - 1, j).slerp(u, clip.rotation(first + count, j)).normalized());
  }
  return out;
}

Clip hold_gap(const Clip& clip, Index first, Index count) {
  check_gap(clip, first, count);
  Clip out = slice(clip, first, count);
  out.translations = clip.translations.row(first - 1).replicate(count, 1);
  out.rotations = clip.rotations.row(first - 1).replicate(count, 1);
  return out;
}

}  // namespace motex
