// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/film_frames.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Two takes, 0 … 49 and 50 … 99.
PeopleTexture two_takes() {
  PeopleTexture texture;
  texture.width = 64, texture.height = 48, texture.frames_per_sec = 30;
  texture.takes = {{"a", 0, 0, false, {0, 50}}, {"b", 0, 0, false, {50, 50}}};
  texture.silhouettes.resize(100);
  return texture;
}

EditList two_shots(int transition_frames) {
  EditList edits;
  edits.shots = {{10, 29, -1}, {60, 79, -1}};
  edits.cuts = {{29, 60, transition_frames, 0}};
  return edits;
}

TEST(FilmFrames, RefusesWhatDoesNotFit) {
  const PeopleTexture texture = two_takes();
  EditList edits = two_shots(4);
  edits.cuts[0].to = 61;
  EXPECT_THROW(film_frames(texture, edits), InvalidInput);
  edits = two_shots(4);
  edits.shots[1].last = 100;
  EXPECT_THROW(film_frames(texture, edits), InvalidInput);
  edits = two_shots(4);
  edits.shots[0].first = -1;
  EXPECT_THROW(film_frames(texture, edits), InvalidInput);
  edits = two_shots(4);
  edits.cuts.clear();
  EXPECT_THROW(film_frames(texture, edits), InvalidInput);
  EXPECT_THROW(film_frames(texture, two_shots(-1)), InvalidInput);
  EXPECT_THROW(film_frames(texture, {}), InvalidInput);
}

TEST(FilmFrames, BothTakesPlayOnThroughATransition) {
  const std::vector<FilmFrame> film = film_frames(two_takes(), two_shots(5));
  ASSERT_EQ(film.size(), 40U);
  EXPECT_EQ(film[16].frame, 26);
  EXPECT_EQ(film[16].next_frame, -1);
  for (int k = 0; k < 5; ++k) {
    const FilmFrame& frame = film[static_cast<std::size_t>(17 + k)];
    EXPECT_EQ(frame.frame, 29 - 3 + 1 + k);
    EXPECT_EQ(frame.next_frame, 60 - 3 + k);
    EXPECT_DOUBLE_EQ(frame.weight, (k + 1) / 6.0);
    EXPECT_EQ(frame.cut, 0);
  }
  EXPECT_EQ(film[22].frame, 62);
  EXPECT_EQ(film[22].next_frame, -1);
}

TEST(FilmFrames, WithoutTransitionFramesItIsAHardCut) {
  const std::vector<FilmFrame> film = film_frames(two_takes(), two_shots(0));
  EXPECT_EQ(film[19].frame, 29);
  EXPECT_EQ(film[20].frame, 60);
  for (const FilmFrame& frame : film) EXPECT_EQ(frame.next_frame, -1);
}

TEST(FilmFrames, ATransitionIsCutWhereATakeOrAShotEnds) {
  const PeopleTexture texture = two_takes();
  EditList edits;
  edits.shots = {{30, 48, -1}, {60, 79, -1}};
  edits.cuts = {{48, 60, 8, 0}};
  EXPECT_EQ(transition_lengths(texture, edits), std::vector<int>{3});  // one frame is left of the first take
  edits.shots = {{10, 29, -1}, {50, 79, -1}};
  edits.cuts = {{29, 50, 8, 0}};
  EXPECT_EQ(transition_lengths(texture, edits), std::vector<int>{0});  // none before the first of the second
  edits.shots = {{10, 29, -1}, {60, 65, -1}, {20, 40, -1}};
  edits.cuts = {{29, 60, 20, 0}, {65, 20, 20, 0}};
  EXPECT_EQ(transition_lengths(texture, edits), (std::vector<int>{7, 6}));
}

TEST(FilmFrames, ALoopsLastCutFillsItsEndAndItsBeginning) {
  EditList edits = two_shots(4);
  edits.loop = true;
  edits.cuts.push_back({79, 10, 4, 0});
  const std::vector<FilmFrame> film = film_frames(two_takes(), edits);
  ASSERT_EQ(film.size(), 40U);
  EXPECT_EQ(film[38].frame, 78);
  EXPECT_EQ(film[38].next_frame, 8);
  EXPECT_EQ(film[39].next_frame, 9);
  EXPECT_EQ(film[0].frame, 80);
  EXPECT_EQ(film[0].next_frame, 10);
  EXPECT_EQ(film[1].next_frame, 11);
  EXPECT_DOUBLE_EQ(film[1].weight, 0.8);
  EXPECT_EQ(film[2].frame, 12);
  EXPECT_EQ(film[2].next_frame, -1);
}

}  // namespace
}  // namespace motex
