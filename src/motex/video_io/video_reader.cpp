// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/video_reader.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/video_io/frame_source.h"
#include "motex/video_io/libav_source.h"
#include "motex/video_io/picture_files.h"
#include "motex/video_io/picture_sequence.h"
#include "motex/video_io/tiff_stack.h"

namespace motex {
namespace {

constexpr std::uint64_t kMaxTiffBytes = std::uint64_t{1} << 30;

std::unique_ptr<FrameSource> open_input_source(std::unique_ptr<InputBytes> input, const std::string& name,
                                               const JobContext& job) {
  refuse_text(*input, name);
  return std::make_unique<libav::LibavSource>(std::move(input), name, job);
}

std::unique_ptr<FrameSource> open_source(const std::filesystem::path& path, double frames_per_sec,
                                         const JobContext& job) {
  if (!std::isfinite(frames_per_sec) || frames_per_sec <= 0 || frames_per_sec > 1e6)
    throw InvalidInput("frames per second must be above 0 and at most 1000000");
  const std::string name = path.string();
  if (is_picture_sequence(path))
    return std::make_unique<PictureSequence>(list_pictures(path, job), name, frames_per_sec, job);
  std::unique_ptr<InputBytes> input = open_input(path);
  const std::string head = peek(*input, 8);
  if (head.size() == 8 &&
      (head.substr(0, 4) == std::string("II*\0", 4) || head.substr(0, 4) == std::string("MM\0*", 4)))
    return std::make_unique<TiffStack>(read_file(path, kMaxTiffBytes), name, frames_per_sec, job);
  return open_input_source(std::move(input), name, job);
}

}  // namespace

VideoReader::VideoReader(const std::filesystem::path& path, const ReadVideoOptions& options, const JobContext& job)
    : source_(open_source(path, options.frames_per_sec, job)) {}

VideoReader::VideoReader(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

VideoReader VideoReader::from_bytes(std::string_view bytes, const std::string& name, const JobContext& job) {
  if (!find_tiff_pages(bytes).empty())
    return VideoReader(std::make_unique<TiffStack>(std::string(bytes), name, ReadVideoOptions{}.frames_per_sec, job));
  return VideoReader(open_input_source(open_input(bytes), name, job));
}

VideoReader::~VideoReader() = default;
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;

const VideoInfo& VideoReader::info() const { return source_->info(); }

bool VideoReader::advance() { return source_->advance(); }

void VideoReader::read(VideoFrame& frame) {
  source_->to_image(frame.image);
  frame.idx = source_->idx();
  frame.time_secs = source_->time_secs();
}

void VideoReader::read_preview(Image& image, int width, int height) { source_->to_preview(image, width, height); }

bool VideoReader::next(VideoFrame& frame) {
  if (!advance()) return false;
  read(frame);
  return true;
}

bool VideoReader::next(DeepVideoFrame& frame) {
  if (!source_->advance()) return false;
  source_->to_planes(frame.planes);
  frame.idx = source_->idx();
  frame.time_secs = source_->time_secs();
  return true;
}

void VideoReader::seek(std::int64_t idx) {
  if (idx < 0) throw InvalidInput("frames count from 0; there is no frame " + std::to_string(idx));
  source_->seek(idx);
}

void VideoReader::seek_secs(double time_secs) {
  const std::vector<double> times = source_->frame_times();
  const auto after = std::upper_bound(times.begin(), times.end(), time_secs + 1e-9);
  source_->seek(std::max<std::int64_t>(0, after - times.begin() - 1));
}

std::vector<double> VideoReader::frame_times() { return source_->frame_times(); }

std::vector<std::string> readable_video_extensions() {
  return {".mp4", ".mov", ".webm", ".mkv", ".avi", ".m4v", ".mpg", ".ts", ".y4m", ".gif", ".tif", ".tiff", ".png"};
}

void warn_of_oblong_pixels(const VideoInfo& info, const JobContext& job) {
  if (std::abs(info.pixel_aspect - 1) < 0.01) return;
  const auto shown_width = static_cast<int>(std::lround(info.width * info.pixel_aspect));
  job.warn(info.name + ": has pixels that are not square (it is shown " + std::to_string(shown_width) + " × " +
           std::to_string(info.height) + "); they are taken as square, so what is made of it is shown " +
           std::to_string(info.width) + " × " + std::to_string(info.height));
}

}  // namespace motex
