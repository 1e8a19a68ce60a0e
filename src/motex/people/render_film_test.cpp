// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/render_film.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/people/align_sprites.h"
#include "motex/people/carried_placement.h"
#include "motex/people/cut_quality.h"
#include "motex/people/drawn_actor.h"

namespace motex {
namespace {

/// Two takes of 40 frames: an actor waves; in the second take elsewhere.
struct Footage {
  std::vector<Sprite> sprites;
  PeopleTexture texture;

  Footage() {
    for (int t = 0; t < 80; ++t) {
      const bool second = t >= 40;
      sprites.push_back(drawn_actor({.x = second ? 112.0 : 95.0,
                                     .ground = second ? 187.0 : 190.0,
                                     .left_arm = 0.8 + 0.3 * std::sin(0.2 * t),
                                     .right_arm = second ? 1.0 : 0.8,
                                     .lean = second ? 4.0 : 0.0}));
    }
    texture = texture_of(sprites);
    texture.takes = {{"a", 0, 0, false, {0, 40}}, {"b", 0, 0, false, {40, 40}}};
  }
};

EditList one_cut(int transition_frames) {
  EditList edits;
  edits.shots = {{5, 24, -1}, {50, 74, -1}};
  edits.cuts = {{24, 50, transition_frames, 0}};
  return edits;
}

std::vector<Sprite> film_of(const Footage& footage, const EditList& edits, const RenderFilmOptions& options = {},
                            std::vector<CutReport>* cuts = nullptr, int jobs = 0) {
  MemorySprites source(footage.sprites);
  JobContext job;
  job.jobs = jobs;
  FilmRenderer film(footage.texture, source, edits, options, job);
  std::vector<Sprite> frames;
  for (Sprite sprite; film.next(sprite);) frames.push_back(sprite);
  EXPECT_EQ(static_cast<int>(frames.size()), film.num_frames());
  if (cuts != nullptr) *cuts = film.cuts();
  return frames;
}

TEST(RenderFilm, RefusesSpritesOfAnotherNumber) {
  const Footage footage;
  MemorySprites few(std::vector<Sprite>(footage.sprites.begin(), footage.sprites.begin() + 3));
  EXPECT_THROW(FilmRenderer(footage.texture, few, one_cut(4)), InvalidInput);
}

TEST(RenderFilm, IsTheFootageWhereNothingIsCut) {
  const Footage footage;
  const std::vector<Sprite> film = film_of(footage, one_cut(6));
  for (int i = 0; i < 17; ++i) {
    const Sprite &shown = film[static_cast<std::size_t>(i)], &real = footage.sprites[static_cast<std::size_t>(5 + i)];
    EXPECT_EQ(shown.left, real.left);
    EXPECT_EQ(shown.pixels, real.pixels);
  }
}

TEST(RenderFilm, FeetNeitherJumpNorSlideOverACut) {
  const Footage footage;
  for (const int transition_frames : {0, 1, 6, 9}) {
    const std::vector<Sprite> film = film_of(footage, one_cut(transition_frames));
    const Footing first = footing_of(film[0]).value();
    for (std::size_t i = 1; i < film.size(); ++i) {
      const Footing before = footing_of(film[i - 1]).value(), now = footing_of(film[i]).value();
      EXPECT_NEAR(now.x, before.x, 1) << i;
      EXPECT_NEAR(now.y, before.y, 1) << i;
      EXPECT_NEAR(now.x, first.x, 3) << i;
    }
  }
}

TEST(RenderFilm, WithoutAlignmentTheSecondTakeStaysWhereItWasFilmed) {
  const Footage footage;
  RenderFilmOptions options;
  options.align = false;
  const std::vector<Sprite> film = film_of(footage, one_cut(4), options);
  EXPECT_EQ(sprite_difference(film.back(), footage.sprites[74]), 0);
}

TEST(RenderFilm, TakesTheRendererWithTheLeastErrorAndSaysSo) {
  const Footage footage;
  std::vector<CutReport> cuts;
  film_of(footage, one_cut(6), {}, &cuts);
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_EQ(cuts[0].transition_frames, 6);
  EXPECT_GT(cuts[0].dissolve_error, cuts[0].morph_error);
  EXPECT_TRUE(cuts[0].renderer == TransitionRenderer::kFieldMorph || cuts[0].renderer == TransitionRenderer::kFlow);
  EXPECT_NEAR(cuts[0].placement.x, -17, 3);
  EXPECT_NEAR(cuts[0].placement.y, 3, 1);
  EXPECT_GT(cuts[0].num_lines, 15);
}

TEST(RenderFilm, CutsHardWhereNoRendererIsTrueEnoughButOnlyIfThatIsSmooth) {
  const Footage footage;
  RenderFilmOptions strict;
  strict.max_error = 0;
  std::vector<CutReport> cuts;
  EditList like;  // one wave later: nearly what would come anyway
  like.shots = {{0, 6, -1}, {38, 39, -1}};
  like.cuts = {{6, 38, 2}};
  film_of(footage, like, strict, &cuts);
  EXPECT_EQ(cuts[0].renderer, TransitionRenderer::kHardCut);

  film_of(footage, one_cut(6), strict, &cuts);
  EXPECT_NE(cuts[0].renderer, TransitionRenderer::kHardCut);
}

TEST(RenderFilm, ARendererThatIsNotSmoothGivesWay) {
  const Footage footage;
  const SecondDifferenceScales scales = second_difference_scales(footage.texture);
  const auto smoothness = [&](TransitionRenderer renderer, double max_error) {
    RenderFilmOptions options;
    options.renderer = renderer, options.max_error = max_error;
    const std::vector<Sprite> film = film_of(footage, one_cut(6), options);
    return cut_quality({film.begin() + 15, film.begin() + 25}, scales).smoothness.largest();
  };
  const double chosen = smoothness(TransitionRenderer::kAuto, 0), cut = smoothness(TransitionRenderer::kHardCut, 0);
  const double dissolve = smoothness(TransitionRenderer::kCrossDissolve, 0);
  EXPECT_GT(cut, 2 * dissolve);
  EXPECT_LE(chosen, std::max(1.0, 1.25 * dissolve) + 0.05);
}

TEST(RenderFilm, IsSmootherThanAHardCutAndTruerThanADissolve) {
  const Footage footage;
  const SecondDifferenceScales scales = second_difference_scales(footage.texture);
  const auto quality = [&](TransitionRenderer renderer) {
    RenderFilmOptions options;
    options.renderer = renderer;
    const std::vector<Sprite> film = film_of(footage, one_cut(6), options);
    return cut_quality({film.begin() + 15, film.begin() + 25}, scales);
  };
  const CutQuality chosen = quality(TransitionRenderer::kAuto), dissolve = quality(TransitionRenderer::kCrossDissolve),
                   cut = quality(TransitionRenderer::kHardCut);
  EXPECT_LT(chosen.flow_error, dissolve.flow_error);
  EXPECT_LT(chosen.smoothness.centroid, cut.smoothness.centroid);
}

TEST(RenderFilm, ALoopEndsWhereItBegins) {
  const Footage footage;
  for (const int transition_frames : {0, 6}) {
    EditList edits = one_cut(transition_frames);
    edits.loop = true;
    edits.cuts.push_back({74, 5, transition_frames, 0});
    const std::vector<Sprite> film = film_of(footage, edits);
    for (std::size_t i = 0; i < film.size(); ++i) {
      const Footing now = footing_of(film[i]).value(), next = footing_of(film[(i + 1) % film.size()]).value();
      EXPECT_NEAR(next.x, now.x, 1.5) << i;
      EXPECT_NEAR(next.y, now.y, 1.5) << i;
    }
  }
}

/// Counts the frames that someone holds.
class CountedSprites : public SpriteSource {
 public:
  explicit CountedSprites(const std::vector<Sprite>& sprites) : sprites_(sprites) {}
  int num_frames() const override { return static_cast<int>(sprites_.size()); }
  std::shared_ptr<const Sprite> sprite(int frame) override {
    std::shared_ptr<const Sprite> given(new Sprite(sprites_[static_cast<std::size_t>(frame)]), [this](const Sprite* s) {
      --held_;
      delete s;
    });
    most_ = std::max(most_, ++held_);
    return given;
  }
  int most() const { return most_; }

 private:
  const std::vector<Sprite>& sprites_;
  int held_ = 0, most_ = 0;
};

TEST(RenderFilm, HoldsFewFrames) {
  const Footage footage;
  CountedSprites source(footage.sprites);
  const EditList edits = one_cut(6);
  FilmRenderer film(footage.texture, source, edits);
  for (Sprite sprite; film.next(sprite);) {
  }
  EXPECT_LE(source.most(), 2 * 6 + 2);
}

TEST(RenderFilm, IsTheSameForAnyNumberOfThreads) {
  const Footage footage;
  const std::vector<Sprite> one = film_of(footage, one_cut(6), {}, nullptr, 1);
  const std::vector<Sprite> three = film_of(footage, one_cut(6), {}, nullptr, 3);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].pixels, three[i].pixels);
}

}  // namespace
}  // namespace motex
