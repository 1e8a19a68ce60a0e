// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "motex/core/error.h"
#include "motex/people/measure_silhouette.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"
#include "motex/project/people_footage.h"
#include "motex/project/simulate_actor.h"
#include "motex/video_io/video_reader.h"

namespace motex::bench {

/// Footage of one actor as sprites.
struct PeopleClip {
  PeopleTexture texture;
  std::vector<Sprite> sprites;
};

inline void add_frame(PeopleClip& clip, Sprite sprite) {
  clip.texture.silhouettes.push_back(measure_silhouette(sprite));
  clip.sprites.push_back(std::move(sprite));
}

/// dancer1: a green screen and its true matte as a second video; takes end at the hard cuts.
inline PeopleClip load_dancer(const std::string& folder) {
  PeopleClip clip;
  VideoReader colour(folder + "/dancer1_fullbody_green_640x360.mp4");
  VideoReader matte(folder + "/dancer1_fullbody_matte_640x360.mkv");
  for (VideoFrame frame, alpha; colour.next(frame) && matte.next(alpha);) {
    for (std::size_t i = 0; i < frame.image.pixels.size(); ++i) {
      Rgba& pixel = frame.image.pixels[i];
      pixel.a = alpha.image.pixels[i].g < 8 ? std::uint8_t{0} : alpha.image.pixels[i].g;
      pixel.g = std::min(pixel.g, std::max(pixel.r, pixel.b));
    }
    add_frame(clip, sprite_of(frame.image));
    clip.texture.width = frame.image.width, clip.texture.height = frame.image.height;
  }
  clip.texture.frames_per_sec = 30;
  const std::vector<int> starts{0, 335, 531, 769, clip.texture.num_frames()};
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
    clip.texture.takes.push_back({"dancer1", starts[i], 0, false, {starts[i], starts[i + 1] - starts[i]}});
  return clip;
}

/// A puppet moved by motion capture, cut out by its true alpha.
inline PeopleClip load_simulated(int num_frames) {
  SimulateActorOptions options;
  options.frames = num_frames;
  const ActorSimulation simulation(options);
  PeopleClip clip;
  clip.texture.width = options.width, clip.texture.height = options.height;
  clip.texture.frames_per_sec = options.frames_per_sec;
  for (int frame = 0; frame < num_frames; ++frame) add_frame(clip, simulation.sprite(frame, 0));
  clip.texture.takes = {{"simulated", 0, 0, false, {0, num_frames}}};
  return clip;
}

/// A clip read as `motex people learn` reads it: hard cuts found, keyed, one take a person and shot.
inline PeopleClip load_keyed(const std::string& path) {
  std::map<int, std::vector<Sprite>> tracks;
  const PeopleFootage footage =
      read_people_footage(path, {}, [&](int track, int, const Sprite& sprite) { tracks[track].push_back(sprite); });
  PeopleClip clip;
  clip.texture = people_texture_of(footage);
  for (const FilmedTake& take : footage.takes) {
    std::vector<Sprite>& sprites = tracks.at(take.track);
    if (static_cast<int>(sprites.size()) != take.take.frames.length)
      throw InvalidInput("a take of " + path + " has not as many pictures as frames");
    for (Sprite& sprite : sprites) clip.sprites.push_back(std::move(sprite));
  }
  return clip;
}

}  // namespace motex::bench
