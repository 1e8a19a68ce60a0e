// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/clip_frames.h"

namespace motex {

struct LoadVideoClipOptions {
  int first_frame = 0;
  int num_frames = 0;
  double frames_per_sec = 0;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"first_frame", "frames", "the first frame to use, from 0"}, self.first_frame, Range{0, 1e8});
    visit(Field{"num_frames", "frames", "how many frames to use from there; auto: all"}, self.num_frames,
          Range{1, 1e8, true});
    visit(Field{"frames_per_sec", "frames/s",
                "rate of pictures without times, or another one than the file says; auto: the file's, pictures 25"},
          self.frames_per_sec, Range{0.01, 1000, true});
  }
};

/// Frames of a video (or folder, pattern, TIFF stack: VideoReader) as the particle module wants them; alpha is left
/// out. A video whose frames all are grey has no colour. Throws InvalidInput: missing, no such frames, more than
/// 1.5 GiB of them (says how many fit); and what VideoReader throws.
ClipFrames load_video_clip(const std::filesystem::path& path, const LoadVideoClipOptions& options = {},
                           const JobContext& job = {});

}  // namespace motex
