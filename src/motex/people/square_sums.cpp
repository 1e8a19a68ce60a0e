// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/square_sums.h"

#include <bit>
#include <cstring>

#include "motex/core/wide.h"

namespace motex {
namespace {

static_assert(std::endian::native == std::endian::little, "two pixels are read as one number");

/// Four pixels at a time: pairs of bytes in 16-bit lanes of one 64-bit number.
MOTEX_WIDE void sum_rows(const std::uint8_t* __restrict upper, const std::uint8_t* __restrict lower, std::size_t count,
                         std::uint16_t* __restrict red, std::uint16_t* __restrict green,
                         std::uint16_t* __restrict blue) {
  constexpr std::uint64_t kLanes = 0x00FF00FF00FF00FF;
  for (std::size_t x = 0; x < count; ++x) {
    std::uint64_t a, b;
    std::memcpy(&a, upper + 8 * x, 8);
    std::memcpy(&b, lower + 8 * x, 8);
    const std::uint64_t even = (a & kLanes) + (b & kLanes), odd = ((a >> 8U) & kLanes) + ((b >> 8U) & kLanes);
    const std::uint64_t red_blue = even + (even >> 32U);
    red[x] = static_cast<std::uint16_t>(red_blue);
    green[x] = static_cast<std::uint16_t>(odd + (odd >> 32U));
    blue[x] = static_cast<std::uint16_t>(red_blue >> 16U);
  }
}

}  // namespace

void sum_squares(const Image& image, SquareSums& sums) {
  sums.width = (image.width + 1) / 2, sums.height = (image.height + 1) / 2;
  for (std::vector<std::uint16_t>& channel : sums.channels) channel.resize(sums.index(0, sums.height));
  for (int y = 0; y < sums.height; ++y) {
    const Rgba* upper = &image.at(0, 2 * y);
    const Rgba* lower = &image.at(0, std::min(2 * y + 1, image.height - 1));
    const std::size_t row = sums.index(0, y);
    auto& [red, green, blue] = sums.channels;
    sum_rows(&upper->r, &lower->r, static_cast<std::size_t>(image.width / 2), &red[row], &green[row], &blue[row]);
    if (image.width % 2 == 0) continue;
    const Rgba &a = upper[image.width - 1], &b = lower[image.width - 1];
    const std::size_t last = row + static_cast<std::size_t>(sums.width) - 1;
    red[last] = static_cast<std::uint16_t>(2 * (a.r + b.r));
    green[last] = static_cast<std::uint16_t>(2 * (a.g + b.g));
    blue[last] = static_cast<std::uint16_t>(2 * (a.b + b.b));
  }
}

}  // namespace motex
