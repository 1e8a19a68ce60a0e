// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/compress_clip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/clip_codec.h"

namespace motex {
namespace {

struct Scene {
  ClipFrames clip;
  Planes background;
  std::vector<Cable> cables;
};

/// Twenty coloured blobs that fall, each with a weaker coil, before a slope.
Scene falling_blobs(int num_planes) {
  Scene scene;
  scene.clip.width = 96;
  scene.clip.height = 72;
  constexpr int kFrames = 16;
  for (int k = 0; k < num_planes; ++k) {
    Plane& plane = scene.background.emplace_back(96, 72);
    for (int y = 0; y < 72; ++y)
      for (int x = 0; x < 96; ++x) plane.at(x, y) = static_cast<float>(30 + 0.3 * x + 5 * k);
  }
  Rng rng(2);
  for (int k = 0; k < 20; ++k) {
    Cable& cable = scene.cables.emplace_back();
    cable.first_frame = static_cast<std::int64_t>(rng.below(6)) - 2;
    cable.coils.resize(1);
    const double x0 = rng.uniform(0, 96), y0 = rng.uniform(-10, 60), s = rng.uniform(1, 2.5);
    for (int t = 0; t < 14; ++t) {
      Base core;
      core.kind = BaseKind::kGaussian;
      core.x = x0 + 0.7 * t + 0.2 * rng.normal();
      core.y = y0 + 2.3 * t + 0.2 * rng.normal();
      core.scale = s;
      Base coil = core;
      coil.kind = BaseKind::kGaborSin;
      coil.angle = 4 + 0.1 * t;
      coil.x += 2;
      for (std::size_t c = 0; c < 3; ++c) {
        core.coefficients[c] = static_cast<float>(250 + 20 * static_cast<double>(c));
        coil.coefficients[c] = 80;
      }
      cable.core.push_back(core);
      cable.coils[0].push_back(coil);
    }
  }
  for (int t = 0; t < kFrames; ++t) {
    BaseMap map{96, 72, num_planes, {}};
    for (const Cable& cable : scene.cables)
      if (cable.covers(t)) {
        map.bases.push_back(cable.at(t));
        map.bases.push_back(cable.coils[0][static_cast<std::size_t>(t - cable.first_frame)]);
      }
    Planes planes = reconstruct(map, scene.background);
    for (Plane& plane : planes)
      for (float& value : plane.values) value += static_cast<float>(3 * rng.normal());
    const Image image = to_image(planes);
    scene.clip.luma.push_back(luma(image));
    if (num_planes == 3) scene.clip.colour.push_back(image);
  }
  return scene;
}

TEST(CompressClip, LosesLittleAndTheDecoderShowsWhatWasReported) {
  for (const int num_planes : {1, 3}) {
    const Scene scene = falling_blobs(num_planes);
    CompressClipReport report;
    const std::string bytes = compress_clip(scene.clip, scene.background, scene.cables, {}, {}, &report);
    EXPECT_GT(report.ratio(), num_planes == 3 ? 110 : 40);
    EXPECT_EQ(report.raw_bytes, 96 * 72 * num_planes * 16);
    EXPECT_EQ(report.bytes, static_cast<std::int64_t>(bytes.size()));
    const QuantisedClip back = read_clip_bytes(bytes, "x");
    const std::vector<Cable> cables = dequantised_cables(back);
    double mean = 0;
    for (int t = 0; t < 16; ++t) mean += psnr(decoded_frame(back, cables, t), frame_planes(scene.clip, t)) / 16;
    EXPECT_NEAR(mean, report.psnr, 1e-9);
    const double of_noise = 20 * std::log10(255 / 3.0);
    EXPECT_GT(report.psnr, of_noise - 0.9);
  }
}

TEST(CompressClip, FinerStepsAreNearerAndLonger) {
  const Scene scene = falling_blobs(1);
  CompressClipOptions options;
  double last_psnr = 100;
  std::int64_t last_bytes = 1 << 30;
  for (const double step : {2.0, 20.0, 100.0}) {
    options.coefficient_step = step;
    CompressClipReport report;
    compress_clip(scene.clip, scene.background, scene.cables, options, {}, &report);
    EXPECT_LT(report.psnr, last_psnr);
    EXPECT_LT(report.bytes, last_bytes);
    last_psnr = report.psnr;
    last_bytes = report.bytes;
  }
}

TEST(CompressClip, WhatCannotBeSeenIsNotStored) {
  Scene scene = falling_blobs(1);
  Cable far = scene.cables[0];
  for (Base& base : far.core) base.x += 500;
  for (Base& base : far.coils[0]) base.x += 500;
  const std::size_t num = quantise_clip(scene.clip, scene.background, scene.cables, {}).cables.size();
  scene.cables.push_back(far);
  const QuantisedClip quantised = quantise_clip(scene.clip, scene.background, scene.cables, {});
  EXPECT_EQ(quantised.cables.size(), num);
  for (const QuantisedCable& cable : quantised.cables) EXPECT_GE(cable.first_frame, 0);
}

TEST(CompressClip, SameBytesForAnyNumberOfThreads) {
  const Scene scene = falling_blobs(3);
  JobContext one, four;
  one.jobs = 1;
  four.jobs = 4;
  EXPECT_EQ(compress_clip(scene.clip, scene.background, scene.cables, {}, one),
            compress_clip(scene.clip, scene.background, scene.cables, {}, four));
}

TEST(CompressClip, FreeBasesFillUpWhatCablesLeave) {
  const Scene scene = falling_blobs(1);
  const std::vector<Cable> half(scene.cables.begin(), scene.cables.begin() + 10);
  CompressClipReport before, after;
  compress_clip(scene.clip, scene.background, half, {}, {}, &before);
  const std::vector<Cable> filled = with_free_bases(scene.clip, scene.background, half, 40);
  compress_clip(scene.clip, scene.background, filled, {}, {}, &after);
  EXPECT_GT(after.psnr, before.psnr + 3);
  for (int t = 0; t < 16; ++t) {
    int num = 0;
    for (const Cable& cable : filled) num += cable.covers(t) ? 1 + static_cast<int>(cable.coils.size()) : 0;
    EXPECT_LE(num, 40);
  }
}

TEST(CompressClip, AModelIsCompressedWithoutItsFrames) {
  const Scene scene = falling_blobs(3);
  TexturedMotion model;
  model.width = 96;
  model.height = 72;
  model.num_planes = 3;
  model.num_frames = 16;
  model.noise = 3;
  model.background = scene.background;
  model.cables = scene.cables;
  const QuantisedClip quantised = quantise_cables(model);
  const std::vector<Cable> cables = dequantised_cables(quantised);
  double mean = 0;
  for (int t = 0; t < 16; ++t) mean += psnr(decoded_frame(quantised, cables, t), frame_planes(scene.clip, t)) / 16;
  EXPECT_GT(mean, 20 * std::log10(255 / 3.0) - 1.5);
}

TEST(CompressClip, SaysWhatDoesNotFit) {
  Scene scene = falling_blobs(1);
  EXPECT_THROW(quantise_clip(scene.clip, {Plane(95, 72)}, scene.cables, {}), InvalidInput);
  EXPECT_THROW(quantise_clip(scene.clip, {}, scene.cables, {}), InvalidInput);
  EXPECT_THROW(quantise_clip({}, scene.background, scene.cables, {}), InvalidInput);
}

}  // namespace
}  // namespace motex
