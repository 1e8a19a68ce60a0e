// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/learn.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_score.h"

namespace motex {
namespace {

LearnedTexturedMotion learned(const SimulatedScene& scene, int rounds) {
  LearnTexturedMotionOptions options;
  options.rounds = rounds;
  options.tracking = TrackingKind::kCores;
  return learn_textured_motion(clip_frames_of(scene), options);
}

TEST(LearnTexturedMotion, RefusesWhatIsTooShort) {
  SimulateSnowOptions snow;
  snow.width = snow.height = 32;
  snow.frames = 2;
  EXPECT_THROW(learned(simulate_snow(snow), 0), InvalidInput);
}

/// Wings are not explained by cores: samples of cores would be drawn towards them.
TEST(LearnTexturedMotion, ElementsWithPartsKeepTheirLinkedPaths) {
  SimulateBirdsOptions birds;
  birds.width = 160;
  birds.height = 120;
  birds.frames = 30;
  birds.elements = 4;
  birds.group_size = 1;
  const SimulatedScene scene = simulate_birds(birds);
  const LearnedTexturedMotion linked = learned(scene, 0), asked = learned(scene, 2);
  EXPECT_EQ(asked.report.rounds.size(), 1u);
  EXPECT_TRUE(asked.report.moves.empty());
  const int planes = linked.model.num_planes;
  const TrackingScore same =
      score_tracks(tracks_of(linked.model.cables, planes), tracks_of(asked.model.cables, planes), 1);
  EXPECT_EQ(same.beta, 1);
}

TEST(LearnTexturedMotion, RoundElementsAreSampled) {
  SimulateSnowOptions snow;
  snow.width = 96;
  snow.height = 72;
  snow.frames = 14;
  snow.elements = 15;
  const LearnedTexturedMotion found = learned(simulate_snow(snow), 1);
  ASSERT_EQ(found.report.rounds.size(), 2u);
  EXPECT_FALSE(found.report.moves.empty());
}

}  // namespace
}  // namespace motex
