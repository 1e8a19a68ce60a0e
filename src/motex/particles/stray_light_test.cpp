// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/stray_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace motex {
namespace {

Base spot(double x, double y, double peak) {
  Base base{BaseKind::kGaussian, x, y, 2, 0, {}};
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, peak));
  return base;
}

/// A dark body with a wing at (dx, 0) of that light.
Cable bird(double body, double dx, double wing) {
  Cable cable;
  cable.coils.resize(1);
  for (int t = 0; t < 20; ++t) {
    cable.core.push_back(spot(40 + t, 30, body));
    cable.coils[0].push_back(spot(40 + t + dx, 30, wing));
  }
  return cable;
}

TEST(StrayLight, IsWhereADarkElementHasBrightSpots) {
  TexturedMotion model;
  for (int k = 0; k < 10; ++k) model.cables.push_back(bird(-80, 5, -40));
  model.cables.push_back(bird(-80, 1, 30));   // a body that is less dark in the middle
  model.cables.push_back(bird(-60, 12, 60));  // took back a neighbour's wing
  model.cables.push_back(bird(-80, 5, -40));
  model.cables.back().coils.clear();
  const std::vector<char> stray = find_stray_light(model);
  for (std::size_t k = 0; k < stray.size(); ++k) EXPECT_EQ(stray[k] != 0, k == 11) << k;
}

TEST(StrayLight, NoneWhereElementsAreDarkAndBright) {
  TexturedMotion model;
  for (int k = 0; k < 4; ++k) model.cables.push_back(bird(k % 2 == 0 ? -80 : 80, 12, k % 2 == 0 ? 60 : -60));
  for (const char is_stray : find_stray_light(model)) EXPECT_EQ(is_stray, 0);
  EXPECT_TRUE(find_stray_light({}).empty());
}

TEST(ElementLight, LimitsTheSignThatIsRare) {
  TexturedMotion model;
  model.width = 80, model.height = 60, model.num_frames = 20, model.num_planes = 1;
  model.cables.assign(6, bird(-80, 5, -40));
  model.cables.push_back(bird(-60, 14, 20));
  ElementLight light = element_light(model);
  EXPECT_TRUE(std::isinf(light.darkest));
  EXPECT_GT(light.brightest, 0);
  EXPECT_LE(light.brightest, 20);
  model.cables.assign(1, bird(-60, 14, 60));
  light = element_light(model);
  EXPECT_TRUE(std::isinf(light.darkest) && std::isinf(light.brightest));
  model.cables.clear();
  light = element_light(model);
  EXPECT_TRUE(std::isinf(light.darkest) && std::isinf(light.brightest));
}

}  // namespace
}  // namespace motex
