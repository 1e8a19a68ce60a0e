// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/clip.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {

Clip make_clip(Skeleton skeleton, Index num_frames, double frame_time_secs) {
  check_skeleton(skeleton);
  Clip clip;
  clip.skeleton = std::move(skeleton);
  clip.frame_time_secs = frame_time_secs;
  const int joints = clip.skeleton.num_joints();
  Eigen::RowVectorXd rest_translation(3 * joints), rest_rotation(4 * joints);
  for (int j = 0; j < joints; ++j) {
    rest_translation.segment<3>(3 * j) = clip.skeleton.joints[static_cast<std::size_t>(j)].offset.transpose();
    rest_rotation.segment<4>(4 * j) << 1, 0, 0, 0;
  }
  clip.translations = rest_translation.replicate(num_frames, 1);
  clip.rotations = rest_rotation.replicate(num_frames, 1);
  return clip;
}

void check_clip(const Clip& clip) {
  check_skeleton(clip.skeleton);
  const std::string who = clip.name.empty() ? "the clip" : clip.name;
  const Index joints = clip.skeleton.num_joints();
  if (clip.translations.cols() != 3 * joints || clip.rotations.cols() != 4 * joints ||
      clip.translations.rows() != clip.rotations.rows())
    throw InvalidInput(who + ": the arrays of translations and rotations do not fit the skeleton");
  if (!(clip.frame_time_secs > 0) || !std::isfinite(clip.frame_time_secs))
    throw InvalidInput(who + ": the frame time must be positive");
  if (!clip.translations.allFinite() || !clip.rotations.allFinite())
    throw InvalidInput(who + ": a number is not finite");
  for (Index t = 0; t < clip.num_frames(); ++t)
    for (int j = 0; j < joints; ++j)
      if (std::abs(clip.rotation(t, j).squaredNorm() - 1) > 2e-6)
        throw InvalidInput(who + ": frame " + std::to_string(t) + ", joint " + std::to_string(j) +
                           ": the quaternion is not of unit length");
}

Clip slice(const Clip& clip, Index first, Index count) {
  if (first < 0 || count < 0 || first + count > clip.num_frames())
    throw InvalidInput("frames " + std::to_string(first) + " … " + std::to_string(first + count) + " are not all in " +
                       clip.name + ", which has " + std::to_string(clip.num_frames()));
  Clip out;
  out.name = clip.name;
  out.skeleton = clip.skeleton;
  out.frame_time_secs = clip.frame_time_secs;
  out.translations = clip.translations.middleRows(first, count);
  out.rotations = clip.rotations.middleRows(first, count);
  return out;
}

Clip resample(const Clip& clip, double frame_time_secs) {
  if (!(frame_time_secs > 0) || !std::isfinite(frame_time_secs))
    throw InvalidInput("the new frame time must be positive");
  if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": no frame to resample");
  const double ratio = frame_time_secs / clip.frame_time_secs;
  const double length = static_cast<double>(clip.num_frames() - 1);
  const double last = std::floor(length / ratio + 1e-6);
  if (last > 1e8) throw InvalidInput("the new rate would make more than 100 million frames");
  Clip out;
  out.name = clip.name;
  out.skeleton = clip.skeleton;
  out.frame_time_secs = frame_time_secs;
  const Index frames = static_cast<Index>(last) + 1;
  out.translations.resize(frames, clip.translations.cols());
  out.rotations.resize(frames, clip.rotations.cols());
  for (Index t = 0; t < frames; ++t) {
    const double at = std::min(static_cast<double>(t) * ratio, length);
    const auto a = static_cast<Index>(at);
    const Index b = std::min(a + 1, clip.num_frames() - 1);
    const double w = at - static_cast<double>(a);
    out.translations.row(t) = (1 - w) * clip.translations.row(a) + w * clip.translations.row(b);
    for (int j = 0; j < clip.skeleton.num_joints(); ++j)
      out.set_rotation(t, j, clip.rotation(a, j).slerp(w, clip.rotation(b, j)).normalized());
  }
  return out;
}

void forward_kinematics(const Clip& clip, Index frame, Pose& pose) {
  const int joints = clip.skeleton.num_joints();
  pose.positions.resize(3, joints);
  pose.rotations.resize(4, joints);
  for (int j = 0; j < joints; ++j) {
    const int parent = clip.skeleton.joints[static_cast<std::size_t>(j)].parent_idx;
    if (parent < 0) {
      pose.positions.col(j) = clip.translation(frame, j);
      pose.rotations.col(j) = clip.rotation(frame, j).coeffs();
    } else {
      const Quat above = pose.rotation(parent);
      pose.positions.col(j) = pose.positions.col(parent) + above * clip.translation(frame, j);
      pose.rotations.col(j) = (above * clip.rotation(frame, j)).coeffs();
    }
  }
}

FrameMatrix world_positions(const Clip& clip) {
  const Index joints = clip.skeleton.num_joints();
  const auto& sites = clip.skeleton.end_sites;
  FrameMatrix out(clip.num_frames(), 3 * (joints + static_cast<Index>(sites.size())));
  Pose pose;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    forward_kinematics(clip, t, pose);
    out.row(t).head(3 * joints) = Eigen::Map<const Eigen::RowVectorXd>(pose.positions.data(), 3 * joints);
    for (std::size_t e = 0; e < sites.size(); ++e) {
      const int p = sites[e].parent_idx;
      out.row(t).segment<3>(3 * (joints + static_cast<Index>(e))) =
          (pose.positions.col(p) + pose.rotation(p) * sites[e].offset).transpose();
    }
  }
  return out;
}

}  // namespace motex
