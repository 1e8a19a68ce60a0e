// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/water_model_file.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/project/textured_motion_file.h"

namespace motex {
namespace {

TexturedMotion small_water() {
  TexturedMotion model;
  model.width = 20;
  model.height = 12;
  model.num_frames = 14;
  model.background = {Plane(20, 12, 90)};
  Cable cable;
  cable.first_frame = 3;
  cable.core.push_back({BaseKind::kGaborSin, 4, 5, 1.5, 0.25, {30, 0, 0}});
  model.cables.push_back(cable);
  WaterModel water;
  water.flow = {8, Plane(3, 2, 0.5F), Plane(3, 2, 4), Plane(3, 2, 0.75F)};
  water.light = {{{0, -1, -1, 0.5}, {-1, 0, 0, 0.25}}, Plane(20, 12, 0.125F), Plane(20, 12, 2), 0.75, water.flow};
  model.water = water;
  return model;
}

TEST(WaterModelFile, WrittenAndReadIsTheSame) {
  const TexturedMotion model = small_water();
  const std::string bytes = textured_motion_bytes(model);
  const TexturedMotion read = parse_textured_motion(bytes, "fall.motex");
  ASSERT_TRUE(read.water.has_value());
  EXPECT_EQ(textured_motion_bytes(read), bytes);
  EXPECT_EQ(read.water->flow.vy.values, model.water->flow.vy.values);
  EXPECT_EQ(read.water->light.deviation.values, model.water->light.deviation.values);
  ASSERT_EQ(read.water->light.neighbours.size(), 2U);
  EXPECT_EQ(read.water->light.neighbours[1].dx, -1);
  EXPECT_EQ(read.water->light.noise, 0.75);
  EXPECT_EQ(read.water->light.flow.vy.values, model.water->flow.vy.values);
}

TEST(WaterModelFile, ModelsWithoutWaterHaveNone) {
  TexturedMotion model = small_water();
  model.water.reset();
  EXPECT_FALSE(parse_textured_motion(textured_motion_bytes(model), "snow.motex").water.has_value());
}

TEST(WaterModelFile, WhatIsOutOfRangeIsRefused) {
  TexturedMotion model = small_water();
  model.water->light.neighbours[1] = {1, 0, 0, 0.25};  // not drawn yet when it is needed
  EXPECT_THROW(parse_textured_motion(textured_motion_bytes(model), "fall.motex"), InvalidInput);
  model = small_water();
  model.water->light.neighbours[0].dt = -100;
  EXPECT_THROW(parse_textured_motion(textured_motion_bytes(model), "fall.motex"), InvalidInput);
  model = small_water();
  model.water->flow.vx = Plane(4, 4);
  EXPECT_THROW(parse_textured_motion(textured_motion_bytes(model), "fall.motex"), InvalidInput);
  model = small_water();
  model.water->light.deviation.at(3, 3) = -1;
  EXPECT_THROW(parse_textured_motion(textured_motion_bytes(model), "fall.motex"), InvalidInput);
}

}  // namespace
}  // namespace motex
