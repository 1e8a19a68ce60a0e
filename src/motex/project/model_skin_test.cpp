// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/gltf_skin.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/synthetic.h"
#include "motex/project/motion_texture_file.h"

namespace motex {
namespace {

/// The tube of the fixture, its joints called as three of the walker's.
MotionTexture skinned_model() {
  MotionTexture model = sample_model();
  const auto tube = read_skin(MOTEX_TEST_DATA "/mocap/synthetic/skinned_tube.glb");
  Skin skin = *tube;
  const char* names[] = {"Hips", "Spine", "Head"};
  for (std::size_t j = 0; j < 3; ++j) {
    const std::string old = skin.joints[j].name;
    skin.glb.replace(skin.glb.find(old), old.size(),
                     std::string(names[j]) + std::string(old.size() - std::string(names[j]).size(), '_'));
  }
  // Names of another length would move the file's parts: the skeleton is called after the skin.
  const auto renamed = read_skin_bytes(skin.glb, "tube");
  for (std::size_t j = 0; j < 3; ++j) {
    const int joint = model.features.skeleton.find(names[j]);
    EXPECT_GE(joint, 0) << names[j];
    if (joint >= 0) model.features.skeleton.joints[static_cast<std::size_t>(joint)].name = renamed->joints[j].name;
  }
  model.features.skeleton.skin = renamed;
  return model;
}

TEST(ModelSkin, GoesThroughTheFileIntoEveryDance) {
  const MotionTexture model = skinned_model();
  ASSERT_TRUE(skin_fits(model.features.skeleton));
  const MotionTexture again = parse_motion_texture(motion_texture_bytes(model), "again.motex");
  ASSERT_TRUE(skin_fits(again.features.skeleton));
  EXPECT_EQ(again.features.skeleton.skin->glb, model.features.skeleton.skin->glb);
  SynthesizeReport report;
  const Clip dance = synthesize_motion(again, 30, {}, {}, report);
  const Clip read = read_gltf_bytes(write_glb_bytes(dance), "dance.glb");
  ASSERT_TRUE(read.skeleton.skin);
  EXPECT_EQ(read.skeleton.skin->joints.size(), 3U);
}

TEST(ModelSkin, ABrokenOneIsRefused) {
  MotionTexture model = skinned_model();
  auto broken = std::make_shared<Skin>(*model.features.skeleton.skin);
  broken->glb.resize(broken->glb.size() / 2);
  model.features.skeleton.skin = broken;
  EXPECT_THROW(parse_motion_texture(motion_texture_bytes(model), "broken.motex"), InvalidInput);
}

}  // namespace
}  // namespace motex
