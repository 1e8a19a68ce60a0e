// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/dissolve.h"

#include <algorithm>
#include <cstring>

#include "motex/core/error.h"
#include "motex/core/wide.h"
#include "motex/image/planes.h"
#include "motex/people/pixel_channel.h"

namespace motex {
namespace {

constexpr int kReach = 6;                           // pixels each way over which the difference is averaged
constexpr float kAlike = 6.0F, kDifferent = 20.0F;  // mean grey levels
constexpr float kSteepest = 4.0F;

using Row = std::vector<std::uint32_t>;  // pixels

void read_row(const Sprite& sprite, int y, Row& row) {
  std::memcpy(row.data(), &sprite.at(0, y), row.size() * sizeof(std::uint32_t));
}

inline float brightness(std::uint32_t pixel) {
  return luma_of(channel(pixel, 0), channel(pixel, 8), channel(pixel, 16));
}

/// |Y_a − Y_b| · min(alpha_a, alpha_b) / 255.
MOTEX_WIDE void find_differences(const Row& a, const Row& b, std::uint8_t* __restrict out) {
  for (std::size_t x = 0; x < a.size(); ++x) {
    const float difference = brightness(a[x]) - brightness(b[x]);
    const float size = difference < 0 ? -difference : difference;
    out[x] = static_cast<std::uint8_t>(
        static_cast<std::int32_t>(size * std::min(channel(a[x], 24), channel(b[x], 24)) * (1.0F / 255) + 0.5F));
  }
}

MOTEX_WIDE void add_row(const std::uint8_t* __restrict row, int sign, std::vector<std::int32_t>& sums) {
  std::int32_t* __restrict out = sums.data();
  for (std::size_t x = 0; x < sums.size(); ++x) out[x] += sign * row[x];
}

/// Mean over kReach columns each way of sums over as many rows; nothing differs outside.
void average_columns(const std::vector<std::int32_t>& sums, std::vector<float>& means) {
  constexpr float kPerPixel = 1.0F / ((2 * kReach + 1) * (2 * kReach + 1));
  const auto reach = static_cast<std::size_t>(kReach);
  std::int32_t sum = 0;
  for (std::size_t x = 0; x < std::min(reach, sums.size()); ++x) sum += sums[x];
  for (std::size_t x = 0; x < sums.size(); ++x) {
    if (x + reach < sums.size()) sum += sums[x + reach];
    means[x] = static_cast<float>(sum) * kPerPixel;
    if (x >= reach) sum -= sums[x - reach];
  }
}

/// The share of b of each pixel; means: in, and shares out.
MOTEX_WIDE void find_shares(const Row& a, const Row& b, float weight, std::vector<float>& means) {
  float* __restrict share = means.data();
  for (std::size_t x = 0; x < means.size(); ++x) {
    const float alpha_a = channel(a[x], 24), alpha_b = channel(b[x], 24);
    const float both = std::min(alpha_a, alpha_b) / std::max(std::max(alpha_a, alpha_b), 1.0F);
    const float t = std::min(std::max((share[x] - kAlike) / (kDifferent - kAlike), 0.0F), 1.0F);
    const float steepness = 1 + (kSteepest - 1) * (t * t * (3 - 2 * t)) * both * both;
    share[x] = std::min(std::max(0.5F + steepness * (weight - 0.5F), 0.0F), 1.0F);
  }
}

inline std::uint32_t mixed(std::uint32_t a, std::uint32_t b, int shift, float share) {
  const float from = channel(a, shift), to = channel(b, shift);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(from + (to - from) * share + 0.5F)) << shift;
}

MOTEX_WIDE void mix_rows(const Row& a, const Row& b, const std::vector<float>& shares, Row& out) {
  std::uint32_t* __restrict pixels = out.data();
  for (std::size_t x = 0; x < out.size(); ++x)
    pixels[x] = mixed(a[x], b[x], 0, shares[x]) | mixed(a[x], b[x], 8, shares[x]) | mixed(a[x], b[x], 16, shares[x]) |
                mixed(a[x], b[x], 24, shares[x]);
}

}  // namespace

Sprite dissolve_where_alike(Sprite a, const Sprite& b, double weight) {
  if (a.left != b.left || a.top != b.top || a.width != b.width || a.height != b.height)
    throw InvalidInput("only pictures of the same rectangle can be dissolved");
  const auto width = static_cast<std::size_t>(a.width);
  Row row_a(width), row_b(width), row(width);
  std::vector<std::uint8_t> differences(a.pixels.size());
  std::vector<std::int32_t> sums(width);
  std::vector<float> means(width);
  const auto differences_of = [&](int y) { return &differences[static_cast<std::size_t>(y) * width]; };
  for (int y = 0; y < a.height; ++y) {
    read_row(a, y, row_a), read_row(b, y, row_b);
    find_differences(row_a, row_b, differences_of(y));
  }
  for (int y = -kReach; y < a.height; ++y) {
    if (y + kReach < a.height) add_row(differences_of(y + kReach), 1, sums);
    if (y < 0) continue;
    average_columns(sums, means);
    read_row(a, y, row_a), read_row(b, y, row_b);
    find_shares(row_a, row_b, static_cast<float>(weight), means);
    mix_rows(row_a, row_b, means, row);
    std::memcpy(&a.at(0, y), row.data(), width * sizeof(std::uint32_t));
    if (y >= kReach) add_row(differences_of(y - kReach), -1, sums);
  }
  return a;
}

}  // namespace motex
