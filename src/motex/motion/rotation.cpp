// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/rotation.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;

Vector3 axis_vector(int axis) { return Vector3::Unit(axis); }

double near_turn(double angle, double near) { return angle + 2 * kPi * std::round((near - angle) / (2 * kPi)); }

}  // namespace

Quat exp_map(const Vector3& v) {
  const double angle = v.norm();
  // sin(x/2)/x = 1/2 − x²/48 + …
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48 : std::sin(angle / 2) / angle;
  return {std::cos(angle / 2), scale * v.x(), scale * v.y(), scale * v.z()};
}

Vector3 log_map(const Quat& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const Vector3 v = sign * q.vec();
  const double sine = v.norm();
  if (sine < 1e-9) return 2 * v / q.norm();
  return 2 * std::atan2(sine, sign * q.w()) / sine * v;
}

Vector3 log_map_near(const Quat& q, const Vector3& near) {
  const Vector3 v = log_map(q);
  const double angle = v.norm();
  if (angle < 1e-9) {
    // Any axis serves whole turns: take the one of `near`.
    const double turns = std::round(near.norm() / (2 * kPi));
    return turns == 0 ? v : Vector3(near.normalized() * (2 * kPi * turns) + v);
  }
  const Vector3 axis = v / angle;
  return axis * near_turn(angle, axis.dot(near));
}

double angle_between(const Quat& a, const Quat& b) { return log_map(a.conjugate() * b).norm(); }

Quat mean_rotation(const FrameMatrix& quats) {
  const Eigen::Matrix4d moment = quats.transpose() * quats;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(moment);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  return Quat(q[0], q[1], q[2], q[3]).normalized();
}

Quat quat_from_euler(const EulerOrder& order, const Vector3& angles) {
  const auto factor = [&](int i) { return Quat(Eigen::AngleAxisd(angles[i], axis_vector(order.axis[i]))); };
  return factor(0) * factor(1) * factor(2);
}

Vector3 euler_from_quat(const EulerOrder& order, const Quat& q, const Vector3& near) {
  const int i = order.axis[0], j = order.axis[1];
  const bool repeated = order.axis[2] == i;
  const int k = repeated ? 3 - i - j : order.axis[2];
  const double parity = (j - i + 3) % 3 == 1 ? 1 : -1;  // +1 when (i, j, k) is an even permutation
  const Eigen::Matrix3d r = q.toRotationMatrix();
  Vector3 first, second;
  bool locked;
  if (!repeated) {
    // R = R_i(a) R_j(b) R_k(c): r(i,k) = ±sin b.
    const double sine = parity * r(i, k);
    const double cosine = std::hypot(r(i, i), r(i, j));
    locked = cosine < 1e-9;
    first[1] = std::atan2(sine, cosine);
    first[0] = std::atan2(-parity * r(j, k), r(k, k));
    first[2] = std::atan2(-parity * r(i, j), r(i, i));
    second = Vector3(first[0] + kPi, kPi - first[1], first[2] + kPi);
  } else {
    // R = R_i(a) R_j(b) R_i(c): r(i,i) = cos b.
    const double sine = std::hypot(r(i, j), r(i, k));
    locked = sine < 1e-9;
    first[1] = std::atan2(sine, r(i, i));
    first[0] = std::atan2(r(j, i), -parity * r(k, i));
    first[2] = std::atan2(r(i, j), parity * r(i, k));
    second = Vector3(first[0] + kPi, -first[1], first[2] + kPi);
  }
  if (locked) {
    // Only a ± c is determined: keep a, solve for the last factor.
    first[0] = near[0];
    const Quat done =
        Quat(Eigen::AngleAxisd(first[0], axis_vector(i))) * Quat(Eigen::AngleAxisd(first[1], axis_vector(j)));
    const Quat rest = done.conjugate() * q;
    const int last = order.axis[2];
    first[2] = 2 * std::atan2(rest.vec()[last], rest.w());
    second = first;
  }
  for (int a = 0; a < 3; ++a) {
    first[a] = near_turn(first[a], near[a]);
    second[a] = near_turn(second[a], near[a]);
  }
  return (first - near).squaredNorm() <= (second - near).squaredNorm() ? first : second;
}

}  // namespace motex
