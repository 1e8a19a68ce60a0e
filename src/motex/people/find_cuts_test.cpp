// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/find_cuts.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/people/cut_smoothness.h"
#include "motex/people/test_actor.h"

namespace motex {
namespace {

struct Searched {
  test_actor::Footage footage;
  ComparableFrames frames;
  FindCutsReport report;

  explicit Searched(const std::vector<std::string>& takes, const FindCutsOptions& options = {})
      : footage(test_actor::make_footage(takes)) {
    search(options);
  }
  void search(const FindCutsOptions& options, int jobs = 0) {
    MemorySprites source(footage.sprites);
    frames = comparable_frames(footage.texture, source);
    JobContext job;
    job.jobs = jobs;
    report = find_cuts(footage.texture, frames, options, job);
  }
};

TEST(FindCuts, KeepsItsLimitsAndNeverTouchesTheEndsOfTakes) {
  const Searched searched({"ABC", "CBA", "BB"});
  const PeopleTexture& texture = searched.footage.texture;
  const std::vector<int> take_of = take_of_frames(texture);
  const SecondDifferenceScales scales = second_difference_scales(texture);
  ASSERT_GT(searched.report.cuts.cuts.size(), 50U);
  for (const Cut& cut : searched.report.cuts.cuts) {
    const Take& from = texture.takes[static_cast<std::size_t>(take_of[static_cast<std::size_t>(cut.from)])];
    const Take& to = texture.takes[static_cast<std::size_t>(take_of[static_cast<std::size_t>(cut.to)])];
    EXPECT_GT(cut.from, from.frames.start);
    EXPECT_LT(cut.from, from.frames.end() - 1);
    EXPECT_GT(cut.to, to.frames.start);
    EXPECT_LT(cut.to, to.frames.end() - 1);
    if (from.source == to.source) {
      EXPECT_GE(std::abs(cut.to - cut.from - 1), 12);
    }
    EXPECT_LE(cut.smoothness, 1.5);
    EXPECT_LE(cut.difference, searched.report.max_difference);
    EXPECT_DOUBLE_EQ(cut.difference, cut_difference(searched.frames.pictures, cut.from, cut.to));
    EXPECT_DOUBLE_EQ(cut.smoothness, cut_smoothness(texture, scales, cut.from, cut.to).largest());
  }
}

TEST(FindCuts, MovementGoesOnInTheSameDirection) {
  const Searched searched({"AA", "AA"});
  // Phase of an arm that rises until frame 15 of its action and sinks after it; −1 at rest and near the turning points.
  const auto rises = [&](int frame) {
    for (const Occurrence& raise : searched.footage.texture.alphabet.motifs[0].occurrences) {
      const int phase = frame - raise.start;
      if (phase >= 5 && phase <= 11) return 1;
      if (phase >= 18 && phase <= 25) return 0;
    }
    return -1;
  };
  int num_moving = 0;
  for (const Cut& cut : searched.report.cuts.cuts) {
    const int before = rises(cut.from), after = rises(cut.to);
    if (before < 0 || after < 0) continue;
    ++num_moving;
    EXPECT_EQ(before, after) << cut.from << " to " << cut.to;
  }
  EXPECT_GT(num_moving, 4) << "performances of one action are forked between while they move";
}

TEST(FindCuts, AnotherPersonIsAnotherActor) {
  Searched searched({"A-A", "A-A"});
  const auto crossings = [&] {
    const int second = searched.footage.texture.takes[1].frames.start;
    return std::count_if(searched.report.cuts.cuts.begin(), searched.report.cuts.cuts.end(),
                         [&](const Cut& cut) { return (cut.from < second) != (cut.to < second); });
  };
  EXPECT_GT(crossings(), 0);
  searched.footage.texture.takes[1].person = 1;
  searched.search({});
  EXPECT_EQ(crossings(), 0);
  EXPECT_FALSE(searched.report.cuts.cuts.empty());
}

TEST(FindCuts, FramesWithoutAnyoneAreLeftAlone) {
  Searched searched({"AB-AB"});
  for (int frame = 100; frame < 105; ++frame) {
    searched.footage.sprites[static_cast<std::size_t>(frame)] = {};
    searched.footage.texture.silhouettes[static_cast<std::size_t>(frame)] = {};
  }
  searched.search({});
  ASSERT_FALSE(searched.report.cuts.cuts.empty());
  for (const Cut& cut : searched.report.cuts.cuts)
    for (const int frame : {cut.from, cut.to}) EXPECT_TRUE(frame < 98 || frame > 105) << frame;
}

TEST(FindCuts, SameForAnyNumberOfThreadsAndRefusesWhatDoesNotFit) {
  Searched searched({"ABCABC"});
  const FindCutsReport one = searched.report;
  searched.search({}, 2);
  ASSERT_EQ(one.cuts.cuts.size(), searched.report.cuts.cuts.size());
  for (std::size_t i = 0; i < one.cuts.cuts.size(); ++i) {
    EXPECT_EQ(one.cuts.cuts[i].from, searched.report.cuts.cuts[i].from);
    EXPECT_EQ(one.cuts.cuts[i].to, searched.report.cuts.cuts[i].to);
  }
  PeopleTexture broken = searched.footage.texture;
  broken.takes[0].frames.length -= 1;
  EXPECT_THROW(find_cuts(broken, searched.frames), InvalidInput);
  EXPECT_THROW(find_cuts(searched.footage.texture, ComparableFrames{}), InvalidInput);
}

TEST(CutSmoothness, RealFootageGoingOnIsSmooth) {
  const Searched searched({"ABC"});
  const PeopleTexture& texture = searched.footage.texture;
  const SecondDifferenceScales scales = second_difference_scales(texture);
  int rough = 0, num = 0;
  for (int t = 1; t + 2 < texture.num_frames(); ++t) {
    rough += cut_smoothness(texture, scales, t, t + 1).largest() > 1 ? 1 : 0;
    ++num;
  }
  EXPECT_LT(rough, 0.5 * num) << "three signals at two frames, a twentieth of each";
  EXPECT_TRUE(std::isinf(cut_smoothness(texture, scales, 0, 40).largest()));
  EXPECT_TRUE(std::isinf(cut_smoothness(texture, scales, 40, texture.num_frames() - 1).largest()));
}

TEST(CutSmoothness, ATransitionCountsAJoltOfTheFootageInIt) {
  PeopleTexture texture;
  texture.takes = {{"x", 0, 0, false, {0, 60}}};
  for (int t = 0; t < 60; ++t) {
    Silhouette s;
    s.box = {0, 0, 49, 99};
    s.area = 1000 + 10 * t, s.centroid_x = t;
    texture.silhouettes.push_back(s);
  }
  const SecondDifferenceScales scales{10, 1, 0.1};
  EXPECT_NEAR(transition_smoothness(texture, scales, 20, 21, 5).largest(), 0, 1e-9);
  EXPECT_NEAR(transition_smoothness(texture, scales, 20, 50, 0).area, cut_smoothness(texture, scales, 20, 50).area,
              1e-9);
  EXPECT_LT(transition_smoothness(texture, scales, 20, 50, 5).area, cut_smoothness(texture, scales, 20, 50).area);
  texture.silhouettes[17].area += 40;
  EXPECT_NEAR(transition_smoothness(texture, scales, 20, 21, 5).area, 80 / 10.0, 1e-6) << "footage of the first take";
  EXPECT_NEAR(transition_smoothness(texture, scales, 30, 31, 5).area, 0, 1e-9);
  EXPECT_LT(transition_smoothness(texture, scales, 58, 30, 5).largest(), 30) << "shorter at the end of a take";
}

}  // namespace
}  // namespace motex
