// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/decompose_video.h"

#include <algorithm>
#include <cstdio>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"

namespace motex {
namespace {

constexpr std::size_t kMaxBackgroundBytes = std::size_t{256} << 20;
constexpr int kBatch = 8;  // frames at a time, for any number of threads

/// Without alpha.
Planes colours_of(Planes planes) {
  if (planes.size() == 4) planes.pop_back();
  return planes;
}

/// How many frames a background may take: odd, and not more than memory allows.
std::int64_t num_background_frames(const VideoInfo& info, const DecomposeOptions& options) {
  const bool one_frame = options.background == BackgroundKind::kSmooth || options.background == BackgroundKind::kFlat;
  if (one_frame) return 1;
  const std::size_t frame_bytes = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
                                  static_cast<std::size_t>(info.num_channels) * sizeof(float);
  const auto affordable = static_cast<std::int64_t>(std::max<std::size_t>(9, kMaxBackgroundBytes / frame_bytes));
  return std::min<std::int64_t>(options.background_frames, affordable);
}

PursueOptions pursue_options(const DecomposeOptions& options) {
  PursueOptions pursue;
  pursue.dictionary = options.dictionary;
  pursue.refine_steps = options.refine_steps;
  pursue.refine_rounds = options.refine_rounds;
  pursue.min_coefficient = options.min_coefficient;
  return pursue;
}

/// What is shown: bases may overshoot, screens do not.
void cut_off(Planes& planes) {
  for (Plane& plane : planes)
    for (float& value : plane.values) value = std::clamp(value, 0.0F, 255.0F);
}

/// Fills in all that follows from observed and background.
void decompose(FrameDecomposition& result, const std::vector<int>& counts, const DecomposeOptions& options,
               const JobContext& job) {
  result.maps = pursue_stages(minus(result.observed, result.background), counts, pursue_options(options), job);
  result.background_psnr = psnr(result.background, result.observed);
  for (const BaseMap& map : result.maps) {
    result.pictures.push_back(reconstruct(map, result.background));
    cut_off(result.pictures.back());
    result.psnr.push_back(psnr(result.pictures.back(), result.observed));
  }
}

/// Up to `most` frames evenly over the video, decoded in order.
std::vector<Planes> frames_over_the_whole(const std::filesystem::path& video, std::int64_t num_frames,
                                          std::int64_t most, const JobContext& job) {
  JobContext quiet = job;
  quiet.on_warning = nullptr;
  VideoReader reader(video, {}, quiet);
  const std::int64_t step = std::max<std::int64_t>(1, (num_frames + most - 1) / most);
  std::vector<Planes> frames;
  for (DeepVideoFrame frame; reader.next(frame);)
    if (frame.idx % step == 0) frames.push_back(colours_of(std::move(frame.planes)));
  return frames;
}

}  // namespace

FrameDecomposition decompose_frame(const std::filesystem::path& video, std::int64_t frame,
                                   const std::vector<int>& counts, const DecomposeOptions& options,
                                   const JobContext& job) {
  check_options(options);
  VideoReader reader(video, {}, job);
  const auto num_frames = static_cast<std::int64_t>(reader.frame_times().size());
  if (frame < 0) frame = num_frames / 2;
  if (frame >= num_frames)
    throw InvalidInput(video.string() + ": has no frame " + std::to_string(frame) + "; its " +
                       std::to_string(num_frames) + " frames count from 0");
  const std::int64_t num_wanted = std::min(num_frames, num_background_frames(reader.info(), options));
  const std::int64_t first = std::clamp<std::int64_t>(frame - num_wanted / 2, 0, num_frames - num_wanted);
  reader.seek(first);
  FrameDecomposition result;
  std::vector<Planes> around;
  for (DeepVideoFrame next; static_cast<std::int64_t>(around.size()) < num_wanted && reader.next(next);) {
    job.progress("reading", 0.2 * static_cast<double>(around.size()) / static_cast<double>(num_wanted));
    around.push_back(colours_of(std::move(next.planes)));
    if (next.idx != frame) continue;
    result.frame = frame;
    result.time_secs = next.time_secs;
    result.observed = around.back();
  }
  if (result.observed.empty())
    throw InvalidInput(video.string() + ": frame " + std::to_string(frame) + " cannot be decoded; the file is damaged");
  result.background_kind = options.background;
  result.background = estimate_background(result.observed, around, result.background_kind);
  decompose(result, counts, options, job.part(0.25, 1));
  return result;
}

std::int64_t decompose_all(const std::filesystem::path& video, const std::vector<int>& counts,
                           const DecomposeOptions& options, const std::function<void(const FrameDecomposition&)>& take,
                           const JobContext& job) {
  check_options(options);
  VideoReader reader(video, {}, job);
  const auto num_frames = static_cast<std::int64_t>(reader.frame_times().size());
  const std::int64_t most = num_background_frames(reader.info(), options);
  job.progress("background", 0);
  std::vector<Planes> sampled;
  if (most > 1) sampled = frames_over_the_whole(video, num_frames, most, job);
  BackgroundKind kind = options.background;
  Planes shared;
  if (!sampled.empty()) shared = estimate_background(sampled[sampled.size() / 2], sampled, kind);
  sampled.clear();
  std::int64_t num_done = 0;
  for (bool more = true; more;) {
    std::vector<FrameDecomposition> batch;
    for (DeepVideoFrame frame; static_cast<int>(batch.size()) < kBatch && (more = reader.next(frame));) {
      FrameDecomposition& one = batch.emplace_back();
      one.frame = frame.idx;
      one.time_secs = frame.time_secs;
      one.observed = colours_of(std::move(frame.planes));
    }
    const JobContext silent{nullptr, nullptr, job.cancel, 1};
    parallel_for(job.jobs, static_cast<int>(batch.size()), [&](int task) {
      FrameDecomposition& one = batch[static_cast<std::size_t>(task)];
      one.background_kind = kind;
      one.background = kind == BackgroundKind::kMedian || kind == BackgroundKind::kLow
                           ? shared
                           : estimate_background(one.observed, {}, one.background_kind);
      decompose(one, counts, options, silent);
    });
    for (const FrameDecomposition& one : batch) take(one);
    num_done += static_cast<std::int64_t>(batch.size());
    job.progress("matching pursuit", std::min(1.0, static_cast<double>(num_done) /
                                                       static_cast<double>(std::max<std::int64_t>(1, num_frames))));
  }
  return num_done;
}

std::string bases_csv_heading(int num_planes) {
  return std::string("frame,idx,kind,x,y,scale,angle,") + (num_planes == 1 ? "coefficient\n" : "red,green,blue\n");
}

std::string bases_csv(const BaseMap& map, std::int64_t frame) {
  std::string csv;
  char line[256];
  for (std::size_t j = 0; j < map.bases.size(); ++j) {
    const Base& base = map.bases[j];
    std::snprintf(line, sizeof line, "%lld,%zu,%s,%.3f,%.3f,%.4f,%.4f", static_cast<long long>(frame), j,
                  name_of(base.kind), base.x, base.y, base.scale, base.angle);
    csv += line;
    for (int k = 0; k < map.num_planes; ++k) {
      std::snprintf(line, sizeof line, ",%.2f", static_cast<double>(base.coefficients[static_cast<std::size_t>(k)]));
      csv += line;
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace motex
