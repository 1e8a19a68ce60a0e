// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motex/core/error.h"

namespace motex {
namespace {

std::uint8_t to_byte(float level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F); }

void check_planes(const Planes& planes) {
  if (planes.size() != 1 && planes.size() != 3 && planes.size() != 4)
    throw InvalidInput("an image has 1, 3 or 4 planes, not " + std::to_string(planes.size()));
  for (const Plane& plane : planes)
    if (plane.width != planes[0].width || plane.height != planes[0].height)
      throw InvalidInput("the planes of an image must have one size");
}

double squared_difference(const Plane& a, const Plane& b) {
  if (a.width != b.width || a.height != b.height || a.values.empty())
    throw InvalidInput("only images of one size, not empty, can be compared");
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double difference = a.values[i] - b.values[i];
    sum += difference * difference;
  }
  return sum;
}

double decibels(double mean_square) {
  return mean_square > 0 ? 10 * std::log10(255.0 * 255.0 / mean_square) : std::numeric_limits<double>::infinity();
}

}  // namespace

Plane::Plane(int width_px, int height_px, float fill) : width(width_px), height(height_px) {
  if (width < 0 || height < 0 || width > 32768 || height > 32768)
    throw InvalidInput("a plane of " + std::to_string(width) + " × " + std::to_string(height) +
                       " pixels cannot be made: sides go up to 32768");
  values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
}

bool is_grey(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgba& p) { return p.r == p.g && p.g == p.b; });
}

bool is_opaque(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgba& p) { return p.a == 255; });
}

Planes to_planes(const Image& image) {
  if (!is_opaque(image)) return to_planes(image, 4);
  return to_planes(image, is_grey(image) ? 1 : 3);
}

Planes to_planes(const Image& image, int num_planes) {
  if (num_planes == 1) return {luma(image)};
  if (num_planes != 3 && num_planes != 4)
    throw InvalidInput("an image has 1, 3 or 4 planes, not " + std::to_string(num_planes));
  Planes planes(static_cast<std::size_t>(num_planes), Plane(image.width, image.height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgba p = image.pixels[i];
    planes[0].values[i] = p.r;
    planes[1].values[i] = p.g;
    planes[2].values[i] = p.b;
    if (num_planes == 4) planes[3].values[i] = p.a;
  }
  return planes;
}

Image to_image(const Planes& planes) {
  check_planes(planes);
  const Plane &r = planes[0], &g = planes[planes.size() > 1 ? 1 : 0], &b = planes[planes.size() > 1 ? 2 : 0];
  Image image(r.width, r.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {to_byte(r.values[i]), to_byte(g.values[i]), to_byte(b.values[i]),
                       planes.size() == 4 ? to_byte(planes[3].values[i]) : std::uint8_t{255}};
  return image;
}

Image to_image(const Plane& grey) { return to_image(Planes{grey}); }

Plane luma(const Image& image) {
  Plane out(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgba p = image.pixels[i];
    out.values[i] = p.r == p.g && p.g == p.b ? p.r : luma_of<float>(p.r, p.g, p.b);
  }
  return out;
}

Plane luma(const Planes& planes) {
  check_planes(planes);
  if (planes.size() == 1) return planes[0];
  Plane out(planes[0].width, planes[0].height);
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = luma_of(planes[0].values[i], planes[1].values[i], planes[2].values[i]);
  return out;
}

Plane negated(Plane plane) {
  for (float& value : plane.values) value = -value;
  return plane;
}

Plane minus(Plane a, const Plane& b) {
  if (a.width != b.width || a.height != b.height)
    throw InvalidInput("only planes of one size can be subtracted from one another");
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
  return a;
}

Planes minus(Planes a, const Planes& b) {
  if (a.size() != b.size()) throw InvalidInput("only images with as many planes can be subtracted from one another");
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = minus(std::move(a[k]), b[k]);
  return a;
}

double sum_of_squares(const Plane& plane) {
  double sum = 0;
  for (const float value : plane.values) sum += static_cast<double>(value) * static_cast<double>(value);
  return sum;
}

double psnr(const Plane& a, const Plane& b) {
  return decibels(squared_difference(a, b) / static_cast<double>(a.values.size()));
}

double psnr(const Planes& a, const Planes& b) {
  if (a.size() != b.size() || a.empty()) throw InvalidInput("only images with as many planes can be compared");
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += squared_difference(a[k], b[k]);
  return decibels(sum / static_cast<double>(a.size() * a[0].values.size()));
}

double psnr(const Image& a, const Image& b) { return psnr(to_planes(a, 3), to_planes(b, 3)); }

}  // namespace motex
