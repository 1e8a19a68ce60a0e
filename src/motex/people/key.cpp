// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/key.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/image/planes.h"
#include "motex/people/matte_grid.h"
#include "motex/people/unmix.h"

namespace motex {
namespace {

constexpr int kRimDepth = 2;    // squares up to this depth are unmixed
constexpr int kSpillDepth = 5;  // and up to this one cleared of spill

constexpr float kCoarseColours = 1.5F;  // how much wider than it is a rim looks by colours of half the resolution

constexpr float kLeastNear = 0.5F;  // weight of the colours near by: about one square that is not at the very rim

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(value + 0.5F); }

LevelTriple mean_of(const std::array<float, 4>& sum) {
  const float scale = 1 / sum[3];
  return {sum[0] * scale, sum[1] * scale, sum[2] * scale};
}

}  // namespace

/// What the Keyer shares among copies.
struct SharedPlate {
  CleanPlate plate;
  PlateGrid grid;
  Mask garbage;
  KeyOptions options;
  MatteGridLimits limits;
  int screen_channel = -1;  // 1 = green, 2 = blue; −1 = neither
  float colours_from = 0;   // pixels to the right: where colours lie that belong to a pixel's light
};

struct Keyer::State {
  std::shared_ptr<const SharedPlate> shared;
  MatteGrid grid;
  std::vector<PremultipliedRgba> canvas;  // of the frame's size; only what lies in the box is up to date

  /// What the four pixels of a square have in common.
  struct Square {
    int depth = 0;
    float noise = 1;
    FrontColours fronts;
    LevelTriple deep{};
    bool deep_known = false;
  };
  Square square_at(int column, int row) const;
  using FourPixels = std::array<PremultipliedRgba, 4>;
  PremultipliedRgba& canvas_at(int x, int y) {
    return canvas[static_cast<std::size_t>(y) * static_cast<std::size_t>(shared->plate.picture.width) +
                  static_cast<std::size_t>(x)];
  }
  void unmix(const FourTriple& level, const FourTriple& back, const Square& square, FourPixels& out) const;
  Rgba in_place(const Image& frame, int x, int y) const;
  void fill_square(const Image& frame, int column, int row, const Square& square);
  void fill_canvas(const Image& frame);
  void cut_out(Sprite& sprite, int width, int height) const;
};

Keyer::State::Square Keyer::State::square_at(int column, int row) const {
  const std::size_t at = grid.sums.index(column, row);
  Square square;
  square.depth = grid.depths[at];
  square.noise = shared->plate.noise.at(column, row);
  const std::array<float, 4>&near = grid.near_colours[at], &around = grid.around_colours[at];
  square.fronts.known = around[3] > 0;
  if (square.fronts.known) {
    square.fronts.around = mean_of(around);
    square.fronts.near = near[3] > kLeastNear ? mean_of(near) : square.fronts.around;
  }
  const std::size_t cell =
      static_cast<std::size_t>(row / MatteGrid::kCell) * static_cast<std::size_t>(grid.cells_across) +
      static_cast<std::size_t>(column / MatteGrid::kCell);
  const std::array<float, 4>& deep = grid.deep_colours[cell];
  square.deep_known = deep[3] > 0 && shared->options.spill > 0 && shared->plate.kind != ScreenKind::kNatural;
  if (square.deep_known) square.deep = mean_of(deep);
  return square;
}

void Keyer::State::unmix(const FourTriple& level, const FourTriple& back, const Square& square, FourPixels& out) const {
  Four alpha = four_of(1);
  const bool at_rim = square.depth <= kRimDepth;
  if (at_rim) alpha = unmixed_alpha(level, back, square.fronts, square.noise, square.depth);
  const auto is_nothing = alpha <= 0;
  const Four divisor = is_nothing ? four_of(1) : alpha;
  FourTriple colour{};
  for (std::size_t c = 0; c < 3; ++c) colour[c] = clamped((level[c] - (1 - alpha) * back[c]) / divisor, 0, 255);
  if (square.deep_known) {
    Four share = spill_share(colour, square.deep, back, shared->screen_channel);
    // More than light can do at the rim is the background itself: the blur of a lens, a codec's coarse colours.
    if (at_rim) alpha = share > kMostSpill ? alpha * ((1 - share) / (1 - kMostSpill)) : alpha;
    share = static_cast<float>(shared->options.spill) * (at_rim ? share : least_of(share, four_of(kMostSpill)));
    for (std::size_t c = 0; c < 3; ++c) colour[c] = clamped((colour[c] - share * back[c]) / (1 - share), 0, 255);
  }
  if (at_rim && shared->plate.coarse_colour) alpha = clamped(0.5F + kCoarseColours * (alpha - 0.5F), 0, 1);
  alpha = is_nothing ? four_of(0) : alpha;
  for (std::size_t i = 0; i < 4; ++i)
    out[i] = {byte(alpha[i] * colour[0][i]), byte(alpha[i] * colour[1][i]), byte(alpha[i] * colour[2][i]),
              byte(255 * alpha[i])};
}

/// Colours of the neighbour on that side and of the pixel itself, half and half, in the pixel's own light.
Rgba Keyer::State::in_place(const Image& frame, int x, int y) const {
  const Rgba p = frame.at(x, y);
  const int from = std::clamp(x + (shared->colours_from > 0 ? 1 : -1), 0, frame.width - 1);
  const Rgba q = frame.at(from, y);
  const float r = 0.5F * static_cast<float>(q.r - p.r), g = 0.5F * static_cast<float>(q.g - p.g),
              b = 0.5F * static_cast<float>(q.b - p.b);
  const float light = luma_of(r, g, b);
  const auto moved = [&](std::uint8_t level, float by) {
    return byte(std::clamp(static_cast<float>(level) + by - light, 0.0F, 255.0F));
  };
  return {moved(p.r, r), moved(p.g, g), moved(p.b, b), p.a};
}

void Keyer::State::fill_square(const Image& frame, int column, int row, const Square& square) {
  const Image& plate = shared->plate.picture;
  const int left = 2 * column, top = 2 * row;
  const int right = std::min(left + 1, frame.width - 1), bottom = std::min(top + 1, frame.height - 1);
  std::array<Rgba, 4> p{frame.at(left, top), frame.at(right, top), frame.at(left, bottom), frame.at(right, bottom)};
  const std::array<Rgba, 4> q{plate.at(left, top), plate.at(right, top), plate.at(left, bottom),
                              plate.at(right, bottom)};
  if (shared->colours_from != 0)
    p = {in_place(frame, left, top), in_place(frame, right, top), in_place(frame, left, bottom),
         in_place(frame, right, bottom)};
  FourTriple level{}, back{};
  for (std::size_t i = 0; i < 4; ++i) {
    level[0][i] = p[i].r, level[1][i] = p[i].g, level[2][i] = p[i].b;
    back[0][i] = q[i].r, back[1][i] = q[i].g, back[2][i] = q[i].b;
  }
  for (std::size_t c = 0; c < 3; ++c) back[c] *= grid.gains[c];
  FourPixels out{};
  if (square.depth > kRimDepth || square.fronts.known) unmix(level, back, square, out);
  canvas_at(left, top) = out[0], canvas_at(right, top) = out[right > left ? 1 : 0];
  if (bottom > top) canvas_at(left, bottom) = out[2], canvas_at(right, bottom) = out[right > left ? 3 : 2];
}

void Keyer::State::fill_canvas(const Image& frame) {
  const BoundingBox box = grid.rim_box();
  for (int row = box.top; row <= box.bottom; ++row) {
    const int top = 2 * row, bottom = std::min(top + 1, frame.height - 1);
    for (int column = box.left; column <= box.right; ++column) {
      const std::size_t at = grid.sums.index(column, row);
      const int depth = grid.depths[at];
      const bool is_empty = depth == 0 && grid.rim[at] == 0;
      if (!is_empty && depth <= kSpillDepth) {
        fill_square(frame, column, row, square_at(column, row));
        continue;
      }
      for (int y = top; y <= bottom; ++y)
        for (int x = 2 * column; x <= std::min(2 * column + 1, frame.width - 1); ++x) {
          const Rgba& p = frame.at(x, y);
          canvas_at(x, y) = is_empty ? PremultipliedRgba{} : PremultipliedRgba{p.r, p.g, p.b, 255};
        }
    }
  }
  if (shared->garbage.width == 0) return;
  for (int y = 2 * box.top; y <= std::min(2 * box.bottom + 1, frame.height - 1); ++y)
    for (int x = 2 * box.left; x <= std::min(2 * box.right + 1, frame.width - 1); ++x)
      if (shared->garbage.at(x, y)) canvas_at(x, y) = {};
}

void Keyer::State::cut_out(Sprite& sprite, int width, int height) const {
  const int left = std::max(0, 2 * grid.box.left - 2), right = std::min(width - 1, 2 * grid.box.right + 3);
  const int top = std::max(0, 2 * grid.box.top - 2), bottom = std::min(height - 1, 2 * grid.box.bottom + 3);
  BoundingBox box{width, height, -1, -1};
  for (int y = top; y <= bottom; ++y) {
    const PremultipliedRgba* row = canvas.data() + static_cast<std::ptrdiff_t>(y) * width;
    int first = left, last = right;
    while (first <= right && row[first][3] == 0) ++first;
    if (first > right) continue;
    while (row[last][3] == 0) --last;
    box.left = std::min(box.left, first), box.right = std::max(box.right, last);
    box.top = std::min(box.top, y), box.bottom = y;
  }
  if (box.empty()) return;
  sprite.left = box.left, sprite.top = box.top, sprite.width = box.width(), sprite.height = box.height();
  for (int y = box.top; y <= box.bottom; ++y) {
    const auto row = canvas.begin() + static_cast<std::ptrdiff_t>(y) * width;
    sprite.pixels.insert(sprite.pixels.end(), row + box.left, row + box.right + 1);
  }
}

Keyer::Keyer(CleanPlate plate, const KeyOptions& options, const Mask& garbage) : state_(std::make_unique<State>()) {
  check_options(options);
  const bool has_garbage = garbage.width != 0 || garbage.height != 0;
  if (has_garbage && (garbage.width != plate.picture.width || garbage.height != plate.picture.height))
    throw InvalidInput("the garbage mask has " + std::to_string(garbage.width) + " × " +
                       std::to_string(garbage.height) + " pixels, the frames " + std::to_string(plate.picture.width) +
                       " × " + std::to_string(plate.picture.height));
  auto shared = std::make_shared<SharedPlate>();
  shared->grid = plate_grid(plate, garbage);
  shared->garbage = garbage;
  shared->options = options;
  shared->limits.difference = options.tolerance * options.tolerance;
  shared->limits.min_area =
      std::max(4.0, options.min_part / 100 * static_cast<double>(shared->grid.sums.width) * shared->grid.sums.height);
  const bool is_coloured = plate.kind == ScreenKind::kGreen || plate.kind == ScreenKind::kBlue;
  // A coloured screen in shadow keeps its colour; white and grey clothes look like a plain one in other light.
  if (is_coloured) shared->limits.light = {0.35F, 0.15F};
  shared->limits.open_small_holes = is_coloured;
  if (!is_coloured) shared->limits.min_hole = 0.0003 * static_cast<double>(shared->grid.inverse_variances.size());
  shared->screen_channel = plate.kind == ScreenKind::kGreen ? 1 : plate.kind == ScreenKind::kBlue ? 2 : -1;
  if (plate.coarse_colour) shared->colours_from = plate.chroma_shift;
  state_->canvas.resize(plate.picture.pixels.size());
  shared->plate = std::move(plate);
  state_->shared = std::move(shared);
}

Keyer::~Keyer() = default;
Keyer::Keyer(const Keyer& other) : state_(std::make_unique<State>(*other.state_)) {}
Keyer::Keyer(Keyer&&) noexcept = default;
Keyer& Keyer::operator=(Keyer&&) noexcept = default;

const CleanPlate& Keyer::plate() const { return state_->shared->plate; }

void Keyer::key(const Image& frame, Sprite& sprite) {
  const Image& picture = plate().picture;
  if (frame.width != picture.width || frame.height != picture.height)
    throw InvalidInput("the frame has " + std::to_string(frame.width) + " × " + std::to_string(frame.height) +
                       " pixels, its clean plate " + std::to_string(picture.width) + " × " +
                       std::to_string(picture.height));
  sprite.left = sprite.top = sprite.width = sprite.height = 0;
  sprite.pixels.clear();
  find_actor(frame, state_->shared->grid, state_->shared->limits, state_->grid);
  if (state_->grid.box.empty()) return;
  state_->fill_canvas(frame);
  state_->cut_out(sprite, frame.width, frame.height);
}

}  // namespace motex
