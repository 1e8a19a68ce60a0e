// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/particles/clip_frames.h"

namespace motex {

/// How far a picture is moved: what is at (x, y) in the reference is at (x + dx, y + dy) in the frame.
struct Shift {
  double dx = 0, dy = 0;  ///< pixels
};

/// Translation of each frame against the middle one: robust Gauss–Newton on a pyramid (what moves by itself counts
/// little), each frame from where its neighbour was found. Throws InvalidInput.
std::vector<Shift> estimate_shifts(const std::vector<Plane>& frames, const JobContext& job = {});

struct SteadyClip {
  ClipFrames clip;
  bool moved = false;        ///< false: the camera stood still, and the clip is as it was
  int first_frame = 0;       ///< of the clip given, that is frame 0 here
  int left = 0, top = 0;     ///< where the middle frame was cut
  double largest_shift = 0;  ///< pixels, of all frames given
};

/// Takes the motion of the camera out: the longest run of frames whose shifts stay within 1/16 of the picture of one
/// another, each moved back (bicubic), cut to what all of them show. Given back as it is: a clip that does not move by
/// more than a pixel, and one whose frames do not become alike by moving them (water that fills the picture).
SteadyClip steady(const ClipFrames& clip, const JobContext& job = {});

}  // namespace motex
