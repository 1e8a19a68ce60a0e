// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Reads every clip of ../shared/data/video (or the files named) from beginning to end and says what came out.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/video_io/video_reader.h"

namespace {

std::vector<std::string> listed_clips() {
  const std::filesystem::path folder = std::filesystem::path(MOTEX_SHARED_DATA) / "video";
  std::ifstream manifest(folder / "MANIFEST.tsv");
  std::vector<std::string> clips;
  std::string line;
  std::getline(manifest, line);  // heading
  while (std::getline(manifest, line)) clips.push_back((folder / line.substr(0, line.find('\t'))).string());
  return clips;
}

/// Whether seeking gives the frame that reading in order gives.
bool seeks_right(const std::string& clip, std::int64_t num_frames) {
  const std::int64_t target = num_frames / 2;
  motex::VideoReader in_order(clip), sought(clip);
  motex::VideoFrame a, b;
  while (in_order.next(a) && a.idx < target) {
  }
  sought.seek(target);
  return sought.next(b) && b.idx == target && b.time_secs == a.time_secs && b.image.pixels == a.image.pixels;
}

void read_through(const std::string& clip) {
  motex::JobContext job;
  std::string warnings;
  job.on_warning = [&](const std::string& warning) { warnings += " ! " + warning; };
  const std::string name = std::filesystem::path(clip).filename().string();
  try {
    motex::VideoReader reader(clip, {}, job);
    const motex::VideoInfo& info = reader.info();
    const std::vector<double> times = reader.frame_times();
    motex::VideoFrame frame;
    std::int64_t num_frames = 0, num_other_times = 0;
    double shortest = 1e9, longest = 0, last = 0;
    for (; reader.next(frame); ++num_frames) {
      const auto i = static_cast<std::size_t>(frame.idx);
      num_other_times += i >= times.size() || std::abs(times[i] - frame.time_secs) > 1e-6;
      if (num_frames > 0) shortest = std::min(shortest, frame.time_secs - last);
      if (num_frames > 0) longest = std::max(longest, frame.time_secs - last);
      last = frame.time_secs;
    }
    std::printf(
        "%-36s %-10s %-12s %4dx%-4d %dch %2dbit %4lld of %4lld frames, %zu times (%lld differ), step %.4f … %.4f s,"
        " rot %d, seek %s%s\n",
        name.c_str(), info.codec.c_str(), info.pixel_format.c_str(), info.width, info.height, info.num_channels,
        info.bit_depth, static_cast<long long>(num_frames), static_cast<long long>(info.num_frames_said), times.size(),
        static_cast<long long>(num_other_times), num_frames > 1 ? shortest : 0.0, longest, info.rotation_deg,
        seeks_right(clip, num_frames) ? "ok" : "WRONG", warnings.c_str());
  } catch (const motex::Error& error) {
    std::printf("%-36s refused: %s\n", name.c_str(), error.what());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> clips = argc > 1 ? std::vector<std::string>(argv + 1, argv + argc) : listed_clips();
  for (const std::string& clip : clips) read_through(clip);
}
