// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/puppet_stage.h"

#include <algorithm>
#include <cmath>

#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr std::size_t kNoiseLength = std::size_t{1} << 19;
constexpr double kNoiseStep = 0.25;  // grey levels

std::uint8_t scaled(std::uint8_t value, double light) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value * light), 0L, 255L));
}

}  // namespace

Rgba PuppetStage::screen_colour(ScreenColour screen) {
  switch (screen) {
    case ScreenColour::kBlue:
      return {40, 70, 195, 255};
    case ScreenColour::kPlain:
      return {176, 172, 164, 255};
    default:
      return {45, 190, 55, 255};
  }
}

PuppetStage::PuppetStage(int width, int height, const PuppetStageOptions& options)
    : options_(options), screen_(width, height) {
  Rng rng = Rng(options.seed).fork(1);
  // Two lamps: the light falls off with the square of the distance from a place near the middle.
  const double centre_x = width * rng.uniform(0.4, 0.6), centre_y = height * rng.uniform(0.35, 0.55);
  const Rgba colour = screen_colour(options.screen);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x - centre_x) / (0.5 * width), v = (y - centre_y) / (0.5 * height);
      const double light = std::max(0.1, 1 - options.unevenness * (u * u + 0.8 * v * v));
      screen_.at(x, y) = {scaled(colour.r, light), scaled(colour.g, light), scaled(colour.b, light), 255};
    }
  if (options.noise <= 0) return;
  noise_.resize(kNoiseLength);
  for (std::int8_t& value : noise_)
    value = static_cast<std::int8_t>(std::clamp(std::lround(options.noise * rng.normal() / kNoiseStep), -127L, 127L));
}

void PuppetStage::shade_floor(Image& image, double x, double y, double pixels_per_metre) const {
  if (options_.shadow <= 0) return;
  const double half_width = 0.38 * pixels_per_metre, half_height = 0.09 * pixels_per_metre;
  const auto first = [](double at) { return std::max(0, static_cast<int>(std::max(-1e6, std::floor(at)))); };
  const auto last = [](double at, int size) { return std::min(size - 1, static_cast<int>(std::min(1e6, at))); };
  for (int row = first(y - 3 * half_height); row <= last(y + 3 * half_height, image.height); ++row)
    for (int column = first(x - 3 * half_width); column <= last(x + 3 * half_width, image.width); ++column) {
      const double u = (column - x) / half_width, v = (row - y) / half_height;
      const double light = 1 - options_.shadow * std::exp(-0.5 * (u * u + v * v));
      Rgba& pixel = image.at(column, row);
      pixel = {scaled(pixel.r, light), scaled(pixel.g, light), scaled(pixel.b, light), 255};
    }
}

void PuppetStage::add_noise(Image& image, int frame) const {
  if (noise_.empty()) return;
  Rng rng = Rng(options_.seed).fork(1000 + static_cast<std::uint64_t>(frame));
  const auto length = static_cast<std::size_t>(image.width) * 3;
  for (int y = 0; y < image.height; ++y) {
    std::size_t at = rng.below(kNoiseLength);
    Rgba* row = &image.at(0, y);
    const auto next = [&]() -> int {
      const int value = noise_[at];
      at = (at + 1) & (kNoiseLength - 1);
      return value;
    };
    const auto noisy = [&](std::uint8_t value) {
      return static_cast<std::uint8_t>(std::clamp((4 * value + next() + 2) >> 2, 0, 255));
    };
    for (std::size_t x = 0; x < length / 3; ++x) {
      Rgba& pixel = row[x];
      pixel.r = noisy(pixel.r);
      pixel.g = noisy(pixel.g);
      pixel.b = noisy(pixel.b);
    }
  }
}

}  // namespace motex
