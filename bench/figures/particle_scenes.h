// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "motex/core/files.h"
#include "motex/particles/bird_painter.h"
#include "motex/particles/birth_death.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/frame_painter.h"
#include "motex/particles/learn.h"
#include "motex/particles/simulate.h"
#include "motex/particles/stray_light.h"
#include "motex/particles/synthesize.h"
#include "motex/particles/water_synthesis.h"
#include "motex/project/base_sketch.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/particle_pictures.h"
#include "motex/project/textured_motion_file.h"

/// Clips that the figures of [TM02] are made from, and their learned models.
namespace motex::bench {

struct Scene {
  std::string what;  ///< "snow"
  std::string name;  ///< the file, or "simulated"
  ClipFrames clip;
  TexturedMotion model;
  int least_path = 5;  ///< frames, of paths that are shown
  int columns = 3;     ///< pictures in a row

  int frame_of_column(int column, int num_columns) const {
    return (2 * column + 1) * clip.num_frames() / (2 * num_columns);
  }
  int num_shown_paths() const {
    int count = 0;
    for (const Cable& cable : model.cables) count += cable.num_frames() >= least_path ? 1 : 0;
    return count;
  }
};

/// The first of the files that is there, from frame `first` on; "" when none is.
inline std::filesystem::path find_clip(const std::filesystem::path& data, std::initializer_list<const char*> names) {
  if (!data.empty())
    for (const char* name : names)
      for (const auto& path : {data / "video/textured" / name, data / "textured" / name, data / name})
        if (std::filesystem::is_regular_file(path)) return path;
  return {};
}

/// Learning takes minutes: with MOTEX_FIGURE_MODELS = a folder, models are kept there and taken from there.
/// Cables as linked: rounds of sampling take minutes more, and make no difference that a picture of this size shows.
inline void learn(Scene& scene, LearnTexturedMotionOptions options = {}) {
  options.rounds = 0;
  const char* kept = std::getenv("MOTEX_FIGURE_MODELS");
  std::filesystem::path file;
  if (kept != nullptr && *kept != '\0') file = std::filesystem::path(kept) / (scene.what + "_" + scene.name + ".motex");
  if (!file.empty() && std::filesystem::is_regular_file(file)) {
    scene.model = load_textured_motion(file);
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  LearnedTexturedMotion learned = learn_textured_motion(scene.clip, options);
  scene.model = std::move(learned.model);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("%s (%s): %d frames, %zu cables, %zu templates, %.1f s\n", scene.what.c_str(), scene.name.c_str(),
              scene.clip.num_frames(), scene.model.cables.size(), scene.model.templates.size(), took.count());
  if (!file.empty()) write_file(file, textured_motion_bytes(scene.model));
}

inline Scene make_scene(const std::string& what, const std::filesystem::path& path, int first, int num_frames,
                        const auto& simulate) {
  Scene scene;
  scene.what = what;
  if (path.empty()) {
    scene.name = "simulated";
    scene.clip = clip_frames_of(simulate());
  } else {
    scene.name = path.filename().string();
    LoadVideoClipOptions load;
    load.first_frame = first;
    load.num_frames = num_frames;
    scene.clip = load_video_clip(path, load);
  }
  return scene;
}

inline Scene snow_scene(const std::filesystem::path& data) {
  Scene scene = make_scene("snow", find_clip(data, {"snow_forest_320x240.mp4"}), 0, 30, [] {
    SimulateSnowOptions options;
    options.frames = 60;
    return simulate_snow(options);
  });
  learn(scene);
  return scene;
}

/// Simulated: the shared clips of birds may not be shown in the repository.
inline Scene bird_scene() {
  Scene scene = make_scene("birds", {}, 0, 0, [] { return simulate_birds({}); });
  learn(scene);
  return scene;
}

/// Birds near enough for their wings to be seen.
inline Scene flapping_scene() {
  SimulateBirdsOptions options;
  options.seed = 7;
  Scene scene = make_scene("flapping birds", {}, 0, 0, [&] { return simulate_birds(options); });
  learn(scene);
  return scene;
}

inline Scene firework_scene(const std::filesystem::path& data) {
  Scene scene = make_scene("fireworks", find_clip(data, {"fireworks_repeat_480x270.mp4"}), 0, 60,
                           [] { return simulate_fireworks({}); });
  learn(scene);
  return scene;
}

inline bool waterfall_scene(const std::filesystem::path& data, Scene& scene) {
  const std::filesystem::path path = find_clip(data, {"waterfall_kjos_320x240.mp4"});
  if (path.empty()) return false;
  scene = make_scene("waterfall", path, 0, 0, [] { return SimulatedScene(); });
  learn(scene);
  scene.least_path = 20;
  if (scene.model.maps.source.values.empty()) {  // water is synthesized without them
    MapOptions options;
    options.bandwidth = 8;
    options.bridge_gaps = options.find_bursts = false;
    scene.model.maps =
        estimate_maps(scene.model.cables, scene.model.width, scene.model.height, scene.model.num_frames, options);
  }
  return true;
}

/// The same water as separate elements: what drops look like. From half as many frames.
inline Scene drop_scene(const std::filesystem::path& data) {
  Scene scene =
      make_scene("drops", find_clip(data, {"waterfall_kjos_320x240.mp4"}), 0, 12, [] { return SimulatedScene(); });
  LearnTexturedMotionOptions options;
  options.tracking = TrackingKind::kCores;
  learn(scene, options);
  return scene;
}

/// Evenly over as many synthesized frames as the clip has.
inline std::vector<Image> synthesized_pictures(const Scene& scene, const SynthesizeParticlesOptions& options,
                                               int count) {
  std::unique_ptr<MovetonSource> source;
  std::unique_ptr<FramePainter> painter;
  if (scene.model.water) {
    source = std::make_unique<WaterSource>(scene.model, WaterReplayOptions(), options.seed);
    painter = std::make_unique<WaterPainter>(scene.model, scene.model.background, 1, options.seed);
  } else {
    source = std::make_unique<CableSynthesizer>(scene.model, options);
    painter = std::make_unique<PhotoPainter>(scene.model.background, 1, 3, element_light(scene.model));
  }
  std::vector<Image> pictures;
  MovetonFrame frame;
  Image picture, layer;
  for (int t = 0; static_cast<int>(pictures.size()) < count && source->next_frame(frame); ++t) {
    painter->paint(frame, picture, layer);
    if (t == scene.frame_of_column(static_cast<int>(pictures.size()), count)) pictures.push_back(picture);
  }
  return pictures;
}

/// Pale blue above, paler below.
inline Planes sky(int width, int height) {
  Planes planes(3, Plane(width, height));
  for (int y = 0; y < height; ++y) {
    const float down = static_cast<float>(y) / static_cast<float>(height);
    for (int x = 0; x < width; ++x) {
      planes[0].at(x, y) = 150 + 70 * down;
      planes[1].at(x, y) = 180 + 50 * down;
      planes[2].at(x, y) = 215 + 25 * down;
    }
  }
  return planes;
}

/// Synthesized birds as 3-D birds, before another sky.
inline std::vector<Image> pictures_in_space(const Scene& scene, int count, int magnification) {
  CableSynthesizer source(scene.model, {});
  BirdPainter painter(scene.model, sky(scene.model.width * magnification, scene.model.height * magnification),
                      magnification);
  std::vector<Image> pictures;
  MovetonFrame frame;
  Image picture, layer;
  for (int t = 0; static_cast<int>(pictures.size()) < count && source.next_frame(frame); ++t) {
    painter.paint(frame, picture, layer);
    if (t == scene.frame_of_column(static_cast<int>(pictures.size()), count)) pictures.push_back(picture);
  }
  return pictures;
}

/// Whether no other cable's core lies in the square.
inline bool stands_alone(const TexturedMotion& model, const Cable& cable, std::int64_t frame, double half) {
  const Base& core = cable.at(frame);
  return std::none_of(model.cables.begin(), model.cables.end(), [&](const Cable& other) {
    return &other != &cable && other.covers(frame) && std::abs(other.at(frame).x - core.x) < half &&
           std::abs(other.at(frame).y - core.y) < half;
  });
}

/// Squares of `reach` core scales to each side about elements of a species in a state, cut out of the clip: one a cable
/// in turn, spread over its life, standing alone.
inline std::vector<Image> cut_outs(const Scene& scene, int species, int state, int count) {
  constexpr double kReach = 4.5;
  std::vector<Image> out;
  for (std::int64_t visit = 0; visit < 12; ++visit)
    for (const Cable& cable : scene.model.cables) {
      if (cable.species != species || static_cast<int>(out.size()) == count) continue;
      std::int64_t seen = 0;
      for (std::size_t t = 0; t < cable.core.size(); ++t) {
        const int here = cable.poses.size() == cable.core.size() ? cable.poses[t] : 0;
        const Base& core = cable.core[t];
        const int half = std::max(6, static_cast<int>(std::lround(kReach * core.scale)));
        const int left = static_cast<int>(std::lround(core.x)) - half,
                  top = static_cast<int>(std::lround(core.y)) - half;
        const std::int64_t frame = cable.first_frame + static_cast<std::int64_t>(t);
        const bool inside =
            left >= 0 && top >= 0 && left + 2 * half < scene.clip.width && top + 2 * half < scene.clip.height;
        if (here != state || !inside || !stands_alone(scene.model, cable, frame, half) || seen++ != 3 * visit) continue;
        out.push_back(
            crop(to_image(frame_planes(scene.clip, static_cast<int>(frame))), left, top, 2 * half + 1, 2 * half + 1));
        break;
      }
    }
  return out;
}

/// The movetons with most light among those of at least three bases, alone on grey, each as bright as can be, and
/// their symbols below.
inline std::vector<PictureRow> drop_pictures(const TexturedMotion& model, int count) {
  constexpr int kSide = 33, kMagnification = 5;
  std::vector<std::pair<double, const Cable*>> strongest;
  for (const Cable& cable : model.cables) {
    if (cable.coils.size() < 2) continue;
    const Base& core = cable.core[cable.core.size() / 2];
    strongest.emplace_back(-std::abs(static_cast<double>(core.coefficients[0])), &cable);
  }
  std::stable_sort(strongest.begin(), strongest.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PictureRow> rows{{"as light", {}}, {"as symbols", {}}};
  for (std::size_t k = 0; k < strongest.size() && static_cast<int>(k) < count; ++k) {
    const Cable& cable = *strongest[k].second;
    const std::size_t middle = cable.core.size() / 2;
    std::vector<Base> bases{cable.core[middle]};
    for (const std::vector<Base>& coil : cable.coils) bases.push_back(coil[middle]);
    const double dx = 0.5 * (kSide - 1) - bases[0].x, dy = 0.5 * (kSide - 1) - bases[0].y;
    for (Base& base : bases) base.x += dx, base.y += dy;
    Plane light(kSide * kMagnification, kSide * kMagnification);
    Planes planes{light};
    BaseRenderer(kMagnification).add(bases, planes);
    float most = 1e-6F;
    for (const float value : planes[0].values) most = std::max(most, std::abs(value));
    for (float& value : planes[0].values) value = 128 + 120 * value / most;
    rows[0].pictures.push_back(to_image(planes[0]));
    rows[1].pictures.push_back(render(base_sketch({kSide, kSide, 1, bases}, kMagnification)));
  }
  return rows;
}

}  // namespace motex::bench
