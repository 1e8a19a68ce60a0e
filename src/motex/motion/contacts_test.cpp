// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/contacts.h"

#include <gtest/gtest.h>

#include <string>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

Skeleton chain_skeleton(int num_joints) {
  Skeleton s;
  for (int j = 0; j < num_joints; ++j) s.joints.push_back({"j" + std::to_string(j), j - 1, Vector3(0, 1, 0), {}});
  return s;
}

TEST(LearnFootModel, RefusesNamesThatAreNoFeet) {
  const Clip clip = walk_stick_figure().clip;
  const std::vector<std::string> unknown = {"LeftFoot", "Paw"}, body = {"Spine"};
  EXPECT_THROW(learn_foot_model({&clip, 1}, unknown), InvalidInput);
  EXPECT_THROW(learn_foot_model({&clip, 1}, body), InvalidInput);
  EXPECT_THROW(learn_foot_model({}), InvalidInput);
}

TEST(LearnFootModel, BodyWithoutLegsGetsAWarningAndNoLegs) {
  const Clip clip = make_clip(chain_skeleton(20), 10, 0.02);
  int warnings = 0;
  JobContext job;
  job.on_warning = [&](const std::string&) { ++warnings; };
  const FootModel model = learn_foot_model({&clip, 1}, {}, job);
  EXPECT_TRUE(model.legs.empty());
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(detect_contacts(clip, model).cols(), 0);
}

TEST(LearnFootModel, FindsTheLegsByThemselvesAndByAnyNameOfTheFoot) {
  const Clip clip = walk_stick_figure().clip;
  const std::vector<std::string> feet = {"LeftFoot", "RightFoot"}, toes = {"RightToeBase", "LeftToeBase"};
  for (const FootModel& model :
       {learn_foot_model({&clip, 1}), learn_foot_model({&clip, 1}, feet), learn_foot_model({&clip, 1}, toes)}) {
    ASSERT_EQ(model.legs.size(), 2u);
    EXPECT_NE(model.legs[0].ankle_idx, model.legs[1].ankle_idx);
    for (const Leg& leg : model.legs) {
      const auto name = [&](int j) { return clip.skeleton.joints[static_cast<std::size_t>(j)].name; };
      const std::string side = name(leg.ankle_idx).substr(0, name(leg.ankle_idx).size() - 4);
      EXPECT_EQ(name(leg.hip_idx), side + "UpLeg");
      EXPECT_EQ(name(leg.knee_idx), side + "Leg");
      EXPECT_EQ(name(leg.ankle_idx), side + "Foot");
      EXPECT_NEAR(leg.ankle_floor, 8, 1e-6);
      EXPECT_NEAR(leg.toe_floor, 2, 0.2);
      EXPECT_GT(std::abs(leg.knee_axis.x()), 0.999);
    }
    EXPECT_EQ(model.pelvis_idx, 0);
  }
}

TEST(DetectContacts, FindsTheStancesOfTheWalk) {
  StickFigureOptions options;
  options.turn_rate = 0.3;
  options.noise = 0.1;
  const StickFigure figure = walk_stick_figure(options);
  const std::vector<std::string> names = {"LeftFoot", "RightFoot"};
  const ContactMatrix contacts = detect_contacts(figure.clip, learn_foot_model({&figure.clip, 1}, names));
  for (int foot = 0; foot < 2; ++foot) {
    Index wrong = 0;
    for (Index t = 0; t < options.num_frames; ++t) {
      const bool truth = figure.is_planted(t, foot);
      for (int point = 0; point < 2; ++point) wrong += (contacts(t, 2 * foot + point) != 0) != truth;
    }
    // Two frames at each end of each of the ten stances: the foot starts and lands slowly.
    EXPECT_LE(wrong, 2 * 10 * 4) << foot;
  }
}

TEST(ContactDetector, HoldsThroughTheMarginAndDropsShortTouches) {
  ContactDetector detector(5, 6, 10, 15, 3);
  EXPECT_EQ(detector.push(4, 5), 0);
  EXPECT_EQ(detector.push(4, 5), 0);
  EXPECT_EQ(detector.push(4, 20), 0);   // a short touch
  EXPECT_EQ(detector.push(5.5, 5), 0);  // too high to begin
  EXPECT_EQ(detector.push(4, 12), 0);   // too fast to begin
  EXPECT_EQ(detector.push(4, 5), 0);
  EXPECT_EQ(detector.push(5.5, 12), 0);  // but not too high and fast to go on
  EXPECT_EQ(detector.push(5.5, 12), 3);
  EXPECT_EQ(detector.push(5.5, 12), 1);
  EXPECT_EQ(detector.push(7, 5), 0);
}

}  // namespace
}  // namespace motex
