// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/key_video.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "motex/core/error.h"
#include "motex/project/video_outputs.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

constexpr int kBleed = 8;  // pixels

/// Gives transparent pixels along a line the colour of the last one before them that has one, up to kBleed pixels away.
void bleed_along(Rgba* pixel, std::ptrdiff_t step, int count, bool from_opaque) {
  int distance = kBleed;
  Rgba colour{};
  for (int i = 0; i < count; ++i, pixel += step) {
    const bool coloured = (pixel->r | pixel->g | pixel->b) != 0;
    if (pixel->a != 0 || (coloured && !from_opaque))
      colour = *pixel, distance = 0;
    else if (distance++ < kBleed && !coloured)
      *pixel = {colour.r, colour.g, colour.b, 0};
  }
}

void bleed(Image& image, int left, int top, int right, int bottom) {
  for (int y = top; y <= bottom; ++y) {
    bleed_along(&image.at(left, y), 1, right - left + 1, true);
    bleed_along(&image.at(right, y), -1, right - left + 1, true);
  }
  for (int x = left; x <= right; ++x) {
    bleed_along(&image.at(x, top), image.width, bottom - top + 1, false);
    bleed_along(&image.at(x, bottom), -image.width, bottom - top + 1, false);
  }
}

void say_what_was_seen(const fs::path& video, const KeyFootageReport& report, const JobContext& job) {
  if (report.num_empty == report.num_frames)
    throw InvalidInput(video.string() +
                       ": nobody is in it: no frame differs from the background; where an actor stands " +
                       "still throughout give a picture of the empty scene (--plate)");
  if (report.num_crowded > 0)
    job.warn(video.string() + ": in " + std::to_string(report.num_crowded) + " of " +
             std::to_string(report.num_frames) + " frames, the first " + std::to_string(report.first_crowded) +
             ", most of the picture's border differs from the background: the camera moves or the scene changes there");
  if (report.num_empty > 0)
    job.warn(video.string() + ": nobody is in " + std::to_string(report.num_empty) + " of " +
             std::to_string(report.num_frames) + " frames");
}

}  // namespace

void to_straight_image(const Sprite& sprite, int width, int height, Image& image) {
  image = to_image(sprite, width, height);
  if (sprite.empty()) return;
  bleed(image, std::max(0, sprite.left - kBleed), std::max(0, sprite.top - kBleed),
        std::min(width - 1, sprite.left + sprite.width - 1 + kBleed),
        std::min(height - 1, sprite.top + sprite.height - 1 + kBleed));
}

KeyVideoReport key_video(const fs::path& video, const KeyFootageOptions& options, Backdrop* backdrop,
                         const std::vector<fs::path>& outputs, const JobContext& job) {
  KeyedFootage footage(video, options, job.part(0, 0.3));
  const VideoInfo& info = footage.info();
  const double rate = info.frames_per_sec > 0 ? info.frames_per_sec : 25;
  VideoOutputs writers(outputs, info.width, info.height, {rate, backdrop == nullptr, false, info.pixel_aspect}, job);
  KeyVideoReport report;
  report.width = info.width, report.height = info.height;
  Image image;
  for (KeyedFrame frame; footage.next(frame);) {
    job.check_cancelled();
    if (backdrop != nullptr) {
      image = backdrop->frame(frame.idx);
      paint(image, frame.sprite);
    } else {
      to_straight_image(frame.sprite, info.width, info.height, image);
    }
    writers.write(image, frame.time_secs);
    const auto num_frames = static_cast<double>(std::max<std::int64_t>(1, footage.num_frames()));
    job.progress("keying", 0.3 + 0.7 * std::min(1.0, static_cast<double>(frame.idx + 1) / num_frames));
  }
  report.footage = footage.report();
  say_what_was_seen(video, report.footage, job);
  writers.finish();
  report.had_alpha = footage.plate() == nullptr;
  if (footage.plate() != nullptr) report.plate = *footage.plate();
  if (info.has_sound) job.warn(video.string() + ": its sound is left out");
  return report;
}

}  // namespace motex
