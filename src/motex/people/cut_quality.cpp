// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/cut_quality.h"

#include <algorithm>

#include "motex/core/error.h"
#include "motex/image/ssim.h"
#include "motex/people/align_sprites.h"
#include "motex/people/flow_warp.h"
#include "motex/people/measure_silhouette.h"

namespace motex {
namespace {

constexpr float kGrey = 128;

Plane luma_over_grey(const Sprite& sprite, const BoundingBox& box) {
  Plane plane(box.width(), box.height(), kGrey);
  for (int y = 0; y < sprite.height; ++y) {
    for (int x = 0; x < sprite.width; ++x) {
      const auto& [r, g, b, alpha] = sprite.at(x, y);
      plane.at(sprite.left + x - box.left, sprite.top + y - box.top) =
          luma_of<float>(r, g, b) + (255 - static_cast<float>(alpha)) * (kGrey / 255);
    }
  }
  return plane;
}

void mark(const Sprite& sprite, const BoundingBox& box, Plane& seen) {
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x)
      if (sprite.at(x, y)[3] > 0) seen.at(sprite.left + x - box.left, sprite.top + y - box.top) = 1;
}

}  // namespace

double sprite_ssim(const Sprite& a, const Sprite& b) {
  const BoundingBox box = joined(box_of(a), box_of(b));
  if (box.empty()) return 1;
  Plane seen(box.width(), box.height());
  mark(a, box, seen), mark(b, box, seen);
  const Plane map = ssim_map(luma_over_grey(a, box), luma_over_grey(b, box));
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < map.values.size(); ++i) sum += seen.values[i] * map.values[i], count += seen.values[i];
  return count > 0 ? sum / count : 1;
}

double flow_warp_error(const Sprite& a, const Sprite& b) {
  const PlacedSprite from{a, {}}, to{b, {}};
  const SpriteFlow flow = sprite_flow(from, to);
  if (flow.box.empty()) return 0;
  return sprite_difference(flow_morph(from, to, flow, 1, 0), b);
}

CutQuality cut_quality(const std::vector<Sprite>& frames, const SecondDifferenceScales& scales) {
  if (frames.size() < 4) throw InvalidInput("the quality of a cut needs two frames before and two after it");
  CutQuality quality;
  std::vector<Silhouette> silhouettes;
  for (const Sprite& frame : frames) silhouettes.push_back(measure_silhouette(frame));
  quality.smoothness = film_smoothness(silhouettes, scales);
  const std::size_t last = frames.size() - 1;
  quality.ssim = std::min(sprite_ssim(frames[1], frames[2]), sprite_ssim(frames[last - 2], frames[last - 1]));
  for (std::size_t t = 1; t + 2 < frames.size(); ++t)
    quality.flow_error += flow_warp_error(frames[t], frames[t + 1]) / static_cast<double>(frames.size() - 3);
  return quality;
}

}  // namespace motex
