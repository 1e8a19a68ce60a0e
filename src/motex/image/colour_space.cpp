// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/colour_space.h"

#include <cmath>

namespace motex {
namespace {

struct Weights {
  double red, blue;
  double green() const { return 1 - red - blue; }
};

Weights weights_of(YcbcrMatrix matrix) {
  return matrix == YcbcrMatrix::kBt601 ? Weights{0.299, 0.114} : Weights{0.2126, 0.0722};
}

struct Levels {
  double black, luma_span, chroma_span;
};

Levels levels_of(YcbcrRange range) { return range == YcbcrRange::kStudio ? Levels{16, 219, 224} : Levels{0, 255, 255}; }

}  // namespace

std::array<double, 3> ycbcr_from_rgb(const std::array<double, 3>& rgb, YcbcrMatrix matrix, YcbcrRange range) {
  const Weights k = weights_of(matrix);
  const Levels levels = levels_of(range);
  const double luma = (k.red * rgb[0] + k.green() * rgb[1] + k.blue * rgb[2]) / 255;
  const double blue = (rgb[2] / 255 - luma) / (2 * (1 - k.blue)), red = (rgb[0] / 255 - luma) / (2 * (1 - k.red));
  return {levels.black + levels.luma_span * luma, 128 + levels.chroma_span * blue, 128 + levels.chroma_span * red};
}

std::array<double, 3> rgb_from_ycbcr(const std::array<double, 3>& ycbcr, YcbcrMatrix matrix, YcbcrRange range) {
  const Weights k = weights_of(matrix);
  const Levels levels = levels_of(range);
  const double luma = (ycbcr[0] - levels.black) / levels.luma_span;
  const double b = luma + 2 * (1 - k.blue) * (ycbcr[1] - 128) / levels.chroma_span;
  const double r = luma + 2 * (1 - k.red) * (ycbcr[2] - 128) / levels.chroma_span;
  return {255 * r, 255 * (luma - k.red * r - k.blue * b) / k.green(), 255 * b};
}

double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double light) {
  return light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace motex
