// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/carried_placement.h"

#include <gtest/gtest.h>

#include "motex/people/drawn_actor.h"

namespace motex {
namespace {

Sprite standing(int t) { return drawn_actor({.right_arm = 0.9 + 0.4 * std::sin(0.5 * t)}); }
/// Both feet are on the way.
Sprite walking(int t) { return drawn_actor({.x = 60.0 + 3 * t}); }

TEST(CarriedPlacement, SeesFeetThatStandAndFeetThatMove) {
  EXPECT_TRUE(stands_still(standing(3), standing(4)));
  EXPECT_TRUE(stands_still(drawn_actor({.lift = 2}), drawn_actor({.lift = 9})));  // the other foot stands
  EXPECT_FALSE(stands_still(walking(3), walking(4)));
  EXPECT_FALSE(stands_still(standing(3), Sprite{}));
}

TEST(CarriedPlacement, FindsTheFeet) {
  const auto feet = footing_of(drawn_actor({}));
  ASSERT_TRUE(feet.has_value());
  EXPECT_NEAR(feet->x, 100, 1);
  EXPECT_NEAR(feet->y, 192, 1);
  EXPECT_FALSE(footing_of(Sprite{}).has_value());
}

TEST(CarriedPlacement, CreepsWhileAFootStands) {
  CarriedPlacement carried(400, 200);
  carried.set(standing(0), {1, 12, -2});
  double before = 12;
  for (int t = 1; t < 60; ++t) {
    const Sprite last = standing(t - 1);
    const Placement now = carried.next(&last, standing(t));
    EXPECT_LE(now.x, before);
    EXPECT_LE(before - now.x, 0.0003 * 160);
    before = now.x;
  }
  EXPECT_LT(before, 12);
}

TEST(CarriedPlacement, ReturnsWhileTheFeetMoveAndStaysThere) {
  CarriedPlacement carried(400, 200);
  carried.set(walking(0), {1, 12, -2});
  double fastest = 0, before = 12;
  for (int t = 1; t < 45; ++t) {
    const Sprite last = walking(t - 1);
    const Placement now = carried.next(&last, walking(t));
    fastest = std::max(fastest, before - now.x);
    before = now.x;
  }
  EXPECT_EQ(before, 0);
  EXPECT_EQ(carried.offset_y(), 0);
  EXPECT_GT(fastest, 0.3);
  EXPECT_LE(fastest, 0.0041 * 160);
}

TEST(CarriedPlacement, ReturnsSoonerFromOutsideTheFrame) {
  CarriedPlacement inside(400, 200), outside(150, 200);
  inside.set(standing(0), {1, 30, 0}), outside.set(standing(0), {1, 30, 0});
  for (int t = 1; t < 30; ++t) {
    const Sprite last = standing(t - 1);
    inside.next(&last, standing(t)), outside.next(&last, standing(t));
  }
  EXPECT_LT(outside.offset_x(), 0.75 * inside.offset_x());
}

TEST(CarriedPlacement, ArrivesWhereALoopClosesEvenStanding) {
  CarriedPlacement carried(400, 200);
  carried.set(standing(0), {1, 12, 0});
  for (int t = 1; t <= 20; ++t) {
    const Sprite last = standing(t - 1);
    carried.aim(-5, 1, 1.05, 21 - t);
    carried.next(&last, standing(t));
  }
  EXPECT_NEAR(carried.offset_x(), -5, 1e-9);
  EXPECT_NEAR(carried.offset_y(), 1, 1e-9);
  EXPECT_NEAR(carried.scale(), 1.05, 1e-9);
}

TEST(CarriedPlacement, ScalesAboutTheFeet) {
  CarriedPlacement carried(400, 200);
  const Sprite actor = standing(0);
  carried.set(actor, {1.1, -5, -12});
  const Placement placement = carried.placement_of(actor);
  EXPECT_NEAR(placement.x, -5, 1e-9);
  EXPECT_NEAR(placement.y, -12, 1e-9);
  EXPECT_NEAR(carried.offset_x(), 0.1 * footing_of(actor)->x - 5, 1e-9);
}

}  // namespace
}  // namespace motex
