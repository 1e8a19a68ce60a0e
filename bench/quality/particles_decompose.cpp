// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Matching pursuit on the middle frame (luma) of each clip: processor seconds for 800 bases, PSNR at 100 … 800, with
// the paper's dictionary and the extended one, over a background and, as in the paper, over one level.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/particle_clips.h"
#include "motex/core/error.h"
#include "motex/image/planes.h"
#include "motex/particles/background.h"
#include "motex/particles/pursuit.h"
#include "motex/particles/simulate.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

const std::vector<int> kCounts{100, 200, 400, 800};

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(const std::string& name, const char* setting, const Planes& frame, const Planes& background,
             const PursueOptions& options) {
  const Planes target = minus(frame, background);
  PursueOptions plain = options;
  plain.refine_rounds = 0;
  const double start = processor_secs();
  pursue(target, plain);
  const double pursued = processor_secs();
  const std::vector<BaseMap> maps = pursue_stages(target, kCounts, options);
  const double settled = processor_secs();
  std::printf("%-26s %-22s %5.2f s pursuit, %5.2f s with all stages; PSNR 0: %5.2f", name.c_str(), setting,
              pursued - start, settled - pursued, psnr(background, frame));
  for (std::size_t k = 0; k < maps.size(); ++k)
    std::printf("  %d: %5.2f", kCounts[k], psnr(reconstruct(maps[k], background), frame));
  std::puts("");
  std::fflush(stdout);
}

void measure_frames(const std::string& name, const std::vector<Planes>& frames) {
  const Planes& frame = frames[frames.size() / 2];
  BackgroundKind median = BackgroundKind::kMedian, flat = BackgroundKind::kFlat;
  const Planes over_time = estimate_background(frame, frames, median);
  PursueOptions extended, paper, grid;
  paper.dictionary = grid.dictionary = Dictionary::kPaper;
  grid.refine_steps = 0;
  measure(name, "extended, median", frame, over_time, extended);
  measure(name, "paper, median", frame, over_time, paper);
  measure(name, "paper on grid, median", frame, over_time, grid);
  measure(name, "paper, one level", frame, estimate_background(frame, frames, flat), paper);
}

void measure_clip(const std::filesystem::path& path) {
  VideoReader reader(path);
  std::vector<Planes> frames;
  for (VideoFrame frame; frames.size() < 121 && reader.next(frame);) frames.push_back({luma(frame.image)});
  measure_frames(path.filename().string(), frames);
}

void measure_simulated() {
  SimulateSnowOptions options;
  options.frames = 61;
  std::vector<Planes> frames;
  for (const Image& image : simulate_snow(options).frames) frames.push_back({luma(image)});
  measure_frames("simulated snow", frames);
}

int run() {
  const int num_found = bench::for_each_clip(
      {"textured/snow_forest_320x240.mp4", "textured/snow_birch_480x270.mp4", "textured/birds_sky_480x270.mp4",
       "textured/fireworks_repeat_480x270.mp4", "textured/waterfall_kjos_320x240.mp4",
       "textured/waterfall_pool_320x240.mp4", "synth/synth_snow.mkv"},
      measure_clip);
  if (num_found == 0) measure_simulated();
  return 0;
}

}  // namespace
}  // namespace motex

int main() { return motex::run(); }
