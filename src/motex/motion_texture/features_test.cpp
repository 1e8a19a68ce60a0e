// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

/// A root that wanders and turns all the way round, two limbs that swing.
Clip wandering_clip(std::uint64_t seed, Index frames, bool still_root_above = false) {
  Skeleton skeleton;
  const int base = still_root_above ? 0 : -1;
  if (still_root_above) skeleton.joints.push_back({"World", -1, Vector3(1, 2, 3), {}});
  skeleton.joints.push_back({"Hips", base, Vector3::Zero(), {}});
  skeleton.joints.push_back({"Spine", base + 1, Vector3(0, 20, 0), {}});
  skeleton.joints.push_back({"Leg", base + 1, Vector3(0, -40, 0), {}});
  skeleton.end_sites.push_back({base + 2, Vector3(0, 40, 0)});
  skeleton.end_sites.push_back({base + 3, Vector3(0, -40, 0)});
  Clip clip = make_clip(skeleton, frames, 1.0 / 60);
  clip.name = "wandering";
  Rng rng(seed);
  const double phase = rng.uniform(0, 6);
  if (still_root_above)
    for (Index t = 0; t < frames; ++t) clip.set_rotation(t, 0, exp_map(Vector3(0.3, -0.2, 0.1)));
  for (Index t = 0; t < frames; ++t) {
    const double s = static_cast<double>(t) / 60;
    const Quat turn = exp_map(Vector3(0, 2.5 * s + phase, 0));
    clip.set_translation(t, base + 1, Vector3(100 * std::sin(s), 90 + 5 * std::sin(9 * s), 80 * s));
    clip.set_rotation(t, base + 1, turn * exp_map(Vector3(0.2 * std::sin(3 * s), 0, 0.3 * std::cos(4 * s))));
    clip.set_rotation(t, base + 2, exp_map(Vector3(0.9 * std::sin(2 * s), 0.4, 0.3 * std::cos(5 * s))));
    clip.set_rotation(t, base + 3, exp_map(Vector3(1.5 * std::sin(6 * s), 0.1 * s, 0)));
  }
  return clip;
}

double largest_difference(const Clip& a, const Clip& b) {
  return (world_positions(a) - world_positions(b)).cwiseAbs().maxCoeff();
}

TEST(Features, ClipToFeaturesToClipIsExact) {
  for (const bool above : {false, true}) {
    const Clip clip = wandering_clip(1, 400, above);
    const FeatureSpace space = make_feature_space({&clip, 1});
    EXPECT_EQ(space.travelling_joint, above ? 1 : 0);
    const FrameMatrix y = encode(space, clip);
    EXPECT_EQ(y.cols(), 6 + 3 * 2);
    const Clip back = decode(space, y, root_place(space, clip, 0));
    EXPECT_LT(largest_difference(clip, back), 1e-9);
  }
}

TEST(Features, DoNotDependOnPlaceAndHeading) {
  const Clip clip = wandering_clip(2, 200);
  Clip moved = clip;
  const Quat turn = exp_map(Vector3(0, 1.9, 0));
  for (Index t = 0; t < clip.num_frames(); ++t) {
    moved.set_translation(t, 0, turn * clip.translation(t, 0) + Vector3(500, 0, -70));
    moved.set_rotation(t, 0, turn * clip.rotation(t, 0));
  }
  const FeatureSpace space = make_feature_space({&clip, 1});
  EXPECT_LT((encode(space, clip) - encode(space, moved)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Features, SignsOfQuaternionsDoNotMatter) {
  const Clip clip = wandering_clip(3, 200);
  Clip flipped = clip;
  for (Index t = 50; t < 120; ++t) flipped.rotations.row(t) *= -1;
  const FeatureSpace space = make_feature_space({&clip, 1});
  EXPECT_LT((encode(space, clip) - encode(space, flipped)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Features, WeightsAreLevers) {
  const Clip clip = wandering_clip(4, 100);
  const FeatureSpace space = make_feature_space({&clip, 1});
  EXPECT_DOUBLE_EQ(space.weights[2], space.cm_per_unit);
  EXPECT_NEAR(space.weights[0], 4 * space.cm_per_unit, 1e-9);
  EXPECT_NEAR(space.weights[6], space.cm_per_unit * 40 * std::sqrt(2.0 / 3), 1e-9);
}

TEST(Features, OtherSkeletonsRatesAndShortClipsAreRefused) {
  const Clip clip = wandering_clip(5, 100);
  const FeatureSpace space = make_feature_space({&clip, 1});
  Clip other = clip;
  other.skeleton.joints[1].name = "Torso";
  EXPECT_THROW(encode(space, other), InvalidInput);
  other = clip;
  other.frame_time_secs = 1.0 / 30;
  EXPECT_THROW(encode(space, other), InvalidInput);
  EXPECT_THROW(encode(space, slice(clip, 0, 1)), InvalidInput);
  const Clip one = slice(clip, 0, 1);
  EXPECT_THROW(make_feature_space({&one, 1}), InvalidInput);
  EXPECT_THROW(make_feature_space({}), InvalidInput);
}

}  // namespace
}  // namespace motex
