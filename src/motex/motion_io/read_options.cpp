// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/read_options.h"

#include <algorithm>
#include <cmath>

#include "motex/core/options_check.h"
#include "motex/motion/up_axis.h"

namespace motex {
void apply_read_options(const ReadClipOptions& options, Clip& clip) {
  check_options(options);
  if (options.skip_frames > 0) {
    if (options.skip_frames >= clip.num_frames())
      throw InvalidInput(clip.name + ": skip_frames = " + std::to_string(options.skip_frames) + " leaves none of its " +
                         std::to_string(clip.num_frames()) + " frames");
    clip = slice(clip, options.skip_frames, clip.num_frames() - options.skip_frames);
  }
  if (options.up == UpAxis::kZ) turn_z_up_to_y_up(clip);
  if (options.unit != LengthUnit::kAuto) clip.skeleton.metres_per_unit = metres_per_unit(options.unit);
  if (options.resample > 0 && std::abs(options.resample * clip.frame_time_secs - 1) > 1e-9)
    clip = resample(clip, 1 / options.resample);
}

bool looks_z_up(const Clip& clip) {
  constexpr int kLeastJoints = 10;
  constexpr Index kFrames = 15;
  if (clip.skeleton.num_joints() < kLeastJoints || clip.num_frames() == 0) return false;
  Pose pose;
  Index along_z = 0;
  const Index looked_at = std::min(kFrames, clip.num_frames());
  for (Index k = 0; k < looked_at; ++k) {
    forward_kinematics(clip, k * (clip.num_frames() - 1) / std::max<Index>(1, looked_at - 1), pose);
    const Vector3 extent = pose.positions.rowwise().maxCoeff() - pose.positions.rowwise().minCoeff();
    if (extent.z() > 1.25 * std::max(extent.x(), extent.y())) ++along_z;
  }
  return 2 * along_z > looked_at;
}

}  // namespace motex
