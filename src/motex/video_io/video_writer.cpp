// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/video_writer.h"

#include <cmath>

#include "motex/core/error.h"
#include "motex/video_io/frame_sink.h"

namespace motex {
namespace {

constexpr int kMaxSide = 16384;

std::string size_text(int width, int height) { return std::to_string(width) + " × " + std::to_string(height); }

bool is_for_pictures(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".png" || extension.empty() || std::filesystem::is_directory(path);
}

void check_shape(const std::filesystem::path& path, const SinkShape& shape) {
  if (shape.width < 1 || shape.height < 1 || shape.width > kMaxSide || shape.height > kMaxSide)
    throw InvalidInput(path.string() + ": a video of " + size_text(shape.width, shape.height) +
                       " pixels cannot be written; sides go from 1 to " + std::to_string(kMaxSide));
  if (!std::isfinite(shape.frames_per_sec) || shape.frames_per_sec < 0.01 || shape.frames_per_sec > 1000)
    throw InvalidInput(path.string() + ": frames per second must be 0.01 … 1000");
  if (!(shape.pixel_aspect >= 0.01 && shape.pixel_aspect <= 100))
    throw InvalidInput(path.string() + ": the aspect of a pixel must be 0.01 … 100");
}

std::unique_ptr<FrameSink> make_sink(const std::filesystem::path& path, const SinkShape& shape, const JobContext& job) {
  check_shape(path, shape);
  return is_for_pictures(path) ? make_picture_sink(path, shape) : make_libav_sink(path, shape, job);
}

}  // namespace

VideoWriter::VideoWriter(const std::filesystem::path& path, int width, int height, const WriteVideoOptions& options,
                         const JobContext& job)
    : VideoWriter(make_sink(path, {options, width, height}, job), width, height, options.frames_per_sec, job) {}

VideoWriter::VideoWriter(std::unique_ptr<FrameSink> sink, int width, int height, double frames_per_sec,
                         const JobContext& job)
    : sink_(std::move(sink)), width_(width), height_(height), frames_per_sec_(frames_per_sec), job_(job) {}

VideoWriter VideoWriter::to_bytes(std::string& bytes, const std::string& extension, int width, int height,
                                  const WriteVideoOptions& options, const JobContext& job) {
  const SinkShape shape{options, width, height};
  const std::string name = "video in memory" + extension;
  check_shape(name, shape);
  return {make_libav_sink(bytes, name, shape, job), width, height, options.frames_per_sec, job};
}

VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::write(const Image& image) { write(image, static_cast<double>(num_frames_) / frames_per_sec_); }

void VideoWriter::write(const Image& image, double time_secs) {
  job_.check_cancelled();
  if (image.width != width_ || image.height != height_)
    throw InvalidInput("a frame of " + size_text(image.width, image.height) + " pixels does not fit a video of " +
                       size_text(width_, height_));
  if (!std::isfinite(time_secs) || time_secs < 0 || time_secs > 1e7 ||
      (num_frames_ > 0 && time_secs < last_secs_ + 0.000999))
    throw InvalidInput("frame times must rise by at least 1/1000 s, and that of frame " + std::to_string(num_frames_) +
                       " does not");
  sink_->write(image, time_secs);
  last_secs_ = time_secs;
  ++num_frames_;
}

void VideoWriter::finish() {
  if (num_frames_ == 0) throw InvalidInput("a video without frames cannot be written");
  sink_->finish();
}

std::vector<std::string> writable_video_extensions() { return {".mp4", ".webm", ".mov", ".mkv", ".avi", ".png"}; }

bool keeps_alpha(const std::string& extension) {
  return extension == ".webm" || extension == ".mov" || extension == ".mkv" || extension == ".png";
}

}  // namespace motex
