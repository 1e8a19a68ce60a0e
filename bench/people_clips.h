// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "motex/people/measure_silhouette.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"
#include "motex/project/keyed_footage.h"
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

/// A clip without cuts, keyed.
inline PeopleClip load_keyed(const std::string& path) {
  PeopleClip clip;
  KeyedFootage footage(path);
  clip.texture.width = footage.info().width, clip.texture.height = footage.info().height;
  clip.texture.frames_per_sec = footage.info().frames_per_sec;
  for (KeyedFrame frame; footage.next(frame);) add_frame(clip, std::move(frame.sprite));
  clip.texture.takes = {{path, 0, 0, false, {0, clip.texture.num_frames()}}};
  return clip;
}

}  // namespace motex::bench
