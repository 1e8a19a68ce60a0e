// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/footage_scan.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "motex/people/clean_plate.h"

namespace motex {
namespace {

constexpr int kMostPreviews = 1500;      // kept of a video
constexpr std::size_t kMostOfShot = 15;  // of these looked at
constexpr double kOwnPlateSecs = 4;      // a shot that long shows its background by itself, its lettering too

/// Frames `first`, `first + step`, … of a span, or of several one after another.
struct EvenFrames {
  int first = 0, step = 1;
};

EvenFrames even_frames(int num_frames, const VideoInfo& info) {
  const int most = num_plate_frames(info.width, info.height);
  const int step = std::max(1, (num_frames + most - 1) / most);
  return {std::min(step / 2, num_frames - 1), step};
}

struct Preview {
  int frame = 0;
  Image image;
};

/// Median over a shot's previews, each channel by itself; no pixels where there is no preview.
Image median_preview(const std::vector<Preview>& previews, const FrameSpan& shot) {
  std::vector<const Image*> seen;
  for (const Preview& preview : previews)
    if (preview.frame >= shot.start && preview.frame < shot.end()) seen.push_back(&preview.image);
  if (seen.empty()) return {};
  const std::size_t step = (seen.size() + kMostOfShot - 1) / kMostOfShot;
  Image median(seen[0]->width, seen[0]->height);
  std::vector<std::uint8_t> levels;
  for (std::size_t i = 0; i < median.pixels.size(); ++i) {
    for (std::uint8_t Rgba::*channel : {&Rgba::r, &Rgba::g, &Rgba::b}) {
      levels.clear();
      for (std::size_t k = 0; k < seen.size(); k += step) levels.push_back(seen[k]->pixels[i].*channel);
      std::nth_element(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2), levels.end());
      median.pixels[i].*channel = levels[levels.size() / 2];
    }
  }
  return median;
}

bool same_background(const Image& a, const Image& b) {
  constexpr int kLevels = 4;
  if (a.pixels.empty() || b.pixels.empty()) return false;
  int same = 0, border = 0, same_border = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const Rgba &p = a.at(x, y), &q = b.at(x, y);
      const bool is_same = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}) <= kLevels;
      const bool at_border = std::min(x, a.width - 1 - x) * 8 < a.width || y * 8 < a.height;
      same += is_same ? 1 : 0;
      border += at_border ? 1 : 0, same_border += at_border && is_same ? 1 : 0;
    }
  }
  return same * 10 >= 6 * a.width * a.height && same_border * 10 >= 8 * border;
}

std::vector<int> scenes_of(const std::vector<FrameSpan>& shots, const std::vector<Preview>& previews, double rate) {
  std::vector<int> scenes;
  std::vector<Image> backgrounds;
  for (const FrameSpan& shot : shots) {
    Image median = shots.size() > 1 ? median_preview(previews, shot) : Image();
    std::size_t scene = shot.length >= kOwnPlateSecs * rate ? backgrounds.size() : 0;
    while (scene < backgrounds.size() && !same_background(backgrounds[scene], median)) ++scene;
    if (scene == backgrounds.size()) backgrounds.push_back(std::move(median));
    scenes.push_back(static_cast<int>(scene));
  }
  return scenes;
}

}  // namespace

FootageScan scan_footage(VideoReader& reader, const FrameSpan& span, const JobContext& job) {
  const VideoInfo& info = reader.info();
  const PictureSize small = ShotFinder::small_size(info.width, info.height);
  const EvenFrames wanted = even_frames(span.length, info);
  const int preview_step = 1 + span.length / kMostPreviews;
  const double rate = info.frames_per_sec > 0 ? info.frames_per_sec : 25;
  ShotFinder finder(rate);
  FootageScan scan;
  std::vector<Preview> previews;
  VideoFrame frame;
  Image preview;
  if (span.start > 0) reader.seek(span.start);
  int count = 0;
  for (; count < span.length && reader.advance(); ++count) {
    job.check_cancelled();
    job.progress("looking for cuts", static_cast<double>(count) / span.length);
    reader.read_preview(preview, small.width, small.height);
    finder.add(preview);
    if (count % preview_step == 0 && preview.width == small.width) previews.push_back({span.start + count, preview});
    if (count < wanted.first || (count - wanted.first) % wanted.step != 0) continue;
    reader.read(frame);
    scan.plate_frames.images.push_back(frame.image);
  }
  scan.plate_frames.span = {span.start, count};
  scan.report = finder.finish();
  for (auto* spans : {&scan.report.shots, &scan.report.flashes})
    for (FrameSpan& one : *spans) one.start += span.start;
  scan.scenes = scenes_of(scan.report.shots, previews, rate);
  return scan;
}

FootageScan unbroken_footage(const FrameSpan& span) {
  FootageScan scan;
  if (span.length > 0) scan.report.shots.push_back(span), scan.scenes.push_back(0);
  return scan;
}

std::vector<Image> frames_for_plate(VideoReader& reader, const std::vector<FrameSpan>& spans, PlateFrames& kept,
                                    const JobContext& job) {
  const int num_frames =
      std::accumulate(spans.begin(), spans.end(), 0, [](int sum, const FrameSpan& span) { return sum + span.length; });
  if (!kept.images.empty() && num_frames == kept.span.length) return std::move(kept.images);
  const EvenFrames wanted = even_frames(num_frames, reader.info());
  std::vector<Image> frames;
  VideoFrame frame;
  int before = 0;  // frames in earlier spans
  auto span = spans.begin();
  for (int idx = wanted.first; idx < num_frames; idx += wanted.step) {
    job.check_cancelled();
    job.progress("looking for the empty scene", static_cast<double>(idx) / num_frames);
    while (idx - before >= span->length) before += (span++)->length;
    reader.seek(span->start + idx - before);
    if (!reader.next(frame)) break;
    frames.push_back(frame.image);
  }
  return frames;
}

}  // namespace motex
