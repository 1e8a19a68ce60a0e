// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Recognition: which class of clips explains a clip best. Elements are followed in both halves of each clip; the first
// halves are the models, the second halves are recognised, by likelihood and by traits: with the model of the clip's
// own first half among the models, and without it (only other clips of the class can win). Then pieces that no weight
// was chosen by: other parts in time of the clips, mirrored and cropped, against other clips alone; other seeds; and
// other clips.
//   particles_explain [FOLDER]   keeps what was followed in the folder, and reads what is there
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
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

/// One clip: what was followed in its halves, or in a piece of it alone.
struct Halves {
  std::string name, clip;
  std::size_t class_idx = 0;
  TexturedMotion first, second;
};

/// 30 frames of a clip.
struct Piece {
  const char* clip;
  std::size_t class_idx;
  int first_frame;
  bool turned;  ///< mirrored, and its borders cut off
};

constexpr int kPieceFrames = 30;

ClipFrames part_of(const ClipFrames& clip, int from, int num_frames) {
  ClipFrames part;
  part.width = clip.width;
  part.height = clip.height;
  part.luma.assign(clip.luma.begin() + from, clip.luma.begin() + from + num_frames);
  return part;
}

TexturedMotion followed(const ClipFrames& part) {
  const int num_frames = part.num_frames();
  TexturedMotion model;
  model.width = part.width;
  model.height = part.height;
  model.num_frames = num_frames;
  const ClipBackground ground(part, BackgroundKind::kMedian, {});
  model.background = ground.still();
  model.cables = track_elements(part, model.background[0], 0, {});
  return model;
}

/// Left is right, and an eighth of the picture is cut off on each side.
void turn(ClipFrames& clip) {
  const int left = clip.width / 8, top = clip.height / 8;
  clip.width -= 2 * left;
  clip.height -= 2 * top;
  for (Plane& luma : clip.luma) {
    Plane out(clip.width, clip.height);
    for (int y = 0; y < clip.height; ++y)
      for (int x = 0; x < clip.width; ++x) out.at(x, y) = luma.at(left + clip.width - 1 - x, top + y);
    luma = std::move(out);
  }
}

/// What was followed in an earlier run where there is a folder for it.
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
      return followed(part_of(*clip, which * half, half));
    });
  };
  Halves halves{name, name, class_idx, half_of(0), half_of(1)};
  std::printf("%-42s %s: %zu and %zu elements in %d frames each\n", name.c_str(), kClasses[class_idx],
              halves.first.cables.size(), halves.second.cables.size(), static_cast<int>(halves.first.num_frames));
  std::fflush(stdout);
  if (!halves.first.cables.empty() && !halves.second.cables.empty()) all.push_back(std::move(halves));
}

void add_piece(std::vector<Halves>& all, const std::string& clip, const std::string& name, std::size_t class_idx,
               const auto& load) {
  Halves piece{name, clip, class_idx, {}, kept(name, "piece", [&] {
                 const ClipFrames frames = load();
                 return followed(part_of(frames, 0, std::min(kPieceFrames, frames.num_frames())));
               })};
  std::printf("%-56s %s: %zu elements\n", name.c_str(), kClasses[class_idx], piece.second.cables.size());
  std::fflush(stdout);
  if (!piece.second.cables.empty()) all.push_back(std::move(piece));
}

/// [clip][model]: how little the first half of the model accounts for the second half or piece of the clip: nats, or
/// how far it is in kind.
using Distances = std::vector<std::vector<double>>;

Distances by_likelihood(const std::vector<Halves>& models, const std::vector<Halves>& clips) {
  Distances out;
  for (const Halves& clip : clips) {
    std::vector<double>& row = out.emplace_back();
    for (const Halves& model : models) row.push_back(-explain_cables(model.first, clip.second).total());
  }
  return out;
}

Distances by_traits(const std::vector<Halves>& models, const std::vector<Halves>& clips) {
  std::vector<ClipTraits> known;
  for (const Halves& model : models) known.push_back(traits_of(model.first));
  Distances out;
  for (const Halves& clip : clips) {
    const ClipTraits traits = traits_of(clip.second);
    std::vector<double>& row = out.emplace_back();
    for (const ClipTraits& model : known) row.push_back(trait_distance(model, traits));
  }
  return out;
}

/// Clips among models, those of the same clip too or of others alone.
void recognise(const char* how, const std::vector<Halves>& models, const std::vector<Halves>& clips,
               const Distances& distances, bool with_own) {
  std::array<std::array<int, kClasses.size()>, kClasses.size()> confusion{};
  std::vector<std::string> wrong;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const Halves& clip = clips[c];
    double best = 1e300;
    const Halves* winner = nullptr;
    for (std::size_t m = 0; m < models.size(); ++m) {
      if ((!with_own && models[m].clip == clip.clip) || distances[c][m] >= best) continue;
      best = distances[c][m];
      winner = &models[m];
    }
    if (winner == nullptr) continue;
    ++confusion[clip.class_idx][winner->class_idx];
    if (winner->class_idx != clip.class_idx) wrong.push_back(clip.name + " as " + winner->name);
  }
  std::printf("\n%s, %s\n%12s", how,
              with_own ? "with the model of the same clip's first half" : "with models of other clips only", "");
  for (const char* name : kClasses) std::printf("%11s", name);
  std::puts("  <- recognised as");
  for (std::size_t truth = 0; truth < kClasses.size(); ++truth) {
    std::printf("%12s", kClasses[truth]);
    for (const int count : confusion[truth]) std::printf("%11d", count);
    std::puts("");
  }
  for (const std::string& name : wrong) std::printf("  wrong: %s\n", name.c_str());
  std::fflush(stdout);
}

/// Calls add(name, class, load) for the simulated scenes of these seeds.
void for_simulated(std::initializer_list<std::uint64_t> seeds, const auto& add_scene) {
  for (const std::uint64_t seed : seeds) {
    SimulateSnowOptions snow;
    snow.seed = seed;
    add_scene("simulated snow " + std::to_string(seed), 0, [&] { return clip_frames_of(simulate_snow(snow)); });
    SimulateBirdsOptions birds;
    birds.seed = seed;
    add_scene("simulated birds " + std::to_string(seed), 1, [&] { return clip_frames_of(simulate_birds(birds)); });
    SimulateFireworksOptions fireworks;
    fireworks.seed = seed;
    add_scene("simulated fireworks " + std::to_string(seed), 2,
              [&] { return clip_frames_of(simulate_fireworks(fireworks)); });
  }
}

std::vector<Halves> halves_of_clips() {
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
  for_simulated({5, 6}, [&](const std::string& name, std::size_t class_idx, const auto& load) {
    add(all, name, class_idx, load);
  });
  return all;
}

std::vector<Halves> unseen_pieces() {
  const std::vector<Piece> pieces{{"textured/snow_forest_320x240.mp4", 0, 85, false},
                                  {"dyntex/siims_snow2_64.avi", 0, 70, true},
                                  {"textured/birds_sky_480x270.mp4", 1, 110, false},
                                  {"textured/birds_greenscreen_cg_480x270.mp4", 1, 85, true},
                                  {"textured/fireworks_repeat_480x270.mp4", 2, 110, false},
                                  {"textured/fireworks_single_480x270.mp4", 2, 110, false},
                                  {"textured/waterfall_pool_320x240.mp4", 3, 85, false},
                                  {"textured/waterfall_pool_320x240.mp4", 3, 20, true},
                                  {"textured/waterfall_kjos_320x240.mp4", 3, 85, false},
                                  {"textured/waterfall_kjos_320x240.mp4", 3, 20, true},
                                  {"dyntex/siims_waterfall1_64.avi", 3, 59, false},
                                  {"dyntex/dyntex_55fa210_boiling_water.avi", 3, 0, false},
                                  {"dyntex/dyntex_6486110_fountain.avi", 3, 0, false}};
  std::vector<Halves> all;
  for (const Piece& piece : pieces)
    bench::for_each_clip({piece.clip}, [&](const std::filesystem::path& path) {
      const std::string name =
          std::string(piece.clip) + " from " + std::to_string(piece.first_frame) + (piece.turned ? ", turned" : "");
      add_piece(all, piece.clip, name, piece.class_idx, [&] {
        ClipFrames clip = load_video_clip(path, {piece.first_frame, kPieceFrames});
        if (piece.turned) turn(clip);
        return clip;
      });
    });
  for_simulated({7, 8}, [&](const std::string& name, std::size_t class_idx, const auto& load) {
    add_piece(all, name, name, class_idx, load);
  });
  return all;
}

int run() {
  std::vector<Halves> clips = halves_of_clips();
  const Distances traits = by_traits(clips, clips);
  for (const bool with_own : {true, false}) recognise("by traits", clips, clips, traits, with_own);
  const std::vector<Halves> pieces = unseen_pieces();
  recognise("by traits, pieces of 30 frames", clips, pieces, by_traits(clips, pieces), false);
  for (Halves& clip : clips)  // once, not for every clip that is explained
    clip.first.maps = estimate_maps(clip.first.cables, clip.first.width, clip.first.height, clip.first.num_frames);
  const Distances nats = by_likelihood(clips, clips);
  for (const bool with_own : {true, false}) recognise("by likelihood", clips, clips, nats, with_own);
  return 0;
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  if (argc > 1) motex::kept_folder = argv[1];
  return motex::run();
}
