// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/load_video_clip.h"

#include <algorithm>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

constexpr std::size_t kMostBytes = std::size_t{3} << 29;

bool same_in_all_planes(const Planes& planes) {
  return planes.size() == 1 || (planes[0].values == planes[1].values && planes[1].values == planes[2].values);
}

void check_room(const ClipFrames& clip, const std::filesystem::path& path) {
  const std::size_t frame_bytes = static_cast<std::size_t>(clip.width) * static_cast<std::size_t>(clip.height) * 8;
  if (static_cast<std::size_t>(clip.num_frames()) * frame_bytes <= kMostBytes) return;
  throw InvalidInput(path.string() + ": only " + std::to_string(kMostBytes / frame_bytes) + " frames of " +
                     std::to_string(clip.width) + " × " + std::to_string(clip.height) +
                     " fit into memory; choose a part with --first-frame and --num-frames, or make the video smaller");
}

}  // namespace

ClipFrames load_video_clip(const std::filesystem::path& path, const LoadVideoClipOptions& options,
                           const JobContext& job) {
  check_options(options);
  ReadVideoOptions read;
  if (options.frames_per_sec > 0) read.frames_per_sec = options.frames_per_sec;
  VideoReader reader(path, read, job);
  warn_of_oblong_pixels(reader.info(), job);
  if (options.first_frame > 0) reader.seek(options.first_frame);
  ClipFrames clip;
  clip.width = reader.info().width;
  clip.height = reader.info().height;
  const double rate = options.frames_per_sec > 0 ? options.frames_per_sec : reader.info().frames_per_sec;
  clip.frames_per_sec = rate > 0.01 && rate <= 1000 ? rate : 25;
  const double expected = std::max<double>(
      1, options.num_frames > 0 ? options.num_frames : static_cast<double>(reader.info().num_frames_said));
  bool is_grey = true;
  for (DeepVideoFrame frame;
       (options.num_frames == 0 || clip.num_frames() < options.num_frames) && reader.next(frame);) {
    job.check_cancelled();
    job.progress("reading", std::min(1.0, clip.num_frames() / expected));
    if (frame.planes.size() == 4) frame.planes.pop_back();
    is_grey = is_grey && same_in_all_planes(frame.planes);
    clip.luma.push_back(luma(frame.planes));
    clip.colour.push_back(to_image(frame.planes));
    check_room(clip, path);
  }
  if (clip.num_frames() == 0)
    throw InvalidInput(path.string() + ": has no frame " + std::to_string(options.first_frame) +
                       "; frames count from 0");
  if (is_grey) clip.colour.clear();
  return clip;
}

}  // namespace motex
