// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/matte_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "motex/core/wide.h"

namespace motex {
namespace {

constexpr float kCertain = 3;     // times the limit: squares that show the actor for sure
constexpr int kGrowth = 3;        // squares; how far from these less different ones are believed
constexpr float kTrace = 0.002F;  // of the mean difference of what is certain: what differs less is blur or ringing
constexpr double kFilled = 0.7;   // of the limit: holes that differ as much on average are no background
constexpr float kPale = 0.02F;    // of the mean difference of what is certain: seven tenths or more of it is background
constexpr float kEmpty = 0.004F;  // likewise: all of it is
constexpr int kSmallHole = 100;   // squares; larger holes have an inside that blur does not reach
constexpr double kEmptyShare = 0.15;  // of the squares of a small hole
constexpr double kFaint = 0.015;      // of the largest part's mean difference: what differs less is a trace of light

std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// Light of the frame to that of the plate, over squares whose colour is near the plate's.
std::array<float, 3> frame_gains(const SquareSums& frame, const SquareSums& plate, const LightRange& light) {
  constexpr int kStep = 6;
  constexpr float kDark = 40;  // added to both: what is dark says little about light
  std::array<float, 3> gains{1, 1, 1};
  for (const float reach : {14.0F, 7.0F}) {
    std::array<float, 3> seen{}, expected{};
    int count = 0, all = 0;
    for (int y = kStep / 2; y < frame.height; y += kStep) {
      for (int x = kStep / 2; x < frame.width; x += kStep, ++all) {
        const std::size_t i = frame.index(x, y);
        std::array<float, 3> s{}, p{};
        for (std::size_t c = 0; c < 3; ++c) s[c] = frame.channels[c][i], p[c] = plate.channels[c][i];
        const std::array<float, 3> g{gains[0] * p[0], gains[1] * p[1], gains[2] * p[2]};
        const float square = squared_difference(s[0] - g[0], s[1] - g[1], s[2] - g[2], g[0], g[1], g[2], light);
        if (square > 16 * 3 * reach * reach) continue;
        for (std::size_t c = 0; c < 3; ++c) seen[c] += s[c], expected[c] += p[c];
        ++count;
      }
    }
    if (count * 10 < all) return {1, 1, 1};
    const float dark = kDark * static_cast<float>(count);
    for (std::size_t c = 0; c < 3; ++c) gains[c] = std::clamp((seen[c] + dark) / (expected[c] + dark), 0.8F, 1.25F);
  }
  return gains;
}

MOTEX_WIDE void find_differences(const SquareSums& frame, const PlateGrid& plate, const std::array<float, 3>& gains,
                                 const LightRange& light, float* out) {
  const std::size_t count = plate.inverse_variances.size();
  const std::uint16_t *r = frame.channels[0].data(), *g = frame.channels[1].data(), *b = frame.channels[2].data();
  const std::uint16_t *pr = plate.sums.channels[0].data(), *pg = plate.sums.channels[1].data(),
                      *pb = plate.sums.channels[2].data();
  const float* inverse = plate.inverse_variances.data();
  const float gr = gains[0], gg = gains[1], gb = gains[2];
  const LightRange range = light;
  for (std::size_t i = 0; i < count; ++i) {
    const float er = gr * static_cast<float>(pr[i]), eg = gg * static_cast<float>(pg[i]),
                eb = gb * static_cast<float>(pb[i]);
    out[i] = inverse[i] * squared_difference(static_cast<float>(r[i]) - er, static_cast<float>(g[i]) - eg,
                                             static_cast<float>(b[i]) - eb, er, eg, eb, range);
  }
}

MOTEX_WIDE void mark_from(const float* values, std::size_t count, float limit, std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = values[i] >= limit ? 1 : 0;
}

MOTEX_WIDE void largest_of_three(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, std::size_t count,
                                 std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t most = a[i] > b[i] ? a[i] : b[i];
    out[i] = most > c[i] ? most : c[i];
  }
}

MOTEX_WIDE void keep_both(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = a[i] & b[i];
}

/// Rim: what is widened but not of the actor; depths begin with 1 in the actor, `outside` is 1 elsewhere.
MOTEX_WIDE void begin_depths(const std::uint8_t* actor, std::size_t count, std::uint8_t* rim, std::uint8_t* depths,
                             std::uint8_t* outside) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t not_actor = actor[i] ^ 1;
    rim[i] &= not_actor;
    depths[i] = actor[i];
    outside[i] = not_actor;
  }
}

MOTEX_WIDE void deepen(const std::uint8_t* outside, std::size_t count, std::uint8_t* depths) {
  for (std::size_t i = 0; i < count; ++i) depths[i] = static_cast<std::uint8_t>(depths[i] + (outside[i] ^ 1));
}

/// Largest of the 3 × 3 neighbours inside the rows top … bottom; beyond them and the grid nothing is there.
void widen(const std::vector<std::uint8_t>& from, int width, int top, int bottom, std::vector<std::uint8_t>& line,
           std::vector<std::uint8_t>& to) {
  const std::size_t count = size(width);
  line.resize(count);
  for (int y = top; y <= bottom; ++y) {
    const std::uint8_t* mid = from.data() + size(y) * count;
    const std::uint8_t *up = y > top ? mid - count : mid, *down = y < bottom ? mid + count : mid;
    largest_of_three(up, mid, down, count, line.data());
    std::uint8_t* out = to.data() + size(y) * count;
    if (width < 3) {
      std::fill_n(out, count, *std::max_element(line.begin(), line.end()));
      continue;
    }
    largest_of_three(line.data(), line.data() + 1, line.data() + 2, count - 2, out + 1);
    out[0] = std::max(line[0], line[1]);
    out[count - 1] = std::max(line[count - 1], line[count - 2]);
  }
}

/// Mean of the values from `limit` on, of every eighth; 0 without any.
float mean_from(const std::vector<float>& values, float limit) {
  float sum = 0;
  int count = 0;
  for (std::size_t i = 3; i < values.size(); i += 8)
    if (values[i] >= limit) sum += std::min(values[i], 1e5F), ++count;
  return count == 0 ? 0 : sum / static_cast<float>(count);
}

/// Certain squares and what differs near them.
void grow(const MatteGridLimits& limits, MatteGrid& grid) {
  const std::size_t count = grid.differences.size();
  std::vector<std::uint8_t>& actor = grid.actor.pixels;
  const float certain = kCertain * static_cast<float>(limits.difference);
  grid.contrast = mean_from(grid.differences, certain);
  const float limit = std::max(static_cast<float>(limits.difference), kTrace * grid.contrast);
  mark_from(grid.differences.data(), count, kCertain * limit, actor.data());
  mark_from(grid.differences.data(), count, limit, grid.level.data());
  for (int step = 0; step < kGrowth; ++step) {
    widen(actor, grid.width(), 0, grid.height() - 1, grid.line, grid.next_level);
    keep_both(grid.next_level.data(), grid.level.data(), count, actor.data());
  }
}

/// Clears away specks and traces; fills holes whose squares differ too much to be background.
void tidy(const MatteGridLimits& limits, MatteGrid& grid) {
  find_regions(grid.actor, grid.regions);
  const std::vector<MaskRegion>& regions = grid.regions.regions;
  grid.difference_sums.assign(regions.size(), 0);
  for (const RegionRun& run : grid.regions.runs) {
    const MaskRegion& region = regions[size(run.region)];
    if (!region.value && region.at_border) continue;
    const float* row = grid.differences.data() + grid.sums.index(0, run.y);
    float sum = 0;
    for (int x = run.first; x <= run.last; ++x) sum += row[x];
    grid.difference_sums[size(run.region)] += sum;
  }
  std::size_t largest = regions.size();
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i].value && (largest == regions.size() || regions[i].area > regions[largest].area)) largest = i;
  const auto mean = [&](std::size_t i) { return grid.difference_sums[i] / static_cast<double>(regions[i].area); };
  const double faint = largest == regions.size() ? 0 : kFaint * mean(largest);
  const auto is_wrong = [&](int idx) {
    const MaskRegion& region = regions[size(idx)];
    const auto area = static_cast<double>(region.area);
    if (region.value) return area < limits.min_area || mean(size(idx)) < faint;
    return !region.at_border &&
           (area < limits.min_hole || mean(size(idx)) > kFilled * limits.difference + 10 / std::sqrt(area));
  };
  grid.box = {grid.width(), grid.height(), -1, -1};
  for (const RegionRun& run : grid.regions.runs) {
    const bool value = regions[size(run.region)].value != is_wrong(run.region);
    std::fill_n(&grid.actor.at(run.first, run.y), run.last - run.first + 1, std::uint8_t{value});
    if (!value) continue;
    grid.box.left = std::min(grid.box.left, run.first), grid.box.right = std::max(grid.box.right, run.last);
    grid.box.top = std::min(grid.box.top, run.y), grid.box.bottom = run.y;
  }
}

/// Opens small holes again, over which blur and the filling of holes have gone: enclosed places that differ little from
/// a coloured screen, some of them hardly at all.
void open_small_holes(const MatteGridLimits& limits, MatteGrid& grid) {
  const BoundingBox& box = grid.box;
  Mask& pale = grid.pale;
  pale.width = box.width(), pale.height = box.height();
  pale.pixels.resize(size(pale.width) * size(pale.height));
  const float limit = kPale * grid.contrast;
  for (int y = 0; y < pale.height; ++y) {
    const std::size_t row = grid.sums.index(box.left, box.top + y);
    for (int x = 0; x < pale.width; ++x) {
      const std::size_t i = row + size(x);
      pale.at(x, y) = grid.actor.pixels[i] == 0 || grid.differences[i] < limit ? 1 : 0;
    }
  }
  find_regions(pale, grid.regions);
  const std::vector<MaskRegion>& regions = grid.regions.regions;
  const auto may_be_hole = [&](const RegionRun& run) {
    const MaskRegion& region = regions[size(run.region)];
    return region.value && !region.at_border && region.area <= kSmallHole;
  };
  const float empty = std::max(static_cast<float>(limits.difference), kEmpty * grid.contrast);
  std::vector<double>& num_empty = grid.difference_sums;
  num_empty.assign(regions.size(), 0);
  for (const RegionRun& run : grid.regions.runs) {
    if (!may_be_hole(run)) continue;
    const float* row = grid.differences.data() + grid.sums.index(box.left, box.top + run.y);
    num_empty[size(run.region)] +=
        static_cast<double>(std::count_if(row + run.first, row + run.last + 1, [&](float d) { return d < empty; }));
  }
  for (const RegionRun& run : grid.regions.runs)
    if (may_be_hole(run) &&
        num_empty[size(run.region)] >= kEmptyShare * static_cast<double>(regions[size(run.region)].area))
      std::fill_n(&grid.actor.at(box.left + run.first, box.top + run.y), run.last - run.first + 1, std::uint8_t{0});
}

/// Depth of each square by wearing away from where the actor is not; beyond the frame he goes on.
void find_depths(MatteGrid& grid) {
  const BoundingBox box = grid.rim_box();
  const std::size_t begin = grid.sums.index(0, box.top), count = grid.sums.index(0, box.bottom + 1) - begin;
  const std::vector<std::uint8_t>& actor = grid.actor.pixels;
  widen(actor, grid.width(), box.top, box.bottom, grid.line, grid.rim);
  begin_depths(&actor[begin], count, &grid.rim[begin], &grid.depths[begin], &grid.level[begin]);
  for (int depth = 1; depth < MatteGrid::kInside; ++depth) {
    widen(grid.level, grid.width(), box.top, box.bottom, grid.line, grid.next_level);
    std::swap(grid.level, grid.next_level);
    deepen(&grid.level[begin], count, &grid.depths[begin]);
  }
}

using Weighted = std::array<float, 4>;
constexpr int kReach = 2;  // squares on either side, of one of two passes of the mean

MOTEX_WIDE void sum_of_five(const float* a, const float* b, const float* c, const float* d, const float* e,
                            std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = a[i] + b[i] + c[i] + d[i] + e[i];
}

/// Sums over ± kReach squares each way; lines outside the box are zero.
void sum_around(const BoundingBox& box, std::size_t stride, const std::vector<Weighted>& from,
                std::vector<Weighted>& line, std::vector<Weighted>& to) {
  static const std::vector<Weighted> kNothing(16384 + 1);
  const std::size_t count = size(box.width());
  line.assign(count + 2 * kReach, Weighted{});
  const auto row = [&](int y) {
    return y < box.top || y > box.bottom ? kNothing[0].data() : from[size(y) * stride + size(box.left)].data();
  };
  for (int y = box.top; y <= box.bottom; ++y) {
    sum_of_five(row(y - 2), row(y - 1), row(y), row(y + 1), row(y + 2), 4 * count, line[kReach].data());
    sum_of_five(line[0].data(), line[1].data(), line[2].data(), line[3].data(), line[4].data(), 4 * count,
                to[size(y) * stride + size(box.left)].data());
  }
}

void carry_colours(MatteGrid& grid) {
  // Squares at the rim are mixed with the background, those next to them may be by a camera's or codec's blur.
  constexpr std::array<float, MatteGrid::kInside + 1> kWeights{0, 0.001F, 0.3F, 1, 1, 1, 1};
  constexpr std::array<float, MatteGrid::kInside + 1> kDeepWeights{0, 1e-5F, 1e-4F, 0.003F, 0.05F, 0.3F, 1};
  constexpr int kCell = MatteGrid::kCell;
  const BoundingBox box = grid.rim_box();
  const float full = 1 / std::max(1.0F, grid.contrast);
  grid.cells_across = (grid.width() + kCell - 1) / kCell;
  std::fill(grid.cells.begin(), grid.cells.end(), Weighted{});
  const std::uint16_t *red = grid.sums.channels[0].data(), *green = grid.sums.channels[1].data(),
                      *blue = grid.sums.channels[2].data();
  for (int y = box.top; y <= box.bottom; ++y) {
    Weighted* cells = &grid.cells[size(y / kCell) * size(grid.cells_across)];
    for (int x = box.left; x <= box.right; ++x) {
      const std::size_t i = grid.sums.index(x, y);
      const std::uint8_t depth = grid.depths[i];
      Weighted& out = grid.weighted[i];
      out = {};
      if (depth == 0) continue;
      const Weighted colour{static_cast<float>(red[i]), static_cast<float>(green[i]), static_cast<float>(blue[i]), 4};
      Weighted& cell = cells[x / kCell];
      // Where little of the actor is in a square at the rim, it says little about his colour.
      const float pure = depth > 2 ? 1 : std::min(1.0F, grid.differences[i] * full);
      for (std::size_t c = 0; c < 4; ++c) {
        out[c] = pure * pure * kWeights[depth] * colour[c];
        cell[c] += kDeepWeights[depth] * colour[c];
      }
    }
  }
  const std::size_t stride = size(grid.width());
  sum_around(box, stride, grid.weighted, grid.line_sums, grid.near_colours);
  sum_around(box, stride, grid.near_colours, grid.line_sums, grid.around_colours);
  const BoundingBox cells{0, box.top / kCell, grid.cells_across - 1, box.bottom / kCell};
  sum_around(cells, size(grid.cells_across), grid.cells, grid.line_sums, grid.deep_colours);
}

}  // namespace

BoundingBox MatteGrid::rim_box() const {
  return {std::max(0, box.left - 1), std::max(0, box.top - 1), std::min(width() - 1, box.right + 1),
          std::min(height() - 1, box.bottom + 1)};
}

PlateGrid plate_grid(const CleanPlate& plate, const Mask& garbage) {
  PlateGrid grid;
  sum_squares(plate.picture, grid.sums);
  for (int y = 0; y < grid.sums.height; ++y) {
    for (int x = 0; x < grid.sums.width; ++x) {
      const float noise = plate.noise.at(x, y);
      const bool left_out = garbage.width > 0 && garbage.at(2 * x, 2 * y);
      grid.inverse_variances.push_back(left_out ? 0 : 1 / (4 * noise * noise));
    }
  }
  return grid;
}

void find_actor(const Image& frame, const PlateGrid& plate, const MatteGridLimits& limits, MatteGrid& grid) {
  sum_squares(frame, grid.sums);
  if (grid.actor.width != grid.width() || grid.actor.height != grid.height()) {
    grid.actor = Mask(grid.width(), grid.height());
    const std::size_t count = grid.actor.pixels.size();
    grid.differences.resize(count);
    for (auto* bytes : {&grid.depths, &grid.rim, &grid.level, &grid.next_level}) bytes->resize(count);
    for (auto* colours : {&grid.weighted, &grid.near_colours, &grid.around_colours}) colours->resize(count);
    const auto cells = [](int squares) { return size((squares + MatteGrid::kCell - 1) / MatteGrid::kCell); };
    grid.cells.resize(cells(grid.width()) * cells(grid.height()));
    grid.deep_colours.resize(grid.cells.size());
  }
  grid.gains = frame_gains(grid.sums, plate.sums, limits.light);
  find_differences(grid.sums, plate, grid.gains, limits.light, grid.differences.data());
  grow(limits, grid);
  tidy(limits, grid);
  if (grid.box.empty()) return;
  if (limits.open_small_holes) open_small_holes(limits, grid);
  find_depths(grid);
  carry_colours(grid);
}

}  // namespace motex
