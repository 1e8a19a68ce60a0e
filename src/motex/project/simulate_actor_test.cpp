// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/simulate_actor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "motex/core/error.h"
#include "motex/people/measure_silhouette.h"

namespace motex {
namespace {

SimulateActorOptions small(int frames) {
  SimulateActorOptions options;
  options.frames = frames;
  options.width = 240;
  options.height = 160;
  return options;
}

TEST(SimulateActor, UnknownActionIsNamed) {
  SimulateActorOptions options = small(100);
  options.actions = "bow,somersault";
  try {
    ActorSimulation simulation(options);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("somersault"), std::string::npos);
  }
}

TEST(SimulateActor, RepetitionsMustFit) {
  SimulateActorOptions options = small(200);
  options.repetitions = 3;
  EXPECT_THROW(ActorSimulation{options}, InvalidInput);
}

TEST(SimulateActor, EachActionIsPerformedAsOftenAsAskedAndNeverTwoAtOnce) {
  SimulateActorOptions options = small(1800);
  options.repetitions = 3;
  options.persons = 2;
  const ActorSimulation simulation(options);
  std::map<std::pair<int, int>, int> counts;
  std::map<int, int> ends;
  for (const ActorPerformance& one : simulation.performances()) {
    ++counts[{one.person, one.action}];
    EXPECT_GE(one.start, ends[one.person] + 5);
    ends[one.person] = one.start + one.length;
    EXPECT_LE(ends[one.person], 1800);
    EXPECT_GE(one.amplitude, 0.9);
    EXPECT_LE(one.amplitude, 1.1);
  }
  EXPECT_EQ(counts.size(), 12U);
  for (const auto& [key, count] : counts) EXPECT_EQ(count, 3);
}

TEST(SimulateActor, SameSeedSamePicturesInAnyOrder) {
  const ActorSimulation a(small(90)), b(small(90));
  const ActorSimulation::Frame late = a.frame(80), early = a.frame(3);
  EXPECT_EQ(b.frame(3).image.pixels, early.image.pixels);
  EXPECT_EQ(b.frame(80).image.pixels, late.image.pixels);
  EXPECT_EQ(b.frame(80).matte.pixels, late.matte.pixels);
}

TEST(SimulateActor, TheBodyMovesWithoutJumps) {
  const ActorSimulation simulation(small(600));
  // Also where actions begin and end: 5 metres a second is what a kicking foot reaches.
  PuppetPose before = simulation.pose(0, 0);
  double fastest = 0;
  for (int t = 1; t < 600; ++t) {
    const PuppetPose now = simulation.pose(t, 0);
    for (std::size_t k = 0; k < now.joints.size(); ++k)
      fastest =
          std::max(fastest, std::hypot(now.joints[k].x - before.joints[k].x, now.joints[k].y - before.joints[k].y) /
                                now.joints[k].pixels_per_metre * simulation.options().frames_per_sec);
    before = now;
  }
  EXPECT_GT(fastest, 1);
  EXPECT_LT(fastest, 7);
}

TEST(SimulateActor, LeftAndRightKicksAreOfThoseLegs) {
  SimulateActorOptions options = small(400);
  options.actions = "left_kick,right_kick";
  const ActorSimulation simulation(options);
  ASSERT_GE(simulation.performances().size(), 2U);
  for (const ActorPerformance& one : simulation.performances()) {
    const PuppetPose pose = simulation.pose(one.start + one.length / 2, 0);
    const double left = pose.at(PuppetJoint::kLeftAnkle).y, right = pose.at(PuppetJoint::kRightAnkle).y;
    EXPECT_EQ(left < right - 10, one.action == 3) << one.start;
  }
}

TEST(SimulateActor, MatteIsTheUnionOfThePersons) {
  SimulateActorOptions options = small(60);
  options.persons = 2;
  const ActorSimulation simulation(options);
  const ActorSimulation::Frame frame = simulation.frame(30);
  double total = 0, parts = 0;
  for (const Rgba& pixel : frame.matte.pixels) total += pixel.r;
  for (int person = 0; person < 2; ++person)
    for (const PremultipliedRgba& pixel : simulation.sprite(30, person).pixels) parts += pixel[3];
  EXPECT_GT(parts, 0);
  EXPECT_DOUBLE_EQ(total, parts);
}

TEST(SimulateActor, AMovingBodyIsBlurred) {
  SimulateActorOptions options = small(150);
  options.actions = "left_kick";
  options.motion_blur = 1;
  const ActorSimulation blurred(options);
  options.motion_blur = 0;
  const ActorSimulation sharp(options);
  const ActorPerformance& kick = sharp.performances().at(0);
  const auto partly = [&](const ActorSimulation& simulation) {
    int count = 0;
    for (const PremultipliedRgba& pixel : simulation.sprite(kick.start + kick.length / 4, 0).pixels)
      count += pixel[3] > 0 && pixel[3] < 255;
    return count;
  };
  EXPECT_GT(partly(blurred), 1.3 * partly(sharp));
}

}  // namespace
}  // namespace motex
