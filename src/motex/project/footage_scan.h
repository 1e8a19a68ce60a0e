// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/image/image.h"
#include "motex/people/shots.h"
#include "motex/video_io/video_reader.h"

namespace motex {

/// Of one span: up to num_plate_frames() frames for its clean plate, evenly over it.
struct PlateFrames {
  FrameSpan span;
  std::vector<Image> images;
};

/// What one reading of footage tells before it is keyed.
struct FootageScan {
  ShotReport report;
  /// Of each shot; from 0 in the order of their first shots. A shot of four seconds is a scene of its own, a shorter
  /// one belongs to the first scene with its background.
  std::vector<int> scenes;
  PlateFrames plate_frames;  ///< of all that was read, taken as it went by
};

/// Reads `span` of the video once, reduced: for hard cuts (ShotFinder), and whole where a plate's frame lies. Two shots
/// have one background when 60 % of their median previews' pixels, and 80 % near the left, right and upper border,
/// differ by at most 4 grey levels. Frames of the report count as in the video.
FootageScan scan_footage(VideoReader& reader, const FrameSpan& span, const JobContext& job);

/// The same as one shot, without reading.
FootageScan unbroken_footage(const FrameSpan& span);

/// Frames evenly over some spans taken together; those that `kept` has are not read again.
std::vector<Image> frames_for_plate(VideoReader& reader, const std::vector<FrameSpan>& spans, PlateFrames& kept,
                                    const JobContext& job);

}  // namespace motex
