// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/options.h"
#include "motex/motion/clip.h"

namespace motex {

/// What no body can do. Lengths are those of a body that stands 1.7 m where the unit is unknown.
struct GlitchOptions {
  double root_acceleration = 90;
  double joint_acceleration = 650;
  double extend = 0.5;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"root_acceleration", "m/s²", "the body's travel is a glitch above it"}, self.root_acceleration,
          Range{1, 1e9});
    visit(Field{"joint_acceleration", "m/s²", "a joint's movement against the body's travel is a glitch above it"},
          self.joint_acceleration, Range{1, 1e9});
    visit(Field{"extend", "", "frames next to a glitch belong to it above this share of either limit"}, self.extend,
          Range{0, 1});
  }
};

/// Frames, rising, in which the pose jumps as no body can: a pelvis that pops, a limb that flips, a rest pose before
/// the movement. With positions p and h = 1/60 s (or one frame, if that is longer), a frame is one where
///
///   |p(t + h) − 2 p(t) + p(t − h)| / h²
///
/// of the travelling joint, or of any other joint or tip relative to it, exceeds its limit, or exceeds `extend` of it
/// next to such a frame. The limits are absolute, so that a lively dance has no more glitches than a quiet one: the
/// clean half of the salsa stays below 80 and 580 m/s², pops reach several times that.
/// Cost O(frames · joints). Throws InvalidInput for an option out of range.
std::vector<Index> find_glitch_frames(const Clip& clip, const GlitchOptions& options = {});

/// A stretch of frames.
struct FrameRange {
  Index first = 0, count = 0;
};
/// What lies between those frames (rising), in order: stretches of at least min_frames.
std::vector<FrameRange> ranges_without(Index num_frames, std::span<const Index> left_out, Index min_frames = 1);

/// The joint that carries the body: the first whose translation varies in any clip, by more than 1e-4 of its size (at
/// least 1e-4 units). 0 when none does.
int travelling_joint(std::span<const Clip> clips);

}  // namespace motex
