// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "motex/image/image.h"
#include "motex/people/sprite.h"

namespace motex {

enum class ScreenColour { kGreen, kBlue, kPlain };

/// The screen that puppets stand before, and the camera's noise.
struct PuppetStageOptions {
  ScreenColour screen = ScreenColour::kGreen;
  double unevenness = 0.25;  ///< share of light that is missing at the edges of the picture
  double shadow = 0.15;      ///< share of light that a body takes from the floor about its feet
  double noise = 2;          ///< grey levels, deviation of every channel
  std::uint64_t seed = 1;
};

/// Makes pictures of puppets: light falls off unevenly over the screen, a body shades the floor under it, the camera
/// adds normal noise.
class PuppetStage {
 public:
  PuppetStage(int width, int height, const PuppetStageOptions& options);

  /// The empty, uneven screen without noise.
  const Image& screen() const { return screen_; }
  /// Colour in the middle of the screen.
  static Rgba screen_colour(ScreenColour screen);
  /// The floor darkens under where a body stands: (x, y) the middle between its feet, pixels.
  void shade_floor(Image& image, double x, double y, double pixels_per_metre) const;
  /// The same for the same seed, frame by frame.
  void add_noise(Image& image, int frame) const;

 private:
  PuppetStageOptions options_;
  Image screen_;
  std::vector<std::int8_t> noise_;  // 1/4 grey levels; rows begin at random places of it
};

}  // namespace motex
