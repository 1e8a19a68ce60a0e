// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/retime.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Catmull–Rom through p0 … p3, u of the way from p1 to p2.
template <typename Value>
Value cubic(const Value& p0, const Value& p1, const Value& p2, const Value& p3, double u) {
  return p1 + 0.5 * u * (p2 - p0 + u * (2 * p0 - 5 * p1 + 4 * p2 - p3 + u * (3 * (p1 - p2) + p3 - p0)));
}

}  // namespace

Clip retime(const Clip& clip, std::span<const double> moments) {
  if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": there is no frame to play");
  Clip out;
  out.name = clip.name;
  out.skeleton = clip.skeleton;
  out.frame_time_secs = clip.frame_time_secs;
  out.translations.resize(std::ssize(moments), clip.translations.cols());
  out.rotations.resize(std::ssize(moments), clip.rotations.cols());
  const Index last = clip.num_frames() - 1;
  for (Index t = 0; t < std::ssize(moments); ++t) {
    const double moment = moments[static_cast<std::size_t>(t)];
    if (!std::isfinite(moment)) throw InvalidInput("moments of a clip must be finite");
    const double at = std::clamp(moment, 0.0, static_cast<double>(last));
    const auto k = static_cast<Index>(at);
    const double u = at - static_cast<double>(k);
    if (u == 0) {
      out.translations.row(t) = clip.translations.row(k);
      out.rotations.row(t) = clip.rotations.row(k);
      continue;
    }
    const bool has_before = k > 0, has_after = k + 2 <= last;  // else it goes on as straight
    const auto translation = [&](Index row) -> Eigen::RowVectorXd { return clip.translations.row(row); };
    const Eigen::RowVectorXd p1 = translation(k), p2 = translation(k + 1);
    const Eigen::RowVectorXd p0 = has_before ? translation(k - 1) : Eigen::RowVectorXd(2 * p1 - p2);
    const Eigen::RowVectorXd p3 = has_after ? translation(k + 2) : Eigen::RowVectorXd(2 * p2 - p1);
    out.translations.row(t) = cubic(p0, p1, p2, p3, u);
    for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
      const Quat here = clip.rotation(k, j);
      const auto from_here = [&](Index row) { return log_map(here.conjugate() * clip.rotation(row, j)); };
      const Vector3 v1 = Vector3::Zero(), v2 = from_here(k + 1);
      const Vector3 v0 = has_before ? from_here(k - 1) : Vector3(-v2),
                    v3 = has_after ? from_here(k + 2) : Vector3(2 * v2);
      out.set_rotation(t, j, (here * exp_map(cubic(v0, v1, v2, v3, u))).normalized());
    }
  }
  return out;
}

Clip play_at_speed(const Clip& clip, double speed) {
  if (!(speed >= 0.01 && speed <= 100)) throw InvalidInput("a clip is played at 0.01 to 100 times its speed");
  if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": there is no frame to play");
  const auto frames = static_cast<Index>(std::floor(static_cast<double>(clip.num_frames() - 1) / speed + 1e-9)) + 1;
  std::vector<double> moments;
  for (Index t = 0; t < frames; ++t) moments.push_back(static_cast<double>(t) * speed);
  return retime(clip, moments);
}

}  // namespace motex
