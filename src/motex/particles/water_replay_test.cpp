// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/water_replay.h"

#include <gtest/gtest.h>

#include <cmath>

namespace motex {
namespace {

/// Still mist that is dark in the first half of the clip and bright in the second.
TEST(WaterReplay, KeepsTheMeanLightOfTheClip) {
  constexpr int kSide = 96, kFrames = 80;
  std::vector<Cable> cables;
  for (int y = 6; y < kSide; y += 12)
    for (int x = 6; x < kSide; x += 12) {
      Cable& cable = cables.emplace_back();
      for (int t = 0; t < kFrames; ++t) {
        Base base{BaseKind::kGaussian, static_cast<double>(x), static_cast<double>(y), 6, 0, {}};
        base.coefficients.fill(t < kFrames / 2 ? -100.0F : 100.0F);
        cable.core.push_back(base);
      }
    }
  FlowField flow;
  flow.vx = flow.vy = flow.strength = Plane(kSide / flow.spacing + 1, kSide / flow.spacing + 1);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    WaterReplay replay(cables, kFrames, kSide, kSide, flow, {}, seed);
    MovetonFrame frame;
    double sum = 0, size = 1e-9;
    for (int t = 0; t < 600; ++t) {
      replay.next(frame);
      for (const Base& base : frame.bases) {
        sum += static_cast<double>(base.coefficients[0]);
        size += std::abs(static_cast<double>(base.coefficients[0]));
      }
    }
    EXPECT_LT(std::abs(sum / size), 0.3) << seed;
  }
}

}  // namespace
}  // namespace motex
