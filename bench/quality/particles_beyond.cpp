// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// What the paper leaves for later: forks and merges of cables, interaction of neighbours, depth from parallax; on water
// (carried bases), on real snow and birds and on simulated ones (tracked), where there is no interaction and no depth.
#include <cstdio>
#include <filesystem>
#include <string>

#include "bench/particle_clips.h"
#include "motex/core/error.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/depth.h"
#include "motex/particles/forks.h"
#include "motex/particles/interaction.h"
#include "motex/particles/learn_water.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_elements.h"
#include "motex/project/load_video_clip.h"

namespace motex {
namespace {

namespace fs = std::filesystem;
constexpr int kMostFrames = 80;

void report(const std::string& name, const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height,
            const FlowField& flow) {
  const ForksReport forks = find_forks(cables, num_frames, width, height);
  std::printf("%s: %zu cables\n  forks %zu (by chance %.1f), merges %zu (by chance %.1f) in %.0f steps\n", name.c_str(),
              cables.size(), forks.forks.size(), forks.forks_by_chance, forks.merges.size(), forks.merges_by_chance,
              forks.num_steps);
  for (const double radius : {8.0, 20.0}) {
    const Interaction i = measure_interaction(cables, num_frames, flow, radius);
    std::printf(
        "  neighbours within %2.0f px: phi %.3f, coupling %.3f ± %.3f; held out %.2f %% -> %.2f %% explained (%lld "
        "steps)\n",
        radius, i.persistence, i.coupling, i.coupling_error, 100 * i.explained_alone, 100 * i.explained_with,
        static_cast<long long>(i.num_steps));
  }
  const DepthReport depth = estimate_depth(cables);
  std::printf("  depth: ln scale and ln speed correlate %.2f, slope %.2f over %d cables: %s\n", depth.correlation,
              depth.slope, depth.num_used, depth.reliable ? "reliable" : "not reliable");
  std::fflush(stdout);
}

void measure_tracked(const std::string& name, const ClipFrames& clip) {
  const ClipBackground background(clip, BackgroundKind::kMedian, {});
  TrackElementsReport found;
  const std::vector<Cable> cables = track_elements(clip, luma(background.still()), 0, {}, {}, &found);
  report(name, cables, clip.num_frames(), clip.width, clip.height, {});
}

void measure_water(const fs::path& path) {
  LoadVideoClipOptions load;
  load.num_frames = kMostFrames;
  LearnWaterOptions options;
  options.num_bases = 300;
  const LearnedWater learned = learn_water(load_video_clip(path, load), options);
  report(path.filename().string(), learned.model.cables, learned.model.num_frames, learned.model.width,
         learned.model.height, learned.model.water->flow);
}

ClipFrames frames_of(const SimulatedScene& scene) {
  ClipFrames clip{scene.width, scene.height, scene.frames_per_sec, {}, {}};
  for (const Image& frame : scene.frames) clip.luma.push_back(luma(frame));
  return clip;
}

}  // namespace
}  // namespace motex

int main() {
  using namespace motex;
  SimulateSnowOptions snow;
  snow.frames = kMostFrames;
  measure_tracked("simulated snow", frames_of(simulate_snow(snow)));
  SimulateBirdsOptions birds;
  birds.frames = kMostFrames;
  birds.elements = 20;
  measure_tracked("simulated birds", frames_of(simulate_birds(birds)));
  LoadVideoClipOptions load;
  load.num_frames = kMostFrames;
  bench::for_each_clip(
      {"textured/snow_forest_320x240.mp4", "textured/birds_sky_480x270.mp4"},
      [&](const fs::path& path) { measure_tracked(path.filename().string(), load_video_clip(path, load)); });
  bench::for_each_clip({"textured/waterfall_pool_320x240.mp4", "textured/waterfall_kjos_320x240.mp4"}, measure_water);
}
