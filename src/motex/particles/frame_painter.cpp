// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/frame_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kBlock = 16;  // pixels: a macroblock of most codecs

std::uint8_t to_byte(float level) {
  return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F);  // never negative, so this rounds
}

/// ⌈255 D/(255 − B)⌉ or ⌈255 (−D)/B⌉; the divisor is ≥ |D| > 0.
int alpha_needed(int picture, int background) {
  const int d = picture - background, room = d > 0 ? 255 - background : background;
  return d == 0 ? 0 : (255 * std::abs(d) + room - 1) / room;
}

/// B + 255 D/A, rounded; in 0 … 255 because A is at least what is needed.
std::uint8_t unmixed(int picture, int background, int alpha) {
  const int d = 255 * (picture - background);
  return static_cast<std::uint8_t>(std::clamp(background + (2 * d + (d > 0 ? alpha : -alpha)) / (2 * alpha), 0, 255));
}

/// Mean colours by alpha.
struct ColourSum {
  std::int64_t r = 0, g = 0, b = 0, weight = 0;
  void add(Rgba p) {
    r += p.r * p.a;
    g += p.g * p.a;
    b += p.b * p.a;
    weight += p.a;
  }
  Rgba mean() const {
    if (weight == 0) return {0, 0, 0, 0};
    const auto share = [this](std::int64_t sum) { return static_cast<std::uint8_t>((sum + weight / 2) / weight); };
    return {share(r), share(g), share(b), 0};
  }
};

/// Gives pixels that do not show the mean colour of their block, or of the whole layer.
void fill_transparent(Image& layer) {
  ColourSum whole;
  for (const Rgba p : layer.pixels) whole.add(p);
  const Rgba elsewhere = whole.mean();
  for (int top = 0; top < layer.height; top += kBlock)
    for (int left = 0; left < layer.width; left += kBlock) {
      const int right = std::min(left + kBlock, layer.width), bottom = std::min(top + kBlock, layer.height);
      ColourSum sum;
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) sum.add(layer.at(x, y));
      const Rgba fill = sum.weight > 0 ? sum.mean() : elsewhere;
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
          if (layer.at(x, y).a == 0) layer.at(x, y) = fill;
    }
}

void limit_light(const Plane& background, const ElementLight& light, Plane& sum) {
  if (std::isinf(light.darkest) && std::isinf(light.brightest)) return;
  for (std::size_t i = 0; i < sum.values.size(); ++i)
    sum.values[i] =
        std::clamp(sum.values[i], background.values[i] + light.darkest, background.values[i] + light.brightest);
}

void fit(Image& image, int width, int height) {
  if (image.width != width || image.height != height) image = Image(width, height);
}

}  // namespace

void fill_image(const Planes& planes, Image& image) {
  if (planes.size() != 1 && planes.size() != 3) throw InvalidInput("a picture is made of 1 or 3 planes");
  fit(image, planes[0].width, planes[0].height);
  const float *r = planes[0].values.data(), *g = planes[planes.size() / 2].values.data(),
              *b = planes.back().values.data();
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {to_byte(r[i]), to_byte(g[i]), to_byte(b[i]), 255};
}

void make_layer(const Image& picture, const Image& background, Image& layer) {
  if (picture.width != background.width || picture.height != background.height)
    throw InvalidInput("the picture and its background have different sizes");
  fit(layer, picture.width, picture.height);
  for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
    const Rgba p = picture.pixels[i], q = background.pixels[i];
    if (p == q) {
      layer.pixels[i] = {0, 0, 0, 0};
      continue;
    }
    const int alpha = std::max({alpha_needed(p.r, q.r), alpha_needed(p.g, q.g), alpha_needed(p.b, q.b)});
    layer.pixels[i] = {unmixed(p.r, q.r, alpha), unmixed(p.g, q.g, alpha), unmixed(p.b, q.b, alpha),
                       static_cast<std::uint8_t>(alpha)};
  }
  fill_transparent(layer);
}

PhotoPainter::PhotoPainter(Planes background, double magnification, int num_base_planes, const ElementLight& light)
    : background_(std::move(background)), renderer_(magnification, num_base_planes), light_(light) {
  fill_image(background_, background_image_);
  sum_ = background_;
}

void PhotoPainter::paint(const MovetonFrame& frame, Image& picture, Image& layer) {
  for (std::size_t k = 0; k < sum_.size(); ++k)
    std::copy(background_[k].values.begin(), background_[k].values.end(), sum_[k].values.begin());
  renderer_.add(frame.bases, sum_);
  for (std::size_t k = 0; k < sum_.size(); ++k) limit_light(background_[k], light_, sum_[k]);
  fill_image(sum_, picture);
  make_layer(picture, background_image_, layer);
}

}  // namespace motex
