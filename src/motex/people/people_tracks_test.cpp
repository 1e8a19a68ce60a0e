// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/people_tracks.h"

#include <gtest/gtest.h>

#include <vector>

namespace motex {
namespace {

Sprite stage() {
  Sprite sprite;
  sprite.left = 10, sprite.top = 5, sprite.width = 300, sprite.height = 130;
  sprite.pixels.resize(300U * 130U);
  return sprite;
}

void fill(Sprite& sprite, int left, int top, int width, int height, std::uint8_t alpha = 255) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) sprite.at(x, y) = {0, 0, 0, alpha};
}

/// 30 × 100 pixels with soft sides.
void stand(Sprite& sprite, int left) {
  if (sprite.at(left - 1, 20)[3] == 0) fill(sprite, left - 1, 20, 1, 100, 80);
  fill(sprite, left, 20, 30, 100);
}

TEST(PeopleTracker, OnePersonKeepsAHandAPropAndABrokenWaist) {
  PeopleTracker tracker;
  std::vector<TrackedPerson> people;
  for (int t = 0; t < 20; ++t) {
    Sprite frame = stage();
    stand(frame, 50 + t);
    if (t > 5) fill(frame, 49 + t, 70, 32, 3, 0);
    fill(frame, 100 + t, 40, 8, 8);
    tracker.add(frame, people);
    ASSERT_EQ(people.size(), 1U);
    EXPECT_EQ(people[0].track, 0);
    EXPECT_EQ(people[0].silhouette.box.right, 10 + 107 + t);
  }
  EXPECT_TRUE(tracker.events().empty());
}

TEST(PeopleTracker, TwoWhoPassTheirHandsStayApartAndSoftEdgesGoWithThem) {
  PeopleTracker tracker;
  std::vector<TrackedPerson> people;
  for (int t = 0; t < 20; ++t) {
    Sprite frame = stage();
    stand(frame, 40 + t);
    stand(frame, 200 - 2 * t);
    fill(frame, 240 - 2 * t, 40, 8, 8);
    tracker.add(frame, people);
    ASSERT_EQ(people.size(), 2U);
    EXPECT_EQ(people[0].track, 0);
    EXPECT_EQ(people[1].track, 1);
    EXPECT_EQ(people[0].silhouette.box.left, 10 + 40 + t);
    EXPECT_EQ(people[1].silhouette.box.right, 10 + 247 - 2 * t);
    EXPECT_EQ(people[0].sprite.width, 31) << "with its soft side, without the other";
    EXPECT_NEAR(people[0].silhouette.area, 3000 + 100 * 80 / 255.0, 1e-6);
  }
}

TEST(PeopleTracker, WhereTwoTouchBothTracksEndAndOthersBegin) {
  PeopleTracker tracker;
  std::vector<TrackedPerson> people;
  std::vector<std::size_t> counts;
  for (int t = 0; t < 60; ++t) {
    Sprite frame = stage();
    const int apart = t < 30 ? 100 - 4 * t : 4 * (t - 30) - 16;
    stand(frame, 60);
    stand(frame, 60 + std::max(15, apart));
    tracker.add(frame, people);
    counts.push_back(people.size());
  }
  EXPECT_EQ(counts.front(), 2U);
  EXPECT_EQ(counts[30], 0U) << "nobody is followed while they are one part";
  EXPECT_EQ(counts.back(), 2U);
  EXPECT_EQ(people[0].track, 2);
  EXPECT_EQ(people[1].track, 3);
  ASSERT_EQ(tracker.events().size(), 1U);
  EXPECT_EQ(tracker.events()[0].kind, TrackEvent::Kind::kTouched);
  EXPECT_EQ(tracker.events()[0].first + tracker.events()[0].second, 1);
}

TEST(PeopleTracker, OneWhoWasTwoIsSaid) {
  PeopleTracker tracker;
  std::vector<TrackedPerson> people;
  for (int t = 0; t < 30; ++t) {
    Sprite frame = stage();
    stand(frame, 100);
    stand(frame, 120 + 2 * t);
    tracker.add(frame, people);
  }
  ASSERT_EQ(people.size(), 2U);
  ASSERT_EQ(tracker.events().size(), 1U);
  EXPECT_EQ(tracker.events()[0].kind, TrackEvent::Kind::kParted);
  EXPECT_EQ(tracker.events()[0].first, 0);
}

TEST(PeopleTracker, SomeoneWhoComesInIsNewAndSomeoneWhoLeavesEnds) {
  PeopleTracker tracker;
  std::vector<TrackedPerson> people;
  for (int t = 0; t < 60; ++t) {
    Sprite frame = stage();
    if (t < 40) stand(frame, 40);
    if (t >= 20) stand(frame, 220);
    tracker.add(frame, people);
    EXPECT_EQ(people.size(), t >= 20 && t < 40 ? 2U : 1U);
    EXPECT_EQ(people.back().track, t < 20 ? 0 : 1);
  }
  tracker.add({}, people);
  EXPECT_TRUE(people.empty());
  EXPECT_TRUE(tracker.events().empty());
}

}  // namespace
}  // namespace motex
