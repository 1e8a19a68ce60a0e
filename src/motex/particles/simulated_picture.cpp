// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/simulated_picture.h"

#include <algorithm>
#include <cmath>

#include "motex/core/parallel.h"
#include "motex/particles/parzen.h"

namespace motex {
namespace {

constexpr double kReach = 3.7;  // e^{−3.7²/2} = 0.001

/// apply(pixel of each plane, weight 0 … 1, plane) over the pixels that the blob reaches.
template <typename Apply>
void over_blob(Planes& planes, const DrawnBlob& blob, const Apply& apply) {
  const double c = std::cos(blob.angle), s = std::sin(blob.angle);
  const double reach_x = kReach * std::hypot(blob.along * c, blob.across * s);
  const double reach_y = kReach * std::hypot(blob.along * s, blob.across * c);
  const Plane& first = planes[0];
  const double width = first.width, height = first.height;
  if (!(blob.x + reach_x >= 0 && blob.x - reach_x < width && blob.y + reach_y >= 0 && blob.y - reach_y < height))
    return;
  const int left = static_cast<int>(std::max(0.0, std::ceil(blob.x - reach_x)));
  const int right = static_cast<int>(std::min(width - 1, std::floor(blob.x + reach_x)));
  const int top = static_cast<int>(std::max(0.0, std::ceil(blob.y - reach_y)));
  const int bottom = static_cast<int>(std::min(height - 1, std::floor(blob.y + reach_y)));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double u = ((x - blob.x) * c + (y - blob.y) * s) / blob.along;
      const double v = ((y - blob.y) * c - (x - blob.x) * s) / blob.across;
      const double square = u * u + v * v;
      if (square > kReach * kReach) continue;
      const double weight = std::exp(-square / 2);
      for (std::size_t k = 0; k < planes.size(); ++k) apply(planes[k].at(x, y), weight, k);
    }
  }
}

}  // namespace

void add_blob(Planes& planes, const DrawnBlob& blob) {
  over_blob(planes, blob,
            [&](float& pixel, double weight, std::size_t k) { pixel += static_cast<float>(blob.peak[k] * weight); });
}

void cover_with_blob(Planes& planes, const DrawnBlob& blob, double opacity) {
  over_blob(planes, blob, [&](float& pixel, double weight, std::size_t k) {
    pixel += static_cast<float>(opacity * weight * (blob.peak[k] - static_cast<double>(pixel)));
  });
}

Plane textured_background(int width, int height, double level, double texture, Rng& rng) {
  Plane noise(width, height);
  for (float& value : noise.values) value = static_cast<float>(rng.normal());
  Plane smooth = parzen_smooth(noise, 3);
  double mean = 0, square = 0;
  for (const float value : smooth.values) mean += static_cast<double>(value);
  mean /= static_cast<double>(smooth.values.size());
  for (const float value : smooth.values)
    square += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
  const double deviation = std::sqrt(square / static_cast<double>(smooth.values.size()));
  const double factor = deviation > 0 ? texture / deviation : 0;
  for (float& value : smooth.values) value = static_cast<float>(level + (static_cast<double>(value) - mean) * factor);
  return smooth;
}

Image noisy_picture(Planes planes, double noise, Rng& rng) {
  if (noise > 0)
    for (Plane& plane : planes)
      for (float& value : plane.values) value += static_cast<float>(noise * rng.normal());
  return to_image(planes);
}

void draw_frames(SimulatedScene& scene, const Planes& background, int num_frames, double noise, std::uint64_t seed,
                 const std::function<void(int frame, Planes& planes)>& draw) {
  constexpr std::uint64_t kNoise = 1000;  // streams of the generator, one a frame
  scene.frames.resize(static_cast<std::size_t>(num_frames));
  parallel_for(0, num_frames, [&](int t) {
    Planes planes = background;
    draw(t, planes);
    Rng rng = Rng(seed).fork(kNoise + static_cast<std::uint64_t>(t));
    scene.frames[static_cast<std::size_t>(t)] = noisy_picture(std::move(planes), noise, rng);
  });
}

int draw_poisson(Rng& rng, double mean) {
  int count = 0;
  for (; mean > 20; mean -= 20) count += draw_poisson(rng, 20);
  const double limit = std::exp(-mean);
  for (double product = rng.uniform(); product > limit; product *= rng.uniform()) ++count;
  return count;
}

}  // namespace motex
