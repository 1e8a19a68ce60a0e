// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/filter_bank.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/image/pyramid.h"

namespace motex {
namespace {

double scale_of(int number) {
  return kMinScale * std::pow(kMaxScale / kMinScale, static_cast<double>(number) / (kNumScales - 1));
}

int level_of(double scale) { return std::max(0, static_cast<int>(std::floor(std::log2(scale)))); }

std::vector<Base> bases_of_scale(double scale, Dictionary dictionary) {
  std::vector<Base> bases{Base{BaseKind::kLog, 0, 0, scale, 0, {}}};
  if (dictionary == Dictionary::kExtended) bases.push_back({BaseKind::kGaussian, 0, 0, scale, 0, {}});
  for (const BaseKind kind : {BaseKind::kGaborCos, BaseKind::kGaborSin})
    for (int k = 0; k < kNumOrientations; ++k)
      bases.push_back({kind, 0, 0, scale, k * std::numbers::pi / kNumOrientations, {}});
  return bases;
}

/// The base as it looks on the level, divided by its energy there.
std::vector<float> matched_window(Base base, int level) {
  const int step = 1 << level, middle = step * (kFilterReach + 2), side = 2 * middle + 1;
  base.x = base.y = middle;
  Plane plane(side, side);
  add_patch(plane, render_patch(base, side, side), 1);
  for (int k = 0; k < level; ++k) plane = halve(plane);
  std::vector<float> window;
  double energy = 0;
  for (int y = 2; y < 2 + kFilterWindow; ++y)
    for (int x = 2; x < 2 + kFilterWindow; ++x) {
      window.push_back(plane.at(x, y));
      energy += static_cast<double>(window.back()) * window.back();
    }
  for (float& tap : window) tap = static_cast<float>(tap / energy);
  return window;
}

}  // namespace

std::vector<LevelFilters> make_filter_bank(Dictionary dictionary, int width, int height) {
  std::vector<LevelFilters> bank;
  for (int number = 0; number < kNumScales; ++number) {
    const int level = level_of(scale_of(number));
    if (level > 0 && std::min(width, height) < 4 << level) break;
    if (bank.empty() || bank.back().level != level) bank.push_back({level, 1 << level, {}, {}});
    for (const Base& base : bases_of_scale(scale_of(number), dictionary)) bank.back().bases.push_back(base);
  }
  for (LevelFilters& filters : bank) {
    const std::size_t num = filters.bases.size();
    filters.taps.resize(num * kFilterWindow * kFilterWindow);
    for (std::size_t j = 0; j < num; ++j) {
      const std::vector<float> window = matched_window(filters.bases[j], filters.level);
      for (std::size_t i = 0; i < window.size(); ++i) filters.taps[i * num + j] = window[i];
    }
  }
  return bank;
}

}  // namespace motex
