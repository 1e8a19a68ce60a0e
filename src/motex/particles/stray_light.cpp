// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/stray_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "motex/core/quantile.h"
#include "motex/particles/carry_bases.h"
#include "motex/particles/render.h"

namespace motex {
namespace {

constexpr std::size_t kMostSamples = 6;  // frames of a cable
constexpr int kReach = 16;               // pixels around the core that are looked at
constexpr double kOneSign = 0.75;        // of the light, for a clip of one sign
constexpr std::int64_t kMostPictures = 12;
constexpr float kSeen = 1;       // grey level: light that shows
constexpr double kUsual = 0.95;  // of light of the wrong sign
constexpr double kStray = 0.3;   // of the strongest light of the right sign
constexpr double kOften = 0.25;  // of the frames

std::vector<std::size_t> sampled_frames(const Cable& cable) {
  const std::size_t num = std::min(kMostSamples, cable.core.size());
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < num; ++k) frames.push_back((2 * k + 1) * cable.core.size() / (2 * num));
  return frames;
}

/// Extreme lights of all its bases, all planes together.
struct Extremes {
  double darkest = 0, brightest = 0;
};

Extremes extremes_of(const Cable& cable, std::size_t frame, BaseRenderer& renderer) {
  std::vector<Base> bases{cable.core[frame]};
  for (const std::vector<Base>& coil : cable.coils) bases.push_back(coil[frame]);
  const double left = std::round(bases[0].x) - kReach, top = std::round(bases[0].y) - kReach;
  for (Base& base : bases) {
    base.x -= left;
    base.y -= top;
    base.coefficients[0] = std::accumulate(base.coefficients.begin(), base.coefficients.end(), 0.0F);
  }
  Planes light(1, Plane(2 * kReach + 1, 2 * kReach + 1));
  renderer.add(bases, light);
  const auto [darkest, brightest] = std::minmax_element(light[0].values.begin(), light[0].values.end());
  return {std::min(0.0, static_cast<double>(*darkest)), std::max(0.0, static_cast<double>(*brightest))};
}

}  // namespace

std::vector<char> find_stray_light(const TexturedMotion& model) {
  std::vector<char> is_stray(model.cables.size(), 0);
  std::vector<std::vector<Extremes>> seen(model.cables.size());
  double dark = 0, bright = 0;
  BaseRenderer renderer;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Cable& cable = model.cables[k];
    if (cable.coils.empty()) continue;
    const std::vector<std::size_t> frames = sampled_frames(cable);
    for (const std::size_t frame : frames) {
      seen[k].push_back(extremes_of(cable, frame, renderer));
      const double weight = static_cast<double>(cable.core.size()) / static_cast<double>(frames.size());
      dark -= weight * seen[k].back().darkest;
      bright += weight * seen[k].back().brightest;
    }
  }
  if (std::max(dark, bright) < kOneSign * (dark + bright)) return is_stray;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    double num_stray = 0;
    for (const Extremes& one : seen[k]) {
      const double right = dark > bright ? -one.darkest : one.brightest;
      const double wrong = dark > bright ? one.brightest : -one.darkest;
      num_stray += wrong > kStray * right ? 1 : 0;
    }
    is_stray[k] = num_stray > kOften * static_cast<double>(seen[k].size()) ? 1 : 0;
  }
  return is_stray;
}

ElementLight element_light(const TexturedMotion& model) {
  std::vector<double> dark, bright;
  BaseRenderer renderer(1, model.num_planes);
  const std::int64_t num = std::min<std::int64_t>(kMostPictures, model.num_frames);
  for (std::int64_t k = 0; k < num; ++k) {
    const std::int64_t frame = (2 * k + 1) * model.num_frames / (2 * num);
    Planes light(static_cast<std::size_t>(model.num_planes), Plane(model.width, model.height));
    renderer.add(bases_in_frame(model.cables, frame, model.width, model.height, model.num_planes).bases, light);
    for (const Plane& plane : light)
      for (const float value : plane.values)
        if (std::abs(value) > kSeen) (value < 0 ? dark : bright).push_back(std::abs(value));
  }
  const double all_dark = std::accumulate(dark.begin(), dark.end(), 0.0);
  const double all_bright = std::accumulate(bright.begin(), bright.end(), 0.0);
  ElementLight limits;
  const auto usual = [](std::vector<double>& of) {
    return of.empty() ? kSeen : static_cast<float>(quantile(std::move(of), kUsual));
  };
  if (all_dark >= kOneSign * (all_dark + all_bright) && all_dark > 0) limits.brightest = usual(bright);
  if (all_bright >= kOneSign * (all_dark + all_bright) && all_bright > 0) limits.darkest = -usual(dark);
  return limits;
}

}  // namespace motex
