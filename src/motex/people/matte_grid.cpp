// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/matte_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace motex {
namespace {

std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// Two rows of pixels added up, byte by byte; a missing last column is the one before.
void add_rows(const Image& image, int row, int width, std::vector<std::int16_t>& sums) {
  const auto* upper = &image.at(0, 2 * row).r;
  const auto* lower = &image.at(0, std::min(2 * row + 1, image.height - 1)).r;
  const std::size_t count = size(image.width) * 4;
  sums.resize(size(width) * 8);
  for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::int16_t>(upper[i] + lower[i]);
  for (std::size_t i = count; i < sums.size(); ++i) sums[i] = sums[i - 4];
}

void differences_of_row(const Image& frame, const PlateGrid& plate, int row, float* differences,
                        std::vector<std::int16_t>& sums) {
  add_rows(frame, row, plate.width, sums);
  const std::int16_t* background = plate.sums.data() + size(row) * size(plate.width) * 8;
  const float* inverse = plate.inverse_variances.data() + size(row) * size(plate.width);
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = static_cast<std::int16_t>(sums[i] - background[i]);
  for (std::size_t x = 0; x < size(plate.width); ++x) {
    const std::int16_t* s = sums.data() + 8 * x;
    const int r = s[0] + s[4], g = s[1] + s[5], b = s[2] + s[6];
    differences[x] = static_cast<float>(r * r + g * g + b * b) * inverse[x];
  }
}

/// Clears away specks; fills holes whose squares differ too much to be background.
void tidy(const MatteGridLimits& limits, MatteGrid& grid) {
  find_regions(grid.actor, grid.regions);
  const std::vector<MaskRegion>& regions = grid.regions.regions;
  grid.difference_sums.assign(regions.size(), 0);
  for (const RegionRun& run : grid.regions.runs) {
    const MaskRegion& region = regions[size(run.region)];
    if (!region.value && region.at_border) continue;
    const float* row = grid.differences.data() + size(run.y) * size(grid.width);
    double sum = 0;
    for (int x = run.first; x <= run.last; ++x) sum += row[x];
    grid.difference_sums[size(run.region)] += sum;
  }
  const auto is_wrong = [&](int idx) {
    const MaskRegion& region = regions[size(idx)];
    const auto area = static_cast<double>(region.area);
    if (region.value) return area < limits.min_area;
    return !region.at_border && grid.difference_sums[size(idx)] > area * (6 + 10 / std::sqrt(area));
  };
  grid.box = {grid.width, grid.height, -1, -1};
  for (const RegionRun& run : grid.regions.runs) {
    const bool value = regions[size(run.region)].value != is_wrong(run.region);
    std::fill_n(&grid.actor.at(run.first, run.y), run.last - run.first + 1, value ? 1 : 0);
    if (!value) continue;
    grid.box.left = std::min(grid.box.left, run.first), grid.box.right = std::max(grid.box.right, run.last);
    grid.box.top = std::min(grid.box.top, run.y), grid.box.bottom = run.y;
  }
}

/// One square wider, cut to the grid.
BoundingBox widened(const MatteGrid& grid) {
  return {std::max(0, grid.box.left - 1), std::max(0, grid.box.top - 1), std::min(grid.width - 1, grid.box.right + 1),
          std::min(grid.height - 1, grid.box.bottom + 1)};
}

/// Smallest of the 3 × 3 neighbours' values; beyond the frame the actor goes on.
void find_depths(MatteGrid& grid) {
  const auto at = [&](int x, int y) { return size(y) * size(grid.width) + size(x); };
  const BoundingBox box = widened(grid);
  grid.depths.resize(grid.actor.pixels.size());
  grid.rim.resize(grid.actor.pixels.size());
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) grid.depths[at(x, y)] = grid.actor.at(x, y) ? 1 : 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; ++x) {
      std::uint8_t most = 0;
      for (int v = std::max(box.top, y - 1); v <= std::min(box.bottom, y + 1); ++v)
        for (int u = std::max(box.left, x - 1); u <= std::min(box.right, x + 1); ++u)
          most = std::max(most, grid.depths[at(u, v)]);
      grid.rim[at(x, y)] = most != 0 && grid.depths[at(x, y)] == 0 ? 1 : 0;
    }
  }
  grid.eroded.resize(grid.depths.size());
  for (int depth = 1; depth < MatteGrid::kInside; ++depth) {
    for (int y = box.top; y <= box.bottom; ++y) {
      for (int x = box.left; x <= box.right; ++x) {
        bool inside = grid.depths[at(x, y)] == depth;
        for (int v = std::max(box.top, y - 1); inside && v <= std::min(box.bottom, y + 1); ++v)
          for (int u = std::max(box.left, x - 1); inside && u <= std::min(box.right, x + 1); ++u)
            inside = grid.depths[at(u, v)] >= depth;
        grid.eroded[at(x, y)] = inside ? 1 : 0;
      }
    }
    for (int y = box.top; y <= box.bottom; ++y)
      for (int x = box.left; x <= box.right; ++x)
        grid.depths[at(x, y)] = static_cast<std::uint8_t>(grid.depths[at(x, y)] + grid.eroded[at(x, y)]);
  }
}

constexpr int kReach = 2;  // of one pass of the mean, squares

/// Means over ± kReach squares along a line, by running sums of a line with zeros beyond its ends.
void sum_along(const std::array<float, 4>* from, std::array<float, 4>* to, int count, std::size_t step) {
  std::array<float, 4> sum{};
  const auto add = [&](int i, float sign) {
    if (i < 0 || i >= count) return;
    for (std::size_t c = 0; c < 4; ++c) sum[c] += sign * from[size(i) * step][c];
  };
  for (int i = 0; i < kReach; ++i) add(i, 1);
  for (int i = 0; i < count; ++i) {
    add(i + kReach, 1);
    to[size(i) * step] = sum;
    add(i - kReach, -1);
  }
}

void carry_colours(const Image& frame, MatteGrid& grid) {
  constexpr std::array<float, MatteGrid::kInside + 1> kWeights{0, 0.001F, 0.05F, 1, 1};
  const BoundingBox box = widened(grid);
  grid.inner_colours.resize(grid.actor.pixels.size());
  grid.blurred.resize(grid.actor.pixels.size());
  const auto at = [&](int x, int y) { return size(y) * size(grid.width) + size(x); };
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; ++x) {
      const float weight = kWeights[grid.depths[at(x, y)]];
      std::array<float, 4>& sum = grid.inner_colours[at(x, y)];
      sum = {};
      if (weight == 0) continue;
      const int right = std::min(2 * x + 1, frame.width - 1), bottom = std::min(2 * y + 1, frame.height - 1);
      const Rgba &a = frame.at(2 * x, 2 * y), &b = frame.at(right, 2 * y), &c = frame.at(2 * x, bottom),
                 &d = frame.at(right, bottom);
      sum = {weight * static_cast<float>(a.r + b.r + c.r + d.r), weight * static_cast<float>(a.g + b.g + c.g + d.g),
             weight * static_cast<float>(a.b + b.b + c.b + d.b), 4 * weight};
    }
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = box.top; y <= box.bottom; ++y)
      sum_along(&grid.inner_colours[at(box.left, y)], &grid.blurred[at(box.left, y)], box.width(), 1);
    for (int x = box.left; x <= box.right; ++x)
      sum_along(&grid.blurred[at(x, box.top)], &grid.inner_colours[at(x, box.top)], box.height(), size(grid.width));
  }
}

}  // namespace

PlateGrid plate_grid(const CleanPlate& plate, const Mask& garbage) {
  PlateGrid grid;
  grid.width = (plate.picture.width + 1) / 2, grid.height = (plate.picture.height + 1) / 2;
  std::vector<std::int16_t> row;
  for (int y = 0; y < grid.height; ++y) {
    add_rows(plate.picture, y, grid.width, row);
    grid.sums.insert(grid.sums.end(), row.begin(), row.end());
    for (int x = 0; x < grid.width; ++x) {
      const float noise = plate.noise.at(x, y);
      const bool left_out = garbage.width > 0 && garbage.at(2 * x, 2 * y);
      grid.inverse_variances.push_back(left_out ? 0 : 1 / (4 * noise * noise));
    }
  }
  return grid;
}

void find_actor(const Image& frame, const PlateGrid& plate, const MatteGridLimits& limits, MatteGrid& grid) {
  if (grid.width != plate.width || grid.height != plate.height) {
    grid.width = plate.width, grid.height = plate.height;
    grid.actor = Mask(plate.width, plate.height);
    grid.differences.resize(grid.actor.pixels.size());
  }
  std::vector<std::int16_t> sums;
  for (int y = 0; y < grid.height; ++y)
    differences_of_row(frame, plate, y, grid.differences.data() + size(y) * size(grid.width), sums);
  const auto limit = static_cast<float>(limits.difference);
  for (std::size_t i = 0; i < grid.differences.size(); ++i) grid.actor.pixels[i] = grid.differences[i] >= limit ? 1 : 0;
  tidy(limits, grid);
  if (grid.box.empty()) return;
  find_depths(grid);
  carry_colours(frame, grid);
}

}  // namespace motex
