// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/particles/bird_flight.h"
#include "motex/particles/bird_mesh.h"
#include "motex/particles/frame_painter.h"

namespace motex {

/// Colours of a bird in the light, grey levels 0 … 255.
struct BirdColours {
  std::array<float, 3> body{40, 42, 48};
  std::array<float, 3> haze{200, 205, 210};  ///< what far birds fade into
};

/// A bird as pixels: straight colour and coverage, for a box of the picture.
struct BirdSprite {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> colour;  ///< 3 a pixel, weighted by coverage
  std::vector<float> alpha;   ///< coverage 0 … 1
};

/// Perspective view of the bird's mesh with flat shading (sun behind the camera, above), hidden surfaces removed per
/// sample, 4 × 4 samples a pixel. focal: pixels. Empty when nothing of it is inside the picture.
BirdSprite view_bird(const BirdPose& bird, double focal, int width, int height, const BirdColours& colours);

/// One bird from above its right side, on a clear ground: what a state of the wings looks like ([TM02] Figure 6).
Image bird_portrait(const WingPosture& wings, int side, const BirdColours& colours = {});

/// Movetons of birds as 3-D birds ([TM02] Figure 6) instead of their bases: BirdFlock, drawn farthest first.
class BirdPainter : public FramePainter {
 public:
  /// background: 1 or 3 planes of the magnified size. Species darker than it are dark birds of its tint, brighter ones
  /// bright: a bird is opaque, and how much light its blurred bases take away says nothing of its colour.
  BirdPainter(const TexturedMotion& model, Planes background, double magnification,
              const BirdFlightOptions& options = {});
  void paint(const MovetonFrame& frame, Image& picture, Image& layer) override;

 private:
  const BirdColours& colours_of(int species) const;

  BirdFlock flock_;
  double magnification_;
  Image background_;
  std::vector<BirdColours> colours_;  // one a species, and one more for movetons of none
};

}  // namespace motex
