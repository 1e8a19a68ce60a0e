// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion/clip.h"

namespace motex {

inline bool is_position(Channel channel) { return channel <= Channel::kZPosition; }
inline int axis_of(Channel channel) { return static_cast<int>(channel) % 3; }

/// The joint's own channels and those that its motion needs besides: all positions when a translation leaves the offset
/// on an axis without a channel, all three rotations when one or two angles cannot give some frame's rotation.
std::vector<Channel> channels_for_motion(const Clip& clip, int joint);

/// The angles of a joint's rotation channels from frame to frame, without jumps.
class EulerTrack {
 public:
  explicit EulerTrack(const std::vector<Channel>& channels);
  /// Angles in radians in the order of the rotation channels, nearest to those of the call before (first: to zero).
  /// With one or two rotation channels the rotation must be one that they can give.
  const Vector3& next(const Quat& rotation);

 private:
  int num_angles_ = 0;
  EulerOrder order_;
  Vector3 angles_ = Vector3::Zero();
};

}  // namespace motex
