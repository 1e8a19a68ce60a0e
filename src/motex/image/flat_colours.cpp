// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/flat_colours.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "motex/core/error.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr int kRounds = 20;
constexpr int kMostSamples = 20000;
constexpr double kBorderBlur = 1.3;  // pixels
constexpr int kSubsamples = 3;       // a side, of an output pixel

float squared_distance(const LevelTriple& a, const LevelTriple& b) {
  float sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

std::vector<LevelTriple> luma_quantiles(std::span<const LevelTriple> colours, int count) {
  std::vector<std::size_t> order(colours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::apply(luma_of<float>, colours[a]) < std::apply(luma_of<float>, colours[b]);
  });
  std::vector<LevelTriple> centres;
  for (int k = 0; k < count; ++k) {
    const double at = (k + 0.5) / count * static_cast<double>(order.size());
    const LevelTriple& centre = colours[order[std::min(order.size() - 1, static_cast<std::size_t>(at))]];
    if (std::find(centres.begin(), centres.end(), centre) == centres.end()) centres.push_back(centre);
  }
  return centres;
}

/// Values at (x, y) between pixel centres, edges repeated.
void sample(const std::vector<Plane>& shares, double x, double y, std::vector<float>& out) {
  const int width = shares[0].width, height = shares[0].height;
  x = std::clamp(x, 0.0, width - 1.0);
  y = std::clamp(y, 0.0, height - 1.0);
  const int left = std::min(static_cast<int>(x), std::max(0, width - 2)),
            top = std::min(static_cast<int>(y), std::max(0, height - 2));
  const int right = std::min(left + 1, width - 1), bottom = std::min(top + 1, height - 1);
  const auto a = static_cast<float>(x - left), b = static_cast<float>(y - top);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const Plane& p = shares[k];
    out[k] = (1 - b) * ((1 - a) * p.at(left, top) + a * p.at(right, top)) +
             b * ((1 - a) * p.at(left, bottom) + a * p.at(right, bottom));
  }
}

std::vector<LevelTriple> triples_of(const Planes& planes, double blur) {
  Planes smooth;
  for (const Plane& plane : planes) smooth.push_back(gaussian_blur(plane, blur));
  std::vector<LevelTriple> all(smooth[0].values.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) all[i][k] = smooth[smooth.size() == 1 ? 0 : k].values[i];
  return all;
}

/// For each colour how much of the surroundings of a pixel has it.
std::vector<Plane> shares_of(const std::vector<LevelTriple>& pixels, const std::vector<LevelTriple>& colours, int width,
                             int height) {
  std::vector<Plane> shares(colours.size(), Plane(width, height));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    shares[static_cast<std::size_t>(nearest_colour(colours, pixels[i]))].values[i] = 1;
  for (Plane& share : shares) share = gaussian_blur(share, kBorderBlur);
  return shares;
}

}  // namespace

std::vector<LevelTriple> palette(std::span<const LevelTriple> colours, std::span<const double> weights, int count) {
  if (count < 1 || colours.empty()) throw InvalidInput("a palette needs at least one colour to choose from");
  if (!weights.empty() && weights.size() != colours.size())
    throw InvalidInput("a palette needs one weight for each colour");
  std::vector<LevelTriple> centres = luma_quantiles(colours, count);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::array<double, 4>> sums(centres.size(), {0, 0, 0, 0});
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const double weight = weights.empty() ? 1 : weights[i];
      std::array<double, 4>& sum = sums[static_cast<std::size_t>(nearest_colour(centres, colours[i]))];
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * static_cast<double>(colours[i][k]);
      sum[3] += weight;
    }
    for (std::size_t c = 0; c < centres.size(); ++c)
      for (std::size_t k = 0; k < 3; ++k)
        if (sums[c][3] > 0) centres[c][k] = static_cast<float>(sums[c][k] / sums[c][3]);
  }
  std::stable_sort(centres.begin(), centres.end(), [](const LevelTriple& a, const LevelTriple& b) {
    return std::apply(luma_of<float>, a) < std::apply(luma_of<float>, b);
  });
  return centres;
}

int nearest_colour(const std::vector<LevelTriple>& palette, const LevelTriple& colour) {
  int best = 0;
  for (std::size_t k = 1; k < palette.size(); ++k)
    if (squared_distance(palette[k], colour) < squared_distance(palette[static_cast<std::size_t>(best)], colour))
      best = static_cast<int>(k);
  return best;
}

Image flat_colours(const Planes& planes, double magnification, const FlatColoursOptions& options) {
  if (planes.empty() || planes[0].values.empty() || (planes.size() != 1 && planes.size() != 3))
    throw InvalidInput("flat colours are made of a picture with one or three planes");
  const int width = planes[0].width, height = planes[0].height;
  const double blur = options.smoothing > 0 ? options.smoothing : std::max(width, height) / 80.0;
  const std::vector<LevelTriple> pixels = triples_of(planes, blur);
  std::vector<LevelTriple> samples;
  const std::size_t step = 1 + pixels.size() / kMostSamples;
  for (std::size_t i = 0; i < pixels.size(); i += step) samples.push_back(pixels[i]);
  const std::vector<LevelTriple> colours = palette(samples, {}, options.num_colours);
  const std::vector<Plane> shares = shares_of(pixels, colours, width, height);
  Image out(std::max(1, static_cast<int>(std::lround(width * magnification))),
            std::max(1, static_cast<int>(std::lround(height * magnification))));
  std::vector<float> here(colours.size());
  const double scale_x = static_cast<double>(width) / out.width, scale_y = static_cast<double>(height) / out.height;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      LevelTriple sum{};
      for (int v = 0; v < kSubsamples; ++v)
        for (int u = 0; u < kSubsamples; ++u) {
          sample(shares, (x + (u + 0.5) / kSubsamples) * scale_x - 0.5, (y + (v + 0.5) / kSubsamples) * scale_y - 0.5,
                 here);
          const auto most = static_cast<std::size_t>(std::max_element(here.begin(), here.end()) - here.begin());
          for (std::size_t k = 0; k < 3; ++k) sum[k] += colours[most][k];
        }
      const auto level = [&](std::size_t k) {
        return static_cast<std::uint8_t>(std::clamp(sum[k] / (kSubsamples * kSubsamples), 0.0F, 255.0F) + 0.5F);
      };
      out.at(x, y) = {level(0), level(1), level(2), 255};
    }
  return out;
}

}  // namespace motex
