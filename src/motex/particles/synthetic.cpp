// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/synthetic.h"

#include <algorithm>
#include <cmath>

#include "motex/core/rng.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/simulated_picture.h"

namespace motex {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr double kLevel = 50, kPeak = 100, kScale = 1.5, kRight = 1, kDown = 2;
constexpr double kColumn = 16, kRow = 13;  // of the grid that falls

}  // namespace

FallingDots make_falling_dots(int num_frames, double noise, std::uint64_t seed) {
  FallingDots dots;
  dots.clip.width = kWidth;
  dots.clip.height = kHeight;
  dots.background = Plane(kWidth, kHeight, static_cast<float>(kLevel));
  std::vector<Planes> frames(static_cast<std::size_t>(num_frames), Planes{dots.background});
  // a grid that falls past the picture, every second row shifted, each dot a little off its place
  const int before = static_cast<int>(num_frames * kDown / kRow) + 1, left = static_cast<int>(num_frames / kColumn) + 1;
  Rng places = Rng(seed).fork(1);
  for (int row = -before; row * kRow < kHeight; ++row) {
    for (int column = -left; column * kColumn < kWidth; ++column) {
      const double x0 = kColumn * (column + 0.3 + (row % 2 != 0 ? 0.5 : 0)) + places.uniform(-1.5, 1.5);
      const double y0 = kRow * (row + 0.5) + places.uniform(-1, 1);
      Cable cable;
      for (int t = 0; t < num_frames; ++t) {
        const double x = x0 + kRight * t, y = y0 + kDown * t;
        add_blob(frames[static_cast<std::size_t>(t)], {x, y, kScale, kScale, 0, {kPeak}});
        if (!is_inside(x, y, kWidth, kHeight)) continue;
        if (cable.core.empty()) cable.first_frame = t;
        Base base{BaseKind::kGaussian, x, y, kScale, 0, {}};
        base.coefficients.fill(static_cast<float>(coefficient_of_peak(base, kPeak)));
        cable.core.push_back(base);
      }
      if (!cable.core.empty()) dots.cables.push_back(std::move(cable));
    }
  }
  std::stable_sort(dots.cables.begin(), dots.cables.end(),
                   [](const Cable& a, const Cable& b) { return a.first_frame < b.first_frame; });
  Rng grain = Rng(seed).fork(2);
  for (Planes& frame : frames) dots.clip.luma.push_back(luma(noisy_picture(std::move(frame), noise, grain)));
  return dots;
}

TexturedMotion make_falling_dots_model(int num_frames) {
  FallingDots dots = make_falling_dots(num_frames);
  TexturedMotion model;
  model.width = kWidth;
  model.height = kHeight;
  model.num_frames = num_frames;
  model.source = "falling dots";
  model.background = {dots.background};
  model.noise = 1;
  model.flow = {kRight, kDown, 100};
  MovetonTemplate dot;
  dot.poses.resize(1);
  dot.pose_transitions = TransitionMatrix(1, 1);
  dot.log_scale = {std::log(kScale), 0};
  dot.amplitude = {kPeak, 0};
  dot.colour.fill({1, 0});
  model.templates = {dot};
  for (Cable& cable : dots.cables) cable.species = 0;
  model.cables = std::move(dots.cables);
  model.dynamics = {fit_dynamics(model.cables)};
  model.maps = estimate_maps(model.cables, kWidth, kHeight, num_frames);
  return model;
}

}  // namespace motex
