// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/compression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

TexturedMotion snow() {
  TexturedMotion model;
  model.width = 96;
  model.height = 64;
  model.num_frames = 50;
  model.noise = 4;
  model.background = {Plane(96, 64)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x)
      model.background[0].at(x, y) = static_cast<float>(60 + 0.5 * x + 10 * std::sin(0.2 * y));
  Rng rng(1);
  for (int k = 0; k < 120; ++k) {
    Cable& cable = model.cables.emplace_back();
    cable.first_frame = static_cast<std::int64_t>(rng.below(40));
    double x = rng.uniform(0, 96), y = 0;
    for (int t = 0; t < 18 && cable.end_frame() < 50; ++t) {
      Base& base = cable.core.emplace_back();
      base.kind = BaseKind::kGaussian;
      base.x = x += 1 + 0.2 * rng.normal();
      base.y = y += 3.5 + 0.2 * rng.normal();
      base.scale = 1.5;
      base.coefficients[0] = 220;
    }
  }
  model.maps = estimate_maps(model.cables, 96, 64, 50);
  return model;
}

TEST(Compression, TheGenerativeModelComesBack) {
  const TexturedMotion model = snow();
  const TexturedMotion back = parse_generative_model(generative_model_bytes(model), "x");
  EXPECT_GT(psnr(back.background, model.background), 40);
  EXPECT_TRUE(back.cables.empty());
  EXPECT_EQ(back.num_frames, 50);
  EXPECT_NEAR(back.maps.births_per_frame, model.maps.births_per_frame, 1e-6);
  for (const auto& [a, b] :
       {std::pair{&back.maps.source, &model.maps.source}, {&back.maps.hazard, &model.maps.hazard}}) {
    float peak = 0, error = 0;
    for (std::size_t i = 0; i < b->values.size(); ++i) {
      peak = std::max(peak, b->values[i]);
      error = std::max(error, std::abs(a->values[i] - b->values[i]));
    }
    EXPECT_GT(peak, 0);
    EXPECT_LT(error, 0.05F * peak);
  }
}

TEST(Compression, BothRatiosAreOfTheSameClip) {
  const CompressionSummary summary = measure_compression(snow());
  EXPECT_EQ(summary.raw_bytes, 96 * 64 * 50);
  EXPECT_GT(summary.clip_ratio(), 50);
  EXPECT_GT(summary.model_ratio(), 50);
  TexturedMotion longer = snow();  // the model does not grow with the clip, but for rounding
  longer.num_frames = 500;
  EXPECT_LT(measure_compression(longer).model_bytes, summary.model_bytes + 16);
}

TEST(Compression, DamagedModelsAreSaid) {
  const std::string whole = generative_model_bytes(snow());
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 20)
    EXPECT_THROW(parse_generative_model(whole.substr(0, size), "x"), InvalidInput);
  for (std::size_t place = 0; place < whole.size(); place += 1 + whole.size() / 20) {
    std::string altered = whole;
    altered[place] = static_cast<char>(altered[place] ^ 0x21);
    EXPECT_THROW(parse_generative_model(altered, "x"), InvalidInput);
  }
}

}  // namespace
}  // namespace motex
