// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

// Figures 1 to 4 of [PT04], for people_figures.cpp.

#include <cstdio>
#include <filesystem>
#include <string>

#include "bench/simulated_people.h"
#include "motex/image/planes.h"
#include "motex/people/footage_motifs.h"
#include "motex/people/measure_silhouette.h"
#include "motex/people/paper_motifs.h"
#include "motex/plot/drawing.h"
#include "motex/project/keyed_footage.h"
#include "motex/project/load_people.h"
#include "motex/project/motif_pictures.h"

namespace motex::bench {

/// Frame, grey with the background taken away, threshold with bounding box and centroid.
inline void draw_stages(const std::string& clip, int number, const std::filesystem::path& path) {
  KeyFootageOptions options;
  options.frames = {number - 15, 30};
  KeyedFootage footage(clip, options);
  KeyedFrame frame;
  while (footage.next(frame) && frame.idx != number) {
  }
  VideoReader reader(clip);
  reader.seek(number);
  VideoFrame raw;
  reader.next(raw);
  const int width = raw.image.width, height = raw.image.height;
  const Silhouette silhouette = measure_silhouette(frame.sprite);
  Image actor(width, height, {0, 0, 0, 255}), mask = actor;
  paint(actor, frame.sprite);
  const Image cut = to_image(frame.sprite, width, height);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    if (cut.pixels[i].a >= 128) mask.pixels[i] = {255, 255, 255, 255};
  Drawing drawing;
  const double w = 420, h = w * height / width, scale = w / width;
  drawing.width = 3 * w + 16, drawing.height = h;
  drawing.add(Picture{{0, 0}, w, h, raw.image});
  drawing.add(Picture{{w + 8, 0}, w, h, to_image(luma(actor))});
  drawing.add(Picture{{2 * w + 16, 0}, w, h, mask});
  const double x = 2 * w + 16 + scale * silhouette.box.left, y = scale * silhouette.box.top;
  const double right = x + scale * silhouette.box.width(), bottom = y + scale * silhouette.box.height();
  const Rgba red{220, 40, 40, 255};
  drawing.add(Polyline{{{x, y}, {right, y}, {right, bottom}, {x, bottom}, {x, y}}, red, 2, 0});
  drawing.add(Disc{{2 * w + 16 + scale * silhouette.centroid_x, scale * silhouette.centroid_y}, 4, red});
  write_picture(path, drawing);
}

/// Frames of a simulated actor.
class SimulatedPictures : public FramePictures {
 public:
  explicit SimulatedPictures(const ActorSimulation& scene) : scene_(scene) {}
  Image picture(int frame) override { return scene_.frame(frame).image; }

 private:
  const ActorSimulation& scene_;
};

/// Figure 1 of the dancer; 2, 3 and 4 of a puppet that motion capture moves, since the clips that may be shown repeat
/// no action; 2 as the paper searches: random projection of the aspect ratio.
inline void draw_motif_figures(const std::string& clips, const std::filesystem::path& folder) {
  draw_stages(clips + "/dancer1_fullbody_green_640x360.mp4", 290, folder / "people_textures_1.png");
  SimulateActorOptions options;
  options.actions = "left_kick,right_kick,bow";
  options.frames = 1200;
  options.seed = 3;
  const ActorSimulation scene(options);
  PeopleTexture texture = texture_of(scene, options);
  FindMotifsOptions paper;
  paper.window = 40;
  const PaperMotifReport found = find_paper_motifs(texture, paper);
  std::printf("figure 2: %zu cells, closest pair %.3f times the exact\n",
              found.searches[0].found.collisions.back().cells.size(), found.searches[0].matrix_over_exact());
  write_picture(folder / "people_textures_2.png", draw_collisions(found.searches));
  texture.alphabet = find_footage_motifs(texture).set;
  std::printf("figures 3 and 4: %zu actions\n", texture.alphabet.motifs.size());
  if (texture.alphabet.motifs.empty()) return;
  SimulatedPictures pictures(scene);
  write_picture(folder / "people_textures_3.png", draw_motif_matches(texture));
  write_picture(folder / "people_textures_4.png", draw_filmstrips(texture, pictures, 3));
}

}  // namespace motex::bench
