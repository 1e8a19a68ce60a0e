// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/footage_motifs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/people/measure_silhouette.h"

namespace motex {
namespace {

constexpr int kKick = 40;

/// Stands with a little sway and noise; kicks to the right (+1) or left (−1) where `kicks` says so.
PeopleTexture kicking(const std::vector<std::pair<int, int>>& kicks, int num_frames) {
  PeopleTexture texture;
  texture.width = 320, texture.height = 240, texture.frames_per_sec = 25;
  texture.takes = {{"a.mp4", 0, 0, false, {0, num_frames}}};
  Rng rng(11);
  for (int t = 0; t < num_frames; ++t) {
    double leg = 0;
    int side = 1;
    for (const auto& [start, where] : kicks)
      if (t >= start && t < start + kKick) {
        const double phase = (t - start + 0.5) / kKick;
        leg = std::sin(std::numbers::pi * phase) * std::sin(std::numbers::pi * phase) * (phase < 0.5 ? 1 : 0.8);
        side = where;
      }
    Silhouette one;  // of a kick to the right
    const auto noise = [&] { return 0.01 * rng.normal(); };
    one.box = {130, 40, 170 + static_cast<int>(40 * leg), 200};
    one.area = 4000 * (1 + 0.06 * leg + 0.1 * noise());
    one.centroid_x = 150 + 6 * leg + 10 * noise(), one.centroid_y = 120 - 8 * leg + 10 * noise();
    one.mu11 = -0.03 * leg + 0.1 * noise(), one.mu30 = 0.05 * leg * leg + 0.1 * noise();
    one.mu21 = 0.02 * leg + 0.1 * noise(), one.mu03 = 0.02 * leg + 0.1 * noise();
    texture.silhouettes.push_back(side > 0 ? one : mirrored(one, texture.width));
  }
  return texture;
}

TEST(FindFootageMotifs, TellsLeftKicksFromRightOnes) {
  std::vector<std::pair<int, int>> kicks;
  for (int k = 0; k < 10; ++k) kicks.emplace_back(30 + 90 * k + 7 * (k % 3), k % 2 == 0 ? 1 : -1);
  const PeopleTexture texture = kicking(kicks, 960);
  FindMotifsOptions options;
  options.window = kKick;
  const MotifReport found = find_footage_motifs(texture, options);
  ASSERT_GE(found.set.motifs.size(), 2U);
  std::size_t held = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    std::set<int> sides;
    for (const Occurrence& one : found.set.motifs[k].occurrences)
      for (const auto& [start, side] : kicks)
        if (std::abs(one.start + one.length / 2 - start - kKick / 2) < kKick / 2) {
          sides.insert(side);
          ++held;
        }
    EXPECT_EQ(sides.size(), 1U) << "motif " << k << " holds kicks to one side alone";
  }
  EXPECT_GE(held, 9U);
}

TEST(FindFootageMotifs, NeverMatchesAcrossACut) {
  std::vector<std::pair<int, int>> kicks;
  for (int k = 0; k < 8; ++k) kicks.emplace_back(30 + 90 * k, 1);
  PeopleTexture texture = kicking(kicks, 760);
  constexpr int kCut = 30 + 90 * 3 + kKick / 2;  // through the fourth
  texture.takes = {{"a.mp4", 0, 0, false, {0, kCut}}, {"a.mp4", 900, 0, false, {kCut, 760 - kCut}}};
  FindMotifsOptions options;
  options.window = kKick;
  const MotifReport found = find_footage_motifs(texture, options);
  ASSERT_FALSE(found.set.motifs.empty());
  for (const Motif& motif : found.set.motifs)
    for (const Occurrence& one : motif.occurrences)
      EXPECT_TRUE(one.start >= kCut || one.start + one.length <= kCut) << one.start << " + " << one.length;
}

TEST(FindFootageMotifs, SomebodyWhoNeverMovesIsIdleAndNobodyIsRefused) {
  PeopleTexture texture = kicking({}, 100);
  for (Silhouette& one : texture.silhouettes) one = texture.silhouettes[0];
  const MotifReport found = find_footage_motifs(texture);
  EXPECT_TRUE(found.set.motifs.empty());
  ASSERT_EQ(found.set.idle.size(), 1U);
  EXPECT_EQ(found.set.idle[0], (FrameSpan{0, 100}));
  for (Silhouette& one : texture.silhouettes) one = {};
  EXPECT_THROW(find_footage_motifs(texture), InvalidInput);
}

}  // namespace
}  // namespace motex
