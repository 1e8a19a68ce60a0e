// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/moveton_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motex/particles/planted_movetons.h"
#include "motex/particles/templates.h"

namespace motex {
namespace {

TexturedMotion planted_model(PlantedMovetons& scene) {
  TexturedMotion model;
  model.width = scene.clip.width;
  model.height = scene.clip.height;
  model.background = scene.background;
  model.templates = learn_templates(scene.cables, 1);
  model.cables = scene.cables;
  return model;
}

int num_dark(const Image& image) {
  return static_cast<int>(std::count_if(image.pixels.begin(), image.pixels.end(), [](Rgba c) { return c.g < 120; }));
}

TEST(MovetonPictures, TemplatesHaveAPanelAState) {
  PlantedMovetons scene = plant_movetons(12, 12, 40, 0, 3);
  const TexturedMotion model = planted_model(scene);
  ASSERT_EQ(model.templates.size(), 1U);
  ASSERT_EQ(model.templates[0].poses.size(), 3U);
  MovetonTemplate one = model.templates[0];
  one.poses.resize(1);
  EXPECT_NEAR(template_sketch(model.templates[0], 1).width, 3 * template_sketch(one, 1).width, 1e-9);
  const auto num_dashed = [](const Drawing& drawing) {
    return std::count_if(drawing.shapes.begin(), drawing.shapes.end(), [](const Shape& shape) {
      return std::holds_alternative<Polyline>(shape) && std::get<Polyline>(shape).dash > 0;
    });
  };
  EXPECT_EQ(num_dashed(template_sketch(one, 1)), 0);
  one.poses[0].coils[0].presence = 0.5;
  EXPECT_EQ(num_dashed(template_sketch(one, 1)), 1) << "a link is dashed where the coil is not always there";
}

TEST(MovetonPictures, SamplesAndInstancesShowLight) {
  PlantedMovetons scene = plant_movetons(12, 12, 40, 0, 3);
  const TexturedMotion model = planted_model(scene);
  const Image sampled = render(sampled_movetons_picture(model, 10, 5, 1));
  EXPECT_GT(num_dark(sampled), 10 * 20);
  EXPECT_EQ(num_dark(sampled), num_dark(render(sampled_movetons_picture(model, 10, 5, 1))))
      << "same seed, same picture";
  const Drawing instances = moveton_instances_picture(model, scene.clip, 8, 4);
  EXPECT_EQ(instances.shapes.size(), 8U);
  EXPECT_GT(num_dark(render(instances)), 8 * 20);
  const Drawing whole = movetons_figure(model, &scene.clip, 20, 1), without = movetons_figure(model, nullptr, 20, 1);
  EXPECT_GT(whole.height, without.height);
}

TEST(MovetonPictures, AModelWithoutTemplatesIsNoError) {
  TexturedMotion model;
  model.background = {Plane(20, 20, 100)};
  model.width = model.height = 20;
  EXPECT_NO_THROW(render(movetons_figure(model, nullptr, 20, 1)));
}

}  // namespace
}  // namespace motex
