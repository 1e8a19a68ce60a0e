// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/path_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "motex/particles/birth_death.h"
#include "motex/particles/synthesize.h"

namespace motex {
namespace {

TEST(PathReplay, StepsComeAgainInReversedOrder) {
  Cable cable;
  for (const double x : {0.0, 1.0, 3.0, 6.0}) cable.core.push_back({BaseKind::kGaussian, x, -x, 1, 0, {}});
  PathReplay path(cable, -2);
  std::vector<double> dx;
  for (int k = 0; k < 10; ++k) dx.push_back(path.next().dx);
  EXPECT_EQ(dx, (std::vector<double>{2, 1, 1, 2, 3, 3, 2, 1, 1, 2}));
  EXPECT_EQ(path.peek().dy, -3);
  EXPECT_EQ(path.mean().dx, 2);
  path.hold(2);
  for (const double wanted : {3.0, 3.0, 3.0, 3.0, 2.0}) EXPECT_EQ(path.next().dx, wanted) << "held, and mirrored";
}

/// Birds that turn: each comes over the left border, circles upwards and is gone after 40 frames.
TexturedMotion circling_birds() {
  TexturedMotion model;
  model.width = 160;
  model.height = 120;
  model.num_frames = 120;
  for (int k = 0; k < 8; ++k) {
    Cable cable;
    cable.first_frame = 4 + 9 * k;
    double x = 0, y = 40 + 8 * k;
    const double speed = 1 + 0.2 * k;
    for (int t = 0; t < 40; ++t) {
      Base& core = cable.core.emplace_back();
      core = {BaseKind::kGaussian, x, y, 2, 0, {}};
      core.coefficients.fill(static_cast<float>(coefficient_of_peak(core, 80)));
      x += speed * std::cos(0.03 * t);
      y -= speed * std::sin(0.03 * t);
    }
    model.cables.push_back(cable);
  }
  model.background = Planes(1, Plane(model.width, model.height, 100));
  model.maps = estimate_maps(model.cables, model.width, model.height, model.num_frames);
  return model;
}

TEST(PathReplay, FewElementsFlyAndLiveAsThoseThatWereSeen) {
  const TexturedMotion model = circling_birds();
  constexpr std::int64_t kFrames = 1200;
  const std::vector<Cable> cables = synthesize_cables(model, {}, kFrames);
  double present = 0;
  std::size_t num_whole = 0;
  for (const Cable& cable : cables) {
    const auto num_inside = static_cast<double>(
        std::count_if(cable.core.begin(), cable.core.end(), [](const Base& base) { return base.x >= -0.5; }));
    present += num_inside / static_cast<double>(kFrames);
    for (std::size_t t = 1; t < cable.core.size(); ++t) {
      const double dx = cable.core[t].x - cable.core[t - 1].x, dy = cable.core[t].y - cable.core[t - 1].y;
      const double kind = (std::hypot(dx, dy) - 1) / 0.2, turned = -std::atan2(dy, dx) / 0.03;
      EXPECT_NEAR(kind, std::round(kind), 1e-6) << "a speed that no bird has";
      EXPECT_NEAR(turned, std::round(turned), 1e-6);
      EXPECT_LT(turned, 39.5);
    }
    if (cable.first_frame == 0 || cable.end_frame() == kFrames) continue;
    ++num_whole;
    EXPECT_NEAR(num_inside, 40, 4) << "none outlives those that were seen";
  }
  EXPECT_GT(num_whole, 40U);
  std::vector<Cable> short_run = synthesize_cables(model, {}, model.num_frames);
  double in_short = 0;
  for (const Cable& cable : short_run)
    for (const Base& base : cable.core) in_short += base.x >= -0.5 ? 1.0 / static_cast<double>(model.num_frames) : 0;
  EXPECT_NEAR(in_short, 8 * 40.0 / 120, 0.2) << "also in a run of the clip's length";
  EXPECT_NEAR(present, 8 * 40.0 / 120, 0.05);
}

}  // namespace
}  // namespace motex
