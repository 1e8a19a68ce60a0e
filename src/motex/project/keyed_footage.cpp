// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/keyed_footage.h"

#include <algorithm>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/image/png.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

constexpr double kStays = 1.5;  // widths: who is never seen on more of the picture stands in one place
constexpr int kBatch = 8;       // frames at a time, for any number of threads

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
    : video_(video), options_(options), job_(job), reader_(video, {}, job), keyed_(kBatch) {
  now_.pictures.resize(kBatch), ahead_.pictures.resize(kBatch);
  FrameSpan span{0, static_cast<int>(reader_.frame_times().size())};
  if (options.frames.length > 0)
    span = {options.frames.start, std::clamp(span.length - options.frames.start, 0, options.frames.length)};
  if (!options.garbage_mask.empty()) {
    const Image picture = read_png(options.garbage_mask);
    check_size(options.garbage_mask, picture, info());
    garbage_ = garbage_mask_of(picture);
  }
  if (!options.plate_picture.empty()) {
    plate_picture_ = read_png(options.plate_picture);
    check_size(options.plate_picture, plate_picture_, info());
  }
  scan_ = options.cuts ? scan_footage(reader_, span, job) : unbroken_footage(span);
  job_.on_progress = nullptr;
  for (const FrameSpan& shot : scan_.report.shots)
    if (shot.length >= options.shortest_shot) num_frames_ += shot.length;
  if (enter_next_shot()) fill(ahead_);
}

CleanPlate KeyedFootage::plate_of_scene(int scene) {
  std::vector<FrameSpan> spans;
  for (std::size_t k = 0; k < scan_.scenes.size(); ++k)
    if (scan_.scenes[k] == scene) spans.push_back(scan_.report.shots[k]);
  const std::vector<Image> frames = frames_for_plate(reader_, spans, scan_.plate_frames, job_);
  CleanPlate plate = plate_picture_.pixels.empty()
                         ? estimate_clean_plate(frames, options_.plate, garbage_.width > 0 ? &garbage_ : nullptr, job_)
                         : clean_plate_of(plate_picture_, frames, job_);
  plate.coarse_colour = info().coarse_colour;
  tell_of(plate, frames);
  return plate;
}

void KeyedFootage::tell_of(const CleanPlate& plate, const std::vector<Image>& frames) const {
  const std::string name = video_.string();
  if (all_grey(frames)) job_.warn(name + ": is grey, so that only lightness tells the actor from the background");
  if (plate.seen_share < 0.75 && plate.kind != ScreenKind::kNatural)
    job_.warn(name + ": " + std::to_string(static_cast<int>(100 - 100 * plate.seen_share)) +
              " % of the screen is never seen empty and filled in from around; a picture of the empty scene (--plate) "
              "would help");
  if (plate.kind == ScreenKind::kNatural && plate.steady_share < 0.85)
    job_.warn(name + ": " + std::to_string(static_cast<int>(100 - 100 * plate.steady_share)) +
              " % of the background does not stay as it is (a camera that moves, changing light, leaves); the matte "
              "will have faults there");
}

void KeyedFootage::enter_scene(int scene) {
  scene_ = scene;
  keyers_.clear();
  CleanPlate plate;
  if (const auto known = plates_.find(scene); known != plates_.end()) {
    plate = known->second;
  } else {
    try {
      plate = plate_of_scene(scene);
    } catch (const InvalidInput& error) {
      const FrameSpan& shot = scan_.report.shots[static_cast<std::size_t>(shot_)];
      const bool is_all = shot.length == num_frames_;
      const std::string where = is_all ? ""
                                       : " (frames " + std::to_string(shot.start) + " to " +
                                             std::to_string(shot.end() - 1) + ", between cuts)";
      trouble_ = video_.string() + where + ": " + error.what();
      if (is_all) throw InvalidInput(trouble_);
      job_.warn(trouble_);
      return;
    }
  }
  if (!first_plate_) first_plate_ = plate;
  if (std::find(scan_.scenes.begin() + shot_ + 1, scan_.scenes.end(), scene) != scan_.scenes.end())
    plates_[scene] = plate;
  else
    plates_.erase(scene);
  keyers_.reserve(kBatch);
  keyers_.emplace_back(std::move(plate), options_.key, garbage_);
  while (keyers_.size() < kBatch) keyers_.push_back(keyers_.front());
}

bool KeyedFootage::enter_next_shot() {
  const std::vector<FrameSpan>& shots = scan_.report.shots;
  const auto num_shots = static_cast<int>(shots.size());
  do ++shot_;
  while (shot_ < num_shots && shots[static_cast<std::size_t>(shot_)].length < options_.shortest_shot);
  if (shot_ >= num_shots) return false;
  const int scene = scan_.scenes[static_cast<std::size_t>(shot_)];
  if (info().num_channels != 4 && scene != scene_) enter_scene(scene);
  const FrameSpan& shot = shots[static_cast<std::size_t>(shot_)];
  rest_of_shot_ = shot.length;
  reader_.seek(shot.start);
  return true;
}

void KeyedFootage::fill(Batch& batch) {
  batch.size = 0;
  batch.shot = shot_;
  while (batch.size < batch.pictures.size() && rest_of_shot_ > 0) {
    if (reader_.next(batch.pictures[batch.size]))
      ++batch.size, --rest_of_shot_;
    else
      rest_of_shot_ = 0;
  }
}

/// Keys one batch while the next is read.
void KeyedFootage::key_batch() {
  std::swap(now_, ahead_);
  next_ = 0;
  parallel_for(job_.jobs, static_cast<int>(now_.size) + 1, [&](int task) {
    if (task == 0) return fill(ahead_);
    const auto k = static_cast<std::size_t>(task) - 1;
    const VideoFrame& picture = now_.pictures[k];
    if (info().num_channels == 4)
      keyed_[k].sprite = sprite_of(picture.image);
    else if (keyers_.empty())
      keyed_[k].sprite = {};
    else
      keyers_[k].key(picture.image, keyed_[k].sprite);
    keyed_[k].idx = picture.idx;
    keyed_[k].time_secs = picture.time_secs;
    keyed_[k].shot = now_.shot;
  });
}

void KeyedFootage::take_notes(const KeyedFrame& frame) {
  ++report_.num_frames;
  if (frame.sprite.empty()) ++report_.num_empty;
  const auto size = static_cast<double>(info().width) * info().height;
  double area = 0;
  for (const PremultipliedRgba& pixel : frame.sprite.pixels) area += pixel[3];
  report_.mean_area += (area / 255 / size - report_.mean_area) / static_cast<double>(report_.num_frames);
  if (!frame.sprite.empty()) {
    left_ = std::min(left_, frame.sprite.left);
    right_ = std::max(right_, frame.sprite.left + frame.sprite.width - 1);
    widths_.push_back(frame.sprite.width);
  }
  if (covered_border(frame.sprite, info().width, info().height) <= 0.5) return;
  ++report_.num_crowded;
  if (report_.first_crowded < 0) report_.first_crowded = frame.idx;
}

void KeyedFootage::tell_of_place() {
  if (widths_.empty() || !first_plate_ || first_plate_->kind != ScreenKind::kNatural || !plate_picture_.pixels.empty())
    return;
  if (right_ - left_ + 1 > kStays * quantile(widths_, 0.9)) return;
  job_.warn(video_.string() + ": who is in it stays between x " + std::to_string(left_) + " and " +
            std::to_string(right_) +
            "; what stood still there most of the time is taken for the background and missing in the matte: give a "
            "picture of the empty scene (--plate), or film the actor coming in");
}

bool KeyedFootage::next(KeyedFrame& frame) {
  if (next_ == now_.size) {
    while (ahead_.size == 0) {
      if (!enter_next_shot()) {
        if (!first_plate_ && !trouble_.empty()) throw InvalidInput(trouble_);
        tell_of_place();
        return false;
      }
      fill(ahead_);
    }
    key_batch();
  }
  std::swap(frame, keyed_[next_++]);
  take_notes(frame);
  return true;
}

}  // namespace motex
