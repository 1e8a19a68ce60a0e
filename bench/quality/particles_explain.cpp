// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Recognition: which class of clips explains a clip best. Elements are followed in both halves of each clip; the first
// halves are the models, the second halves are recognised, by likelihood and by traits: with the model of the clip's
// own first half among the models, and without it (only other clips of the class can win).
//   particles_explain [FOLDER]   keeps what was followed in the folder, and reads what is there
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/particle_clips.h"
#include "motex/core/error.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/explain.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_elements.h"
#include "motex/particles/traits.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/textured_motion_file.h"

namespace motex {
namespace {

constexpr std::array<const char*, 4> kClasses{"snow", "birds", "fireworks", "water"};
constexpr int kMostFrames = 80;  // of both halves

std::filesystem::path kept_folder;

struct Halves {
  std::string name;
  std::size_t class_idx = 0;
  TexturedMotion first, second;
};

TexturedMotion followed(const ClipFrames& clip, int from, int num_frames) {
  ClipFrames part;
  part.width = clip.width;
  part.height = clip.height;
  part.luma.assign(clip.luma.begin() + from, clip.luma.begin() + from + num_frames);
  TexturedMotion model;
  model.width = part.width;
  model.height = part.height;
  model.num_frames = num_frames;
  const ClipBackground ground(part, BackgroundKind::kMedian, {});
  model.background = ground.still();
  model.cables = track_elements(part, model.background[0], 0, {});
  return model;
}

/// The half that was followed in an earlier run where there is a folder for them.
TexturedMotion kept(const std::string& name, const std::string& which, const auto& follow) {
  if (kept_folder.empty()) return follow();
  std::string file = name + "_" + which + ".motex";
  std::replace_if(
      file.begin(), file.end(), [](char c) { return c == '/' || c == ' '; }, '_');
  const std::filesystem::path path = kept_folder / file;
  if (!std::filesystem::exists(path)) save_textured_motion(path, follow());
  return load_textured_motion(path);
}

void add(std::vector<Halves>& all, const std::string& name, std::size_t class_idx, const auto& load) {
  std::optional<ClipFrames> clip;
  const auto half_of = [&](int which) {
    return kept(name, which == 0 ? "first" : "second", [&] {
      if (!clip) clip = load();
      const int half = std::min(kMostFrames, clip->num_frames()) / 2;
      return followed(*clip, which * half, half);
    });
  };
  Halves halves{name, class_idx, half_of(0), half_of(1)};
  std::printf("%-34s %s: %zu and %zu elements in %d frames each\n", name.c_str(), kClasses[class_idx],
              halves.first.cables.size(), halves.second.cables.size(), static_cast<int>(halves.first.num_frames));
  std::fflush(stdout);
  if (!halves.first.cables.empty() && !halves.second.cables.empty()) all.push_back(std::move(halves));
}

/// How little the model accounts for the clip: nats, or how far it is in kind.
double distance_of(const Halves& model, const Halves& clip, bool by_traits) {
  return by_traits ? trait_distance(traits_of(model.first), traits_of(clip.second))
                   : -explain_cables(model.first, clip.second).total();
}

void recognise(const std::vector<Halves>& all, bool with_own, bool by_traits) {
  std::array<std::array<int, kClasses.size()>, kClasses.size()> confusion{};
  std::vector<std::string> wrong;
  for (const Halves& clip : all) {
    double best = 1e300;
    const Halves* winner = nullptr;
    for (const Halves& model : all) {
      if (!with_own && &model == &clip) continue;
      const double distance = distance_of(model, clip, by_traits);
      if (distance < best) {
        best = distance;
        winner = &model;
      }
    }
    ++confusion[clip.class_idx][winner->class_idx];
    if (winner->class_idx != clip.class_idx) wrong.push_back(clip.name + " as " + winner->name);
  }
  std::printf("\n%s, %s\n%12s", by_traits ? "by traits" : "by likelihood",
              with_own ? "with the model of the same clip's first half" : "with models of other clips only", "");
  for (const char* name : kClasses) std::printf("%11s", name);
  std::puts("  <- recognised as");
  for (std::size_t truth = 0; truth < kClasses.size(); ++truth) {
    std::printf("%12s", kClasses[truth]);
    for (const int count : confusion[truth]) std::printf("%11d", count);
    std::puts("");
  }
  for (const std::string& name : wrong) std::printf("  wrong: %s\n", name.c_str());
}

int run() {
  const std::vector<std::pair<const char*, std::size_t>> clips{{"textured/snow_forest_320x240.mp4", 0},
                                                               {"textured/snow_birch_480x270.mp4", 0},
                                                               {"dyntex/siims_snow2_64.avi", 0},
                                                               {"synth/synth_snow.mkv", 0},
                                                               {"textured/birds_sky_480x270.mp4", 1},
                                                               {"textured/birds_greenscreen_cg_480x270.mp4", 1},
                                                               {"synth/synth_birds.mkv", 1},
                                                               {"textured/fireworks_repeat_480x270.mp4", 2},
                                                               {"textured/fireworks_single_480x270.mp4", 2},
                                                               {"synth/synth_fireworks.mkv", 2},
                                                               {"textured/waterfall_kjos_320x240.mp4", 3},
                                                               {"textured/waterfall_pool_320x240.mp4", 3},
                                                               {"dyntex/siims_waterfall1_64.avi", 3}};
  std::vector<Halves> all;
  for (const auto& [name, class_idx] : clips)
    bench::for_each_clip({name}, [&, name = name, class_idx = class_idx](const std::filesystem::path& path) {
      add(all, name, class_idx, [&] { return load_video_clip(path); });
    });
  for (const std::uint64_t seed : {5U, 6U}) {
    SimulateSnowOptions snow;
    snow.seed = seed;
    add(all, "simulated snow " + std::to_string(seed), 0, [&] { return clip_frames_of(simulate_snow(snow)); });
    SimulateBirdsOptions birds;
    birds.seed = seed;
    add(all, "simulated birds " + std::to_string(seed), 1, [&] { return clip_frames_of(simulate_birds(birds)); });
    SimulateFireworksOptions fireworks;
    fireworks.seed = seed;
    add(all, "simulated fireworks " + std::to_string(seed), 2,
        [&] { return clip_frames_of(simulate_fireworks(fireworks)); });
  }
  for (const bool by_traits : {false, true})
    for (const bool with_own : {true, false}) recognise(all, with_own, by_traits);
  return 0;
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  if (argc > 1) motex::kept_folder = argv[1];
  return motex::run();
}
