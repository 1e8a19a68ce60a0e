// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/mask.h"

#include <algorithm>
#include <limits>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kFar = 1e20;

/// min over j of values[j] + (i − j)², for all i: the lower envelope of parabolas.
void distances_along(std::vector<double>& values, std::vector<int>& apexes, std::vector<double>& borders) {
  const int size = static_cast<int>(values.size());
  const auto at = [](auto& list, int i) -> auto& { return list[static_cast<std::size_t>(i)]; };
  const auto crossing = [&](int a, int b) {
    return (at(values, b) + static_cast<double>(b) * b - at(values, a) - static_cast<double>(a) * a) / (2.0 * (b - a));
  };
  int last = 0;
  at(apexes, 0) = 0;
  at(borders, 0) = -std::numeric_limits<double>::infinity();
  for (int i = 1; i < size; ++i) {
    double border = crossing(at(apexes, last), i);
    while (border <= at(borders, last)) border = crossing(at(apexes, --last), i);
    at(apexes, ++last) = i;
    at(borders, last) = border;
  }
  std::vector<double> result(values.size());
  for (int i = 0, k = 0; i < size; ++i) {
    while (k < last && at(borders, k + 1) < i) ++k;
    const double step = i - at(apexes, k);
    at(result, i) = at(values, at(apexes, k)) + step * step;
  }
  values = result;
}

Mask within(const Plane& squared, double radius) {
  Mask out(squared.width, squared.height);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = squared.values[i] <= radius * radius ? 1 : 0;
  return out;
}

Mask opposite(Mask mask) {
  for (std::uint8_t& pixel : mask.pixels) pixel = pixel != 0 ? 0 : 1;
  return mask;
}

}  // namespace

Mask::Mask(int width_px, int height_px, bool fill) : width(width_px), height(height_px) {
  if (width < 0 || height < 0 || width > 32768 || height > 32768)
    throw InvalidInput("the sides of a mask go up to 32768");
  pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill ? 1 : 0);
}

std::int64_t Mask::area() const {
  return std::count_if(pixels.begin(), pixels.end(), [](std::uint8_t pixel) { return pixel != 0; });
}

Mask threshold(const Plane& plane, float level) {
  Mask out(plane.width, plane.height);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = plane.values[i] >= level ? 1 : 0;
  return out;
}

Plane squared_distance(const Mask& mask) {
  Plane out(mask.width, mask.height);
  if (out.values.empty()) return out;
  const auto longest = static_cast<std::size_t>(std::max(mask.width, mask.height));
  std::vector<int> apexes(longest);
  std::vector<double> borders(longest), line;
  for (int x = 0; x < mask.width; ++x) {
    line.resize(static_cast<std::size_t>(mask.height));
    for (int y = 0; y < mask.height; ++y) line[static_cast<std::size_t>(y)] = mask.at(x, y) ? 0 : kFar;
    distances_along(line, apexes, borders);
    for (int y = 0; y < mask.height; ++y) out.at(x, y) = static_cast<float>(line[static_cast<std::size_t>(y)]);
  }
  for (int y = 0; y < mask.height; ++y) {
    line.assign(out.row(y), out.row(y) + mask.width);
    distances_along(line, apexes, borders);
    for (int x = 0; x < mask.width; ++x) {
      const double value = line[static_cast<std::size_t>(x)];
      out.at(x, y) = value < kFar / 10 ? static_cast<float>(value) : std::numeric_limits<float>::infinity();
    }
  }
  return out;
}

Mask dilate(const Mask& mask, double radius) {
  if (!(radius >= 0)) throw InvalidInput("the radius of a mask operation is at least 0 pixels");
  return within(squared_distance(mask), radius);
}

Mask erode(const Mask& mask, double radius) { return opposite(dilate(opposite(mask), radius)); }

double intersection_over_union(const Mask& a, const Mask& b) {
  if (a.width != b.width || a.height != b.height) throw InvalidInput("only masks of one size can be compared");
  std::int64_t both = 0, either = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    both += a.pixels[i] != 0 && b.pixels[i] != 0;
    either += a.pixels[i] != 0 || b.pixels[i] != 0;
  }
  return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either);
}

}  // namespace motex
