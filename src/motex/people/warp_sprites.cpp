// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/warp_sprites.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/core/wide.h"
#include "motex/people/pixel_channel.h"

namespace motex {

namespace {

constexpr int kChunk = 64;  // pixels worked on at a time
constexpr int kRowsPerTask = 32;

/// A sprite with a transparent border of one pixel (two to the right and below), so that every place can be looked up.
struct Bordered {
  int width = 0, height = 0;  // without the border
  std::size_t stride = 0;
  CutOffSides cut_off;
  std::vector<std::uint32_t> pixels;

  explicit Bordered(const PlacedSprite& source)
      : width(source.sprite.width), height(source.sprite.height), cut_off(source.cut_off) {
    const Sprite& sprite = source.sprite;
    stride = static_cast<std::size_t>(width) + 3;
    pixels.assign(stride * (static_cast<std::size_t>(height) + 3), 0);
    for (int y = 0; y < height; ++y)
      std::memcpy(&pixels[(static_cast<std::size_t>(y) + 1) * stride + 1], &sprite.at(0, y),
                  static_cast<std::size_t>(width) * sizeof(std::uint32_t));
  }
};

/// Places in a sprite, a chunk of pixels long, and the four pixels around each.
struct Chunk {
  std::array<float, kChunk> x{}, y{};    // place in the sprite
  std::array<float, kChunk> fx{}, fy{};  // within the square of four pixels
  std::array<std::int32_t, kChunk> first{};
  std::array<std::array<std::uint32_t, kChunk>, 4> corner{};
};

/// Displacements of one row of pixels: between two rows of the grid, still at the grid's columns.
struct GridRow {
  std::vector<float> x, y;

  GridRow(const WarpGrid& grid, int row_of_pixels) {
    const int above = std::min(row_of_pixels / grid.spacing, grid.rows - 2);
    const float share = static_cast<float>(row_of_pixels - above * grid.spacing) / static_cast<float>(grid.spacing);
    x.resize(static_cast<std::size_t>(grid.columns)), y.resize(x.size());
    for (int c = 0; c < grid.columns; ++c) {
      const std::size_t i = grid.index(c, above), below = grid.index(c, above + 1), out = static_cast<std::size_t>(c);
      x[out] = grid.x[i] + (grid.x[below] - grid.x[i]) * share;
      y[out] = grid.y[i] + (grid.y[below] - grid.y[i]) * share;
    }
  }
};

/// Film → sprite: s · p + t.
struct ToSprite {
  float scale, x, y;
};

inline void find_places(const GridRow& row, int spacing, int first, int count, int left, float film_y,
                        const ToSprite& to, Chunk& chunk) {
  for (int i = 0; i < count;) {
    const int column = std::min((first + i) / spacing, static_cast<int>(row.x.size()) - 2);
    const int within = first + i - column * spacing, n = std::min(spacing - within, count - i);
    const int run = n > 0 ? n : count - i;  // beyond the last grid point its last piece goes on
    const auto c = static_cast<std::size_t>(column);
    const float x0 = row.x[c], step_x = (row.x[c + 1] - x0) / static_cast<float>(spacing);
    const float y0 = row.y[c], step_y = (row.y[c + 1] - y0) / static_cast<float>(spacing);
    for (int j = 0; j < run; ++j) {
      const auto at = static_cast<std::size_t>(i + j);
      const auto k = static_cast<float>(within + j);
      chunk.x[at] = (static_cast<float>(left + first + i + j) + x0 + step_x * k) * to.scale + to.x;
      chunk.y[at] = (film_y + y0 + step_y * k) * to.scale + to.y;
    }
    i += run;
  }
}

/// Rounds down without a library call: places are ≥ −1.
inline void find_squares(const Bordered& sprite, int count, Chunk& chunk) {
  const float left = sprite.cut_off.left ? 0.0F : -1.0F, top = sprite.cut_off.top ? 0.0F : -1.0F;
  const auto right = static_cast<float>(sprite.width - (sprite.cut_off.right ? 1 : 0));
  const auto bottom = static_cast<float>(sprite.height - (sprite.cut_off.bottom ? 1 : 0));
  const auto stride = static_cast<std::int32_t>(sprite.stride);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const float x = std::min(std::max(chunk.x[i], left), right) + 1;
    const float y = std::min(std::max(chunk.y[i], top), bottom) + 1;
    const auto ix = static_cast<std::int32_t>(x), iy = static_cast<std::int32_t>(y);
    chunk.fx[i] = x - static_cast<float>(ix);
    chunk.fy[i] = y - static_cast<float>(iy);
    chunk.first[i] = iy * stride + ix;
  }
}

/// Whether any of the pixels looked up is not transparent.
inline bool look_up(const Bordered& sprite, int count, Chunk& chunk) {
  const std::uint32_t* pixels = sprite.pixels.data();
  std::uint32_t any = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const std::uint32_t* p = pixels + chunk.first[i];
    chunk.corner[0][i] = p[0];
    chunk.corner[1][i] = p[1];
    chunk.corner[2][i] = p[sprite.stride];
    chunk.corner[3][i] = p[sprite.stride + 1];
    any |= p[0] | p[1] | p[sprite.stride] | p[sprite.stride + 1];
  }
  return any != 0;
}

inline float interpolated(const Chunk& chunk, std::size_t i, int shift) {
  const float a = channel(chunk.corner[0][i], shift), b = channel(chunk.corner[1][i], shift);
  const float c = channel(chunk.corner[2][i], shift), d = channel(chunk.corner[3][i], shift);
  const float above = a + (b - a) * chunk.fx[i], below = c + (d - c) * chunk.fx[i];
  return above + (below - above) * chunk.fy[i];
}

inline void mix_chunks(const Chunk& a, const Chunk& b, float weight, int count, std::uint32_t* out) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::uint32_t pixel = 0;
    for (int shift = 0; shift < 32; shift += 8) {
      const float va = interpolated(a, i, shift), vb = interpolated(b, i, shift);
      pixel |= static_cast<std::uint32_t>(static_cast<std::int32_t>(va + (vb - va) * weight + 0.5F)) << shift;
    }
    out[i] = pixel;
  }
}

struct Side {
  Bordered sprite;
  ToSprite to;
  const WarpGrid& warp;
};

Side side_of(const WarpedSprite& warped) {
  const Placement& placement = warped.source.placement;
  const Sprite& sprite = warped.source.sprite;
  const double scale = 1 / placement.scale;
  return {Bordered(warped.source),
          {static_cast<float>(scale), static_cast<float>(-placement.x * scale - sprite.left),
           static_cast<float>(-placement.y * scale - sprite.top)},
          warped.warp};
}

inline void copy_chunk(const Chunk& chunk, int count, std::uint32_t* out) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::uint32_t pixel = 0;
    for (int shift = 0; shift < 32; shift += 8)
      pixel |= static_cast<std::uint32_t>(static_cast<std::int32_t>(interpolated(chunk, i, shift) + 0.5F)) << shift;
    out[i] = pixel;
  }
}

/// Whether any of the pixels looked up is not transparent.
inline bool look_up_row(const Side& side, const GridRow& row, int first, int count, int left, float film_y,
                        Chunk& chunk) {
  find_places(row, side.warp.spacing, first, count, left, film_y, side.to, chunk);
  find_squares(side.sprite, count, chunk);
  return look_up(side.sprite, count, chunk);
}

MOTEX_WIDE void warp_row(const Side& side, const BoundingBox& box, int y, std::uint32_t* out) {
  const GridRow row(side.warp, y);
  Chunk chunk;
  for (int first = 0; first < box.width(); first += kChunk) {
    const int count = std::min(kChunk, box.width() - first);
    if (look_up_row(side, row, first, count, box.left, static_cast<float>(box.top + y), chunk))
      copy_chunk(chunk, count, out + first);
  }
}

MOTEX_WIDE void dissolve_row(const Side& a, const Side& b, float weight, const BoundingBox& box, int y,
                             std::uint32_t* out) {
  const GridRow row_a(a.warp, y), row_b(b.warp, y);
  const auto film_y = static_cast<float>(box.top + y);
  Chunk chunk_a, chunk_b;
  for (int first = 0; first < box.width(); first += kChunk) {
    const int count = std::min(kChunk, box.width() - first);
    const bool any_a = look_up_row(a, row_a, first, count, box.left, film_y, chunk_a);
    const bool any_b = look_up_row(b, row_b, first, count, box.left, film_y, chunk_b);
    if (any_a || any_b) mix_chunks(chunk_a, chunk_b, weight, count, out + first);
  }
}

bool covers(const WarpGrid& grid, const BoundingBox& box) {
  return grid.left == box.left && grid.top == box.top && grid.columns >= 2 && grid.rows >= 2 &&
         (grid.columns - 1) * grid.spacing >= box.width() - 1 && (grid.rows - 1) * grid.spacing >= box.height() - 1;
}

}  // namespace

CutOffSides cut_off_sides(const Sprite& sprite, int width, int height) {
  if (sprite.empty()) return {};
  return {sprite.left <= 0, sprite.top <= 0, sprite.left + sprite.width >= width, sprite.top + sprite.height >= height};
}

bool Placement::is_whole_pixels() const { return scale == 1 && x == std::round(x) && y == std::round(y); }

BoundingBox box_of(const Sprite& sprite, const Placement& placement) {
  if (sprite.empty()) return {};
  const auto at = [&](int place, double offset) { return placement.scale * place + offset; };
  return {static_cast<int>(std::floor(at(sprite.left, placement.x))),
          static_cast<int>(std::floor(at(sprite.top, placement.y))),
          static_cast<int>(std::ceil(at(sprite.left + sprite.width - 1, placement.x))),
          static_cast<int>(std::ceil(at(sprite.top + sprite.height - 1, placement.y)))};
}

BoundingBox joined(const BoundingBox& a, const BoundingBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

namespace {

/// A picture of the box, rows drawn by draw(y, pixels of the row: transparent).
template <class Draw>
Sprite drawn(const BoundingBox& box, int jobs, const Draw& draw) {
  Sprite out;
  if (box.empty()) return out;
  out.left = box.left, out.top = box.top, out.width = box.width(), out.height = box.height();
  out.pixels.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), {});
  const int num_tasks = (out.height + kRowsPerTask - 1) / kRowsPerTask;
  parallel_for(jobs, num_tasks, [&](int task) {
    std::vector<std::uint32_t> row(static_cast<std::size_t>(out.width));
    for (int y = task * kRowsPerTask; y < std::min(out.height, (task + 1) * kRowsPerTask); ++y) {
      std::fill(row.begin(), row.end(), 0);
      draw(y, row.data());
      std::memcpy(&out.at(0, y), row.data(), row.size() * sizeof(std::uint32_t));
    }
  });
  return out;
}

}  // namespace

Sprite warped(const WarpedSprite& sprite, const BoundingBox& box, int jobs) {
  if (!box.empty() && !covers(sprite.warp, box))
    throw InvalidInput("the grid of a warp must cover the rectangle that is drawn");
  const Side side = side_of(sprite);
  return drawn(box, jobs, [&](int y, std::uint32_t* row) { warp_row(side, box, y, row); });
}

Sprite dissolved(const WarpedSprite& a, const WarpedSprite& b, double weight, const BoundingBox& box, int jobs) {
  if (!box.empty() && (!covers(a.warp, box) || !covers(b.warp, box) || a.warp.spacing != b.warp.spacing))
    throw InvalidInput("the grids of a dissolve must cover the rectangle that is drawn");
  const Side side_a = side_of(a), side_b = side_of(b);
  return drawn(box, jobs, [&](int y, std::uint32_t* row) {
    dissolve_row(side_a, side_b, static_cast<float>(weight), box, y, row);
  });
}

}  // namespace motex
