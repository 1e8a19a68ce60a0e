// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/picture_sequence.h"

#include "motex/core/error.h"
#include "motex/video_io/libav_source.h"

namespace motex {
namespace {

/// Its warnings are dropped: one picture has no frames to be short of.
libav::LibavSource open_picture(const std::filesystem::path& path, const JobContext& job) {
  std::unique_ptr<InputBytes> input = open_input(path);
  refuse_text(*input, path.string());
  JobContext quiet = job;
  quiet.on_warning = nullptr;
  quiet.jobs = 1;
  return {std::move(input), path.string(), quiet};
}

}  // namespace

PictureSequence::PictureSequence(std::vector<std::filesystem::path> pictures, const std::string& name,
                                 double frames_per_sec, const JobContext& job)
    : pictures_(std::move(pictures)), job_(job) {
  info_ = open_picture(pictures_.at(0), job_).info();
  info_.name = name;
  info_.container = "pictures";
  info_.frames_per_sec = frames_per_sec;
  info_.num_frames_said = static_cast<std::int64_t>(pictures_.size());
  info_.duration_secs = static_cast<double>(pictures_.size()) / frames_per_sec;
}

bool PictureSequence::advance() {
  job_.check_cancelled();
  if (idx_ + 1 >= static_cast<std::int64_t>(pictures_.size())) return false;
  const std::filesystem::path& path = pictures_[static_cast<std::size_t>(idx_ + 1)];
  try {
    libav::LibavSource picture = open_picture(path, job_);
    picture.advance();
    picture.to_image(to_image_);
    picture.to_planes(to_planes_);
  } catch (const UnsupportedFile& error) {
    job_.warn(std::string(error.what()) + "; the " + std::to_string(idx_ + 1) + " pictures before it are used");
    pictures_.resize(static_cast<std::size_t>(idx_ + 1));
    return false;
  }
  if (to_image_.width != info_.width || to_image_.height != info_.height)
    throw InvalidInput(path.string() + ": is " + std::to_string(to_image_.width) + " × " +
                       std::to_string(to_image_.height) + " pixels, the first picture " + std::to_string(info_.width) +
                       " × " + std::to_string(info_.height) + "; all must have one size");
  if (static_cast<int>(to_planes_.size()) != info_.num_channels)
    to_planes_ = motex::to_planes(to_image_, info_.num_channels);
  ++idx_;
  return true;
}

std::vector<double> PictureSequence::frame_times() {
  std::vector<double> times(pictures_.size());
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / info_.frames_per_sec;
  return times;
}

}  // namespace motex
