// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/core/matrix.h"
#include "motex/motion/skeleton.h"

namespace motex {

/// A skeleton that moves. Rows are frames.
struct Clip {
  std::string name;  ///< file name without folder; for messages and reports
  Skeleton skeleton;
  double frame_time_secs = 1.0 / 60;
  FrameMatrix translations;  ///< frames × 3·joints: x, y, z in the parent's frame (offset where no channel moves it)
  FrameMatrix rotations;     ///< frames × 4·joints: unit quaternion w, x, y, z in the parent's frame

  Index num_frames() const { return rotations.rows(); }
  double frame_rate() const { return 1.0 / frame_time_secs; }
  Vector3 translation(Index frame, int joint) const { return translations.block<1, 3>(frame, 3 * joint).transpose(); }
  void set_translation(Index frame, int joint, const Vector3& t) {
    translations.block<1, 3>(frame, 3 * joint) = t.transpose();
  }
  Quat rotation(Index frame, int joint) const {
    const double* q = &rotations(frame, 4 * joint);
    return {q[0], q[1], q[2], q[3]};
  }
  void set_rotation(Index frame, int joint, const Quat& q) {
    double* out = &rotations(frame, 4 * joint);
    out[0] = q.w(), out[1] = q.x(), out[2] = q.y(), out[3] = q.z();
  }
};

/// A clip of that many frames in the rest pose: translations = offsets, rotations = identity.
Clip make_clip(Skeleton skeleton, Index num_frames, double frame_time_secs);

/// Throws InvalidInput unless sizes agree, numbers are finite, quaternions are unit within 1e-6 and the frame time is
/// positive.
void check_clip(const Clip& clip);

/// Frames first … first + count − 1.
Clip slice(const Clip& clip, Index first, Index count);

/// The clip at another rate: slerp of rotations, linear translations. Frame t of the result is at t · new frame time.
Clip resample(const Clip& clip, double frame_time_secs);

/// World pose of every joint of one frame.
struct Pose {
  Eigen::Matrix<double, 3, Eigen::Dynamic> positions;  ///< 3 × joints
  Eigen::Matrix<double, 4, Eigen::Dynamic> rotations;  ///< 4 × joints, coefficients as Eigen: x, y, z, w
  Quat rotation(int joint) const { return Quat(rotations.col(joint)); }
};
/// Forward kinematics. `pose` is resized once and may be reused. Cost O(joints).
void forward_kinematics(const Clip& clip, Index frame, Pose& pose);

/// World positions of all joints, then of all end sites: frames × 3·(joints + end sites).
FrameMatrix world_positions(const Clip& clip);

}  // namespace motex
