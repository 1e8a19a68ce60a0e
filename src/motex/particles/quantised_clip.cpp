// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/quantised_clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "motex/particles/plane_codec.h"

namespace motex {
namespace {

std::int32_t block_of(std::int32_t place, int precision, int size) {
  const std::int64_t blocks = (size + kPlaceBlock - 1) / kPlaceBlock;
  const std::int64_t pixels =
      precision >= 0 ? static_cast<std::int64_t>(place) << precision : static_cast<std::int64_t>(place) >> -precision;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(pixels >> 3, 0, blocks - 1));
}

auto coding_key(const QuantisedClip& clip, const QuantisedCable& cable) {
  const QuantisedState& s = cable.core.states.front();
  return std::make_tuple(cable.first_frame, birth_block(clip, cable.core), cable.core.kind, s.luma, s.scale, s.x, s.y);
}

}  // namespace

std::int32_t birth_block(const QuantisedClip& clip, const QuantisedPath& path) {
  const QuantisedState& first = path.states.front();
  const std::int32_t columns = (clip.width + kPlaceBlock - 1) / kPlaceBlock;
  return block_of(first.y, path.precision, clip.height) * columns + block_of(first.x, path.precision, clip.width);
}

void sort_for_coding(QuantisedClip& clip) {
  std::stable_sort(clip.cables.begin(), clip.cables.end(), [&](const QuantisedCable& a, const QuantisedCable& b) {
    return coding_key(clip, a) < coding_key(clip, b);
  });
}

Base dequantised(const QuantisedClip& clip, const QuantisedPath& path, const QuantisedState& state) {
  Base base;
  base.kind = path.kind;
  base.x = std::ldexp(static_cast<double>(state.x), path.precision);
  base.y = std::ldexp(static_cast<double>(state.y), path.precision);
  base.scale = std::exp2(static_cast<double>(state.scale) / kScaleLevels);
  base.angle = std::numbers::pi * static_cast<double>(state.angle) / kAngleLevels;
  const auto step = static_cast<double>(clip.coefficient_step);
  double luma = step * state.luma;
  base.coefficients[0] = static_cast<float>(luma);
  if (clip.num_planes == 3) {
    double blue = 1.5 * step * state.blue, red = 1.5 * step * state.red;
    to_red_green_blue(luma, blue, red);
    base.coefficients = {static_cast<float>(luma), static_cast<float>(blue), static_cast<float>(red)};
  }
  return base;
}

std::vector<Cable> dequantised_cables(const QuantisedClip& clip) {
  std::vector<Cable> cables;
  cables.reserve(clip.cables.size());
  const auto bases = [&](const QuantisedPath& path) {
    std::vector<Base> list;
    list.reserve(path.states.size());
    for (const QuantisedState& state : path.states) list.push_back(dequantised(clip, path, state));
    return list;
  };
  for (const QuantisedCable& quantised : clip.cables) {
    Cable& cable = cables.emplace_back();
    cable.first_frame = quantised.first_frame;
    cable.core = bases(quantised.core);
    for (const QuantisedPath& coil : quantised.coils) cable.coils.push_back(bases(coil));
  }
  return cables;
}

}  // namespace motex
