// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/jumps.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

/// Two runs on a line; the instances of run 0 are textons 0, 1, 0, that of run 1 is texton 2.
MotionTexture two_runs() {
  MotionTexture model;
  model.corpus.resize(40, 1);
  for (Index t = 0; t < 30; ++t) model.corpus(t, 0) = static_cast<float>(t);
  for (Index t = 30; t < 40; ++t) model.corpus(t, 0) = static_cast<float>(t - 18);  // 12 … 21
  model.runs = {{0, 0, 0, 30}, {1, 0, 30, 10}};
  model.instances = {{0, 0, 0, 10, {}}, {1, 0, 10, 10, {}}, {0, 0, 20, 10, {}}, {2, 1, 30, 10, {}}};
  model.textons.resize(3);
  return model;
}

TEST(Jumps, InstancesHandOverAtTheirSuccessorsFirstPoses) {
  const MotionTexture model = two_runs();
  EXPECT_EQ(hand_over_row(model, model.instances[0]), 10);
  EXPECT_EQ(hand_over_row(model, model.instances[1]), 20);
  EXPECT_EQ(hand_over_row(model, model.instances[2]), 28) << "the last two frames of the run";
  EXPECT_EQ(hand_over_row(model, model.instances[3]), 38);
}

TEST(Jumps, DistanceIsTheRootMeanSquareOfTwoFrames) {
  FrameMatrixF corpus(4, 2);
  corpus << 0, 0, 0, 0, 3, 4, 0, 0;
  EXPECT_DOUBLE_EQ(key_pose_distance(corpus, 0, 2), 5 / std::sqrt(2.0));
  EXPECT_EQ(key_pose_distance(corpus, 1, 1), 0);
}

TEST(Jumps, EveryInstanceJumpsToTheNearestPosesAndEveryRunIsLedInto) {
  const TransitionMatrix m = transitions_with_jumps(two_runs());
  // Observed 0→1, 1→0. Instance 0 ends at 10, 11; nearest but its successor: instance 3 at 12, 13. Instance 1 ends at
  // 20, 21: instance 3 again. Instance 2 ends at 28, 29: instance 1 at 10 and 3 at 12: texton 2. Instance 3 ends at
  // 20, 21 (38, 39): instance 2. Into instance 0 (0, 1): from instance 0 itself not; nearest end is 20 (instances 1 and
  // 3, the first counts). Into instance 3 (12, 13): from instance 0.
  EXPECT_DOUBLE_EQ(m.count(0, 1), 1);
  EXPECT_DOUBLE_EQ(m.count(1, 0), 1 + 0.3);
  EXPECT_DOUBLE_EQ(m.count(0, 2), 0.3 + 0.3 + 0.3);
  EXPECT_DOUBLE_EQ(m.count(1, 2), 0.3);
  EXPECT_DOUBLE_EQ(m.count(2, 0), 0.3);
  EXPECT_DOUBLE_EQ(m.count(0, 0) + m.count(1, 1) + m.count(2, 1) + m.count(2, 2), 0);
}

TEST(Jumps, OfOneInstanceThereAreNone) {
  MotionTexture model = two_runs();
  model.instances.resize(1);
  model.textons.resize(1);
  EXPECT_TRUE(transitions_with_jumps(model).counts().empty());
}

}  // namespace
}  // namespace motex
