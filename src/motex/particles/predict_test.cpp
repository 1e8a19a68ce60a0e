// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/predict.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr int kWidth = 120, kHeight = 90;

/// Flakes that fall with a persistent velocity on noise of deviation 4.
ClipFrames snow(int num_frames) {
  struct Flake {
    double x, y, vx, vy, scale;
    float coefficient;
  };
  Rng rng(5);
  std::vector<Flake> flakes;
  ClipFrames clip{kWidth, kHeight, 25, {}, {}};
  for (int t = -40; t < num_frames; ++t) {
    if (rng.uniform() < 0.8)
      flakes.push_back(
          {rng.uniform(-20, kWidth), -4, rng.normal() + 1, 3 + 0.5 * rng.normal(), rng.uniform(1.2, 2.2), 400});
    BaseMap map{kWidth, kHeight, 1, {}};
    for (Flake& f : flakes) {
      f.vx = 1 + 0.9 * (f.vx - 1) + 0.2 * rng.normal();
      f.vy = 3 + 0.9 * (f.vy - 3) + 0.2 * rng.normal();
      f.x += f.vx;
      f.y += f.vy;
      Base base{BaseKind::kGaussian, f.x, f.y, f.scale, 0, {}};
      base.coefficients[0] = f.coefficient;
      map.bases.push_back(base);
    }
    if (t < 0) continue;
    Plane frame = reconstruct(map, {Plane(kWidth, kHeight, 40)})[0];
    for (float& v : frame.values) v = std::clamp(v + static_cast<float>(4 * rng.normal()), 0.0F, 255.0F);
    clip.luma.push_back(frame);
  }
  return clip;
}

TEST(Predict, BeatsTheMeanFrameTheLastFrameAndComesNearTheNoise) {
  const ClipFrames clip = snow(50);
  ClipFrames training = clip;
  training.luma.resize(35);
  FramePredictor predictor(training);
  double ours = 0, mean = 0, last = 0;
  for (std::size_t t = 35; t < 50; ++t) {
    ours += psnr(predictor.predict(), clip.luma[t]) / 15;
    mean += psnr(predictor.background(), clip.luma[t]) / 15;
    last += psnr(clip.luma[t - 1], clip.luma[t]) / 15;
    predictor.observe(clip.luma[t]);
  }
  EXPECT_GT(ours, mean + 3);
  EXPECT_GT(ours, last + 3);
  EXPECT_GT(ours, 32.5);  // the noise alone is 36.1 dB
}

TEST(Predict, BadInputIsRefused) {
  ClipFrames clip = snow(12);
  FramePredictor predictor(clip);
  EXPECT_THROW(predictor.observe(Plane(5, 5)), InvalidInput);
  clip.luma.resize(3);
  EXPECT_THROW(FramePredictor{clip}, InvalidInput);
}

}  // namespace
}  // namespace motex
