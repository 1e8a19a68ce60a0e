// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/colour.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace motex {
namespace {

std::uint8_t srgb_byte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(encoded * 255 + 0.5);
}

}  // namespace

Rgba oklch(double lightness, double chroma, double hue_deg) {
  const double hue = hue_deg * 3.14159265358979323846 / 180;
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), 255};
}

Rgba series_colour(int idx) {
  static constexpr struct {
    double lightness, chroma, hue_deg;
  } kSeries[] = {{0.53, 0.14, 255}, {0.63, 0.19, 40},  {0.60, 0.13, 155}, {0.52, 0.17, 320},
                 {0.72, 0.15, 80},  {0.66, 0.11, 210}, {0.45, 0.10, 20},  {0.45, 0.02, 260}};
  const auto& c = kSeries[static_cast<std::size_t>(std::max(idx, 0)) % std::size(kSeries)];
  return oklch(c.lightness, c.chroma, c.hue_deg);
}

Rgba unit_colour(int idx) {
  constexpr double kGoldenAngleDeg = 137.50776405;
  static constexpr double kLightness[] = {0.68, 0.58, 0.76};
  const int n = std::max(idx, 0);
  return oklch(kLightness[n % 3], 0.125, std::fmod(25 + n * kGoldenAngleDeg, 360));
}

Rgba heat_colour(double value) {
  if (std::isnan(value)) return {190, 190, 190, 255};
  const double t = std::clamp(value, 0.0, 1.0);
  return oklch(0.24 + 0.68 * t, 0.11 + 0.05 * t, 300 - 198 * t);
}

}  // namespace motex
