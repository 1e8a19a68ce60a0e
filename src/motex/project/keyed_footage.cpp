// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/keyed_footage.h"

#include <algorithm>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/parallel.h"
#include "motex/image/png.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

constexpr int kBatch = 8;  // frames at a time, for any number of threads

/// Up to the best number of frames for a plate, evenly over that much of the video.
std::vector<Image> frames_for_plate(const fs::path& video, std::int64_t first, std::int64_t num_frames,
                                    const JobContext& job) {
  JobContext quiet = job;
  quiet.on_warning = nullptr;
  VideoReader reader(video, {}, quiet);
  const std::int64_t most = num_plate_frames(reader.info().width, reader.info().height);
  const std::int64_t step = std::max<std::int64_t>(1, (num_frames + most - 1) / most);
  std::vector<Image> frames;
  if (step == 1 && first > 0) reader.seek(first);
  for (std::int64_t idx = std::min(step / 2, num_frames - 1); idx < num_frames; idx += step) {
    job.check_cancelled();
    job.progress("looking for the empty scene", static_cast<double>(idx) / static_cast<double>(num_frames));
    if (step > 1) reader.seek(first + idx);
    VideoFrame frame;
    if (!reader.next(frame)) break;
    frames.push_back(std::move(frame.image));
  }
  return frames;
}

Image read_png(const fs::path& path) { return decode_png(read_file(path.string()), path.string()); }

void check_size(const fs::path& path, const Image& picture, const VideoInfo& info) {
  if (picture.width != info.width || picture.height != info.height)
    throw InvalidInput(path.string() + ": has " + std::to_string(picture.width) + " × " +
                       std::to_string(picture.height) + " pixels, the video " + std::to_string(info.width) + " × " +
                       std::to_string(info.height));
}

bool all_grey(const std::vector<Image>& frames) { return std::all_of(frames.begin(), frames.end(), is_grey); }

/// Share of the left, right and upper border that is opaque.
double covered_border(const Sprite& sprite, int width, int height) {
  int covered = 0;
  const auto look = [&](int x, int y) {
    const int u = x - sprite.left, v = y - sprite.top;
    if (u >= 0 && v >= 0 && u < sprite.width && v < sprite.height && sprite.at(u, v)[3] >= 128) ++covered;
  };
  for (int x = 0; x < width; ++x) look(x, 0);
  for (int y = 0; y < height; ++y) look(0, y), look(width - 1, y);
  return static_cast<double>(covered) / (width + 2 * height);
}

}  // namespace

Mask garbage_mask_of(const Image& picture) {
  const bool by_alpha = !is_opaque(picture);
  Mask mask(picture.width, picture.height);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    const Rgba& p = picture.pixels[i];
    mask.pixels[i] = (by_alpha ? p.a : (p.r + p.g + p.b) / 3) >= 128 ? 1 : 0;
  }
  return mask;
}

KeyedFootage::KeyedFootage(const fs::path& video, const KeyFootageOptions& options, const JobContext& job)
    : reader_(video, {}, job), job_(job), pictures_(kBatch), keyed_(kBatch) {
  num_frames_ = static_cast<std::int64_t>(reader_.frame_times().size());
  if (options.frames.length > 0) {
    num_frames_ = std::clamp<std::int64_t>(num_frames_ - options.frames.start, 0, options.frames.length);
    if (options.frames.start > 0) reader_.seek(options.frames.start);
  }
  if (reader_.info().num_channels == 4) return;
  prepare(video, options, job);
}

void KeyedFootage::prepare(const fs::path& video, const KeyFootageOptions& options, const JobContext& job) {
  Mask garbage;
  if (!options.garbage_mask.empty()) {
    const Image picture = read_png(options.garbage_mask);
    check_size(options.garbage_mask, picture, info());
    garbage = garbage_mask_of(picture);
  }
  const std::vector<Image> frames = frames_for_plate(video, options.frames.start, num_frames_, job);
  CleanPlate plate;
  if (options.plate_picture.empty()) {
    try {
      plate = estimate_clean_plate(frames, options.plate, garbage.width > 0 ? &garbage : nullptr, job);
    } catch (const InvalidInput& error) {
      throw InvalidInput(video.string() + ": " + error.what());
    }
  } else {
    const Image picture = read_png(options.plate_picture);
    check_size(options.plate_picture, picture, info());
    plate = clean_plate_of(picture, frames, job);
  }
  if (all_grey(frames))
    job.warn(video.string() + ": is grey, so that only lightness tells the actor from the background");
  if (plate.seen_share < 0.75 && plate.kind != ScreenKind::kNatural)
    job.warn(video.string() + ": " + std::to_string(static_cast<int>(100 - 100 * plate.seen_share)) +
             " % of the screen is never seen empty and filled in from around; a picture of the empty scene (--plate) "
             "would help");
  if (plate.kind == ScreenKind::kNatural && plate.steady_share < 0.85)
    job.warn(video.string() + ": " + std::to_string(static_cast<int>(100 - 100 * plate.steady_share)) +
             " % of the background does not stay as it is (a camera that moves, changing light, leaves); the matte "
             "will have faults there");
  keyers_.reserve(kBatch);
  keyers_.emplace_back(std::move(plate), options.key, garbage);
  while (keyers_.size() < kBatch) keyers_.push_back(keyers_.front());
}

void KeyedFootage::read_batch() {
  num_ready_ = next_ = 0;
  while (num_ready_ < pictures_.size() && num_read_ < num_frames_ && reader_.next(pictures_[num_ready_]))
    ++num_ready_, ++num_read_;
  parallel_for(job_.jobs, static_cast<int>(num_ready_), [&](int task) {
    const auto k = static_cast<std::size_t>(task);
    if (keyers_.empty())
      keyed_[k].sprite = sprite_of(pictures_[k].image);
    else
      keyers_[k].key(pictures_[k].image, keyed_[k].sprite);
    keyed_[k].idx = pictures_[k].idx;
    keyed_[k].time_secs = pictures_[k].time_secs;
  });
}

void KeyedFootage::take_notes(const KeyedFrame& frame) {
  ++report_.num_frames;
  if (frame.sprite.empty()) ++report_.num_empty;
  const auto size = static_cast<double>(info().width) * info().height;
  double area = 0;
  for (const PremultipliedRgba& pixel : frame.sprite.pixels) area += pixel[3];
  report_.mean_area += (area / 255 / size - report_.mean_area) / static_cast<double>(report_.num_frames);
  if (covered_border(frame.sprite, info().width, info().height) <= 0.5) return;
  ++report_.num_crowded;
  if (report_.first_crowded < 0) report_.first_crowded = frame.idx;
}

bool KeyedFootage::next(KeyedFrame& frame) {
  if (next_ == num_ready_) read_batch();
  if (num_ready_ == 0) return false;
  std::swap(frame, keyed_[next_++]);
  take_notes(frame);
  return true;
}

}  // namespace motex
