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
#include "motex/people/matte_grid.h"

namespace motex {
namespace {

constexpr int kRimDepth = 2;    // squares up to this depth are unmixed
constexpr int kSpillDepth = 4;  // and up to this one cleared of spill
constexpr float kDeadBand = 2;  // deviations of α that count as 0 and 1

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(value + 0.5F); }

}  // namespace

/// What the Keyer shares among copies.
struct SharedPlate {
  CleanPlate plate;
  PlateGrid grid;
  Mask garbage;
  KeyOptions options;
  MatteGridLimits limits;
  int screen_channel = -1;  // 1 = green, 2 = blue; −1 = neither
};

struct Keyer::State {
  std::shared_ptr<const SharedPlate> shared;
  MatteGrid grid;
  std::vector<PremultipliedRgba> canvas;  // of the frame's size; only what lies in the box is up to date

  void unmix(const Image& frame, int x, int y, float noise, const std::array<float, 4>& inner, PremultipliedRgba& out,
             bool of_actor) const;
  void take_spill(PremultipliedRgba& pixel) const;
  void fill_canvas(const Image& frame);
  void cut_out(Sprite& sprite, int width, int height) const;
};

void Keyer::State::take_spill(PremultipliedRgba& pixel) const {
  const int channel = shared->screen_channel;
  if (channel < 0) return;
  const int other = channel == 1 ? pixel[2] : pixel[1];
  const int excess = pixel[static_cast<std::size_t>(channel)] - std::max<int>(pixel[0], other);
  if (excess <= 0) return;
  pixel[static_cast<std::size_t>(channel)] =
      static_cast<std::uint8_t>(pixel[static_cast<std::size_t>(channel)] - std::lround(shared->options.spill * excess));
}

void Keyer::State::unmix(const Image& frame, int x, int y, float noise, const std::array<float, 4>& inner,
                         PremultipliedRgba& out, bool of_actor) const {
  const Rgba &p = frame.at(x, y), &b = shared->plate.picture.at(x, y);
  out = {};
  if (inner[3] <= 0) return;
  const float scale = 1 / inner[3];
  const float fr = inner[0] * scale - b.r, fg = inner[1] * scale - b.g, fb = inner[2] * scale - b.b;
  const float length = fr * fr + fg * fg + fb * fb;
  const auto dr = static_cast<float>(p.r - b.r), dg = static_cast<float>(p.g - b.g), db = static_cast<float>(p.b - b.b);
  float alpha = 0;
  if (length < 9 * noise * noise) {
    alpha = of_actor ? 1 : 0;
  } else {
    alpha = (dr * fr + dg * fg + db * fb) / length;
    const float band = std::min(0.25F, kDeadBand * noise / std::sqrt(length));
    if (alpha < band) return;
    if (alpha > 1 - band) alpha = 1;
  }
  if (alpha == 0) return;
  const float top = 255 * alpha, rest = 1 - alpha;
  const auto colour = [&](std::uint8_t level, std::uint8_t back) {
    return byte(std::clamp(static_cast<float>(level) - rest * static_cast<float>(back), 0.0F, top));
  };
  out = {colour(p.r, b.r), colour(p.g, b.g), colour(p.b, b.b), byte(top)};
}

void Keyer::State::fill_canvas(const Image& frame) {
  const BoundingBox& box = grid.box;
  const auto width = static_cast<std::size_t>(frame.width);
  for (int row = std::max(0, box.top - 1); row <= std::min(grid.height - 1, box.bottom + 1); ++row) {
    for (int column = std::max(0, box.left - 1); column <= std::min(grid.width - 1, box.right + 1); ++column) {
      const auto at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(column);
      const int depth = grid.depths[at];
      for (int y = 2 * row; y <= std::min(2 * row + 1, frame.height - 1); ++y) {
        for (int x = 2 * column; x <= std::min(2 * column + 1, frame.width - 1); ++x) {
          PremultipliedRgba& out = canvas[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
          const Rgba& p = frame.at(x, y);
          if (shared->garbage.width > 0 && shared->garbage.at(x, y))
            out = {};
          else if (depth > kRimDepth)
            out = {p.r, p.g, p.b, 255};
          else if (depth > 0 || grid.rim[at] != 0)
            unmix(frame, x, y, shared->plate.noise.at(column, row), grid.inner_colours[at], out, depth > 0);
          else
            out = {};
          if (depth <= kSpillDepth && out[3] != 0) take_spill(out);
        }
      }
    }
  }
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
      std::max(4.0, options.min_part / 100 * static_cast<double>(shared->grid.width) * shared->grid.height);
  shared->screen_channel = plate.kind == ScreenKind::kGreen ? 1 : plate.kind == ScreenKind::kBlue ? 2 : -1;
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
