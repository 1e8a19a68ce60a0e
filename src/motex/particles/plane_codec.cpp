// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/plane_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace motex {
namespace {

constexpr int kSide = 8;
constexpr int kArea = kSide * kSide;
constexpr double kDifferenceStep = 1.5;
constexpr double kRounding = 0.4;  // of the magnitude: cheaper than ½ and hardly worse

using Block = std::array<float, kArea>;
using Levels = std::array<std::int32_t, kArea>;

/// Row k: the k-th cosine, unit norm.
const Block& cosines() {
  static const Block table = [] {
    Block t{};
    for (int k = 0; k < kSide; ++k)
      for (int x = 0; x < kSide; ++x)
        t[static_cast<std::size_t>(k * kSide + x)] = static_cast<float>(
            std::sqrt((k == 0 ? 1.0 : 2.0) / kSide) * std::cos(std::numbers::pi * k * (x + 0.5) / kSide));
    return t;
  }();
  return table;
}

/// C · block · Cᵀ, or Cᵀ · block · C.
Block transformed(const Block& block, bool forward) {
  const Block& c = cosines();
  const auto entry = [&](int k, int x) {
    return forward ? c[static_cast<std::size_t>(k * kSide + x)] : c[static_cast<std::size_t>(x * kSide + k)];
  };
  Block half{}, result{};
  for (int y = 0; y < kSide; ++y)
    for (int k = 0; k < kSide; ++k) {
      float sum = 0;
      for (int x = 0; x < kSide; ++x) sum += entry(k, x) * block[static_cast<std::size_t>(y * kSide + x)];
      half[static_cast<std::size_t>(y * kSide + k)] = sum;
    }
  for (int k = 0; k < kSide; ++k)
    for (int x = 0; x < kSide; ++x) {
      float sum = 0;
      for (int y = 0; y < kSide; ++y) sum += entry(k, y) * half[static_cast<std::size_t>(y * kSide + x)];
      result[static_cast<std::size_t>(k * kSide + x)] = sum;
    }
  return result;
}

/// Places by rising frequency: diagonal by diagonal, to and fro.
const std::array<int, kArea>& zigzag() {
  static const std::array<int, kArea> order = [] {
    std::array<int, kArea> places{};
    std::size_t next = 0;
    for (int sum = 0; sum <= 2 * (kSide - 1); ++sum)
      for (int k = 0; k <= sum; ++k) {
        const int y = sum % 2 == 0 ? sum - k : k, x = sum - y;
        if (x < kSide && y < kSide) places[next++] = y * kSide + x;
      }
    return places;
  }();
  return order;
}

/// Models of one plane. Contexts: how many coefficients the last block had, frequency, size of the last two levels.
struct PlaneModels {
  NumberModel mean;
  std::array<NumberModel, 4> count;
  std::array<std::array<NumberModel, 3>, 6> level;
};

template <typename Coder>
void code_block(Coder& coder, PlaneModels& models, Levels& levels, std::int32_t expected_mean, int& last_count) {
  levels[0] = expected_mean + code_number(coder, models.mean, levels[0] - expected_mean);
  int count = 0;
  for (int k = 1; k < kArea; ++k)
    if (levels[static_cast<std::size_t>(k)] != 0) count = k;
  const int busy = last_count == 0 ? 0 : last_count < 4 ? 1 : last_count < 12 ? 2 : 3;
  count = code_count(coder, models.count[static_cast<std::size_t>(busy)], count);
  if (count >= kArea) coder.fail("a block of the background has too many coefficients");
  last_count = count;
  int before = 0;
  for (int k = 1; k <= count; ++k) {
    const auto band = static_cast<std::size_t>(k < 3 ? 0 : k < 6 ? 1 : k < 10 ? 2 : k < 21 ? 3 : k < 36 ? 4 : 5);
    auto& level = levels[static_cast<std::size_t>(k)];
    level = code_number(coder, models.level[band][static_cast<std::size_t>(std::min(before, 2))], level);
    before = (std::abs(level) + before + 1) / 2;
  }
}

/// Walks over the blocks of a plane: `block(x, y)` before the levels are coded and `done(x, y)` after.
template <typename Coder, typename Before, typename After>
void code_plane(Coder& coder, int width, int height, const Before& before, const After& after) {
  PlaneModels models;
  const int columns = (width + kSide - 1) / kSide, rows = (height + kSide - 1) / kSide;
  std::vector<std::int32_t> above(static_cast<std::size_t>(columns), 0);
  for (int row = 0; row < rows; ++row) {
    std::int32_t left = row == 0 ? 0 : above[0];
    int last_count = 0;
    for (int column = 0; column < columns; ++column) {
      const auto at = static_cast<std::size_t>(column);
      Levels levels{};
      before(column * kSide, row * kSide, levels);
      const std::int32_t expected = row == 0 ? left : (left + above[at]) / 2;
      code_block(coder, models, levels, expected, last_count);
      if (std::abs(levels[0]) > 1 << 26) coder.fail("a mean of the background is out of range");
      left = above[at] = levels[0];
      after(column * kSide, row * kSide, levels);
    }
  }
}

double step_of(std::size_t plane, double step) { return plane == 0 ? step : kDifferenceStep * step; }

std::int32_t level_of(double value, double step) {
  const double size = std::floor(std::abs(value) / step + kRounding);
  return static_cast<std::int32_t>(std::copysign(std::min(size, 1e7), value));
}

template <typename Turn>
void turn_colours(Planes& planes, const Turn& turn) {
  if (planes.size() != 3) return;
  for (std::size_t i = 0; i < planes[0].values.size(); ++i)
    turn(planes[0].values[i], planes[1].values[i], planes[2].values[i]);
}

}  // namespace

void write_planes(RangeWriter& writer, const Planes& planes, double step) {
  Planes turned = planes;
  turn_colours(turned, [](float& a, float& b, float& c) { to_luma_and_differences(a, b, c); });
  for (std::size_t k = 0; k < turned.size(); ++k) {
    const Plane& plane = turned[k];
    const auto levels_at = [&](int left, int top, Levels& levels) {
      Block block{};
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          block[static_cast<std::size_t>(y * kSide + x)] =
              plane.at(std::min(left + x, plane.width - 1), std::min(top + y, plane.height - 1));
      const Block waves = transformed(block, true);
      for (std::size_t i = 0; i < kArea; ++i)
        levels[i] = level_of(static_cast<double>(waves[static_cast<std::size_t>(zigzag()[i])]), step_of(k, step));
    };
    code_plane(writer, plane.width, plane.height, levels_at, [](int, int, const Levels&) {});
  }
}

Planes read_planes(RangeReader& reader, int width, int height, int num_planes, double step) {
  Planes planes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(num_planes); ++k) {
    Plane plane(width, height);
    const auto put = [&](int left, int top, const Levels& levels) {
      Block waves{};
      for (std::size_t i = 0; i < kArea; ++i)
        waves[static_cast<std::size_t>(zigzag()[i])] =
            static_cast<float>(static_cast<double>(levels[i]) * step_of(k, step));
      const Block block = transformed(waves, false);
      for (int y = 0; y < std::min(kSide, height - top); ++y)
        for (int x = 0; x < std::min(kSide, width - left); ++x)
          plane.at(left + x, top + y) = block[static_cast<std::size_t>(y * kSide + x)];
    };
    code_plane(
        reader, width, height, [](int, int, Levels&) {}, put);
    planes.push_back(std::move(plane));
  }
  turn_colours(planes, [](float& a, float& b, float& c) { to_red_green_blue(a, b, c); });
  return planes;
}

}  // namespace motex
