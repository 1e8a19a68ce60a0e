// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/learn_water.h"
#include "motex/particles/star.h"
#include "motex/particles/steady.h"
#include "motex/particles/water_synthesis.h"

namespace motex {
namespace {

constexpr int kWidth = 64, kHeight = 80;

/// A fall: in the middle third bright and dark streaks come down at 4 pixels a frame for ever; still rock beside it.
ClipFrames fall(int num_frames) {
  Rng rng(3);
  std::vector<Base> streaks;
  for (int k = 0; k < 400; ++k) {
    Base base{
        BaseKind::kGaussian, rng.uniform(22, 42), rng.uniform(-4.0 * num_frames, kHeight), rng.uniform(1, 2), 0, {}};
    base.coefficients[0] = static_cast<float>(rng.uniform(30, 90) * (rng.uniform() < 0.5 ? -1 : 1));
    streaks.push_back(base);
  }
  ClipFrames clip{kWidth, kHeight, 25, {}, {}};
  for (int t = 0; t < num_frames; ++t) {
    BaseMap map{kWidth, kHeight, 1, streaks};
    for (Base& base : map.bases) base.y += 4.0 * t;
    Plane frame = reconstruct(map, {Plane(kWidth, kHeight, 100)})[0];
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        frame.at(x, y) += static_cast<float>((x * 7 + y * 13) % 17);  // rock
        frame.at(x, y) += static_cast<float>(rng.normal());
      }
    clip.luma.push_back(frame);
  }
  return clip;
}

double deviation_over_time(const std::vector<Plane>& frames, int x, int y) {
  double sum = 0, squares = 0;
  for (const Plane& frame : frames) {
    const double v = static_cast<double>(frame.at(x, y));
    sum += v;
    squares += v * v;
  }
  const auto n = static_cast<double>(frames.size());
  return std::sqrt(std::max(0.0, squares / n - sum * sum / n / n));
}

class WaterTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    water_clip = new ClipFrames(fall(40));
    LearnWaterOptions options;
    options.num_bases = 150;
    water_model = new LearnedWater(learn_water(*water_clip, options));
  }
  static void TearDownTestSuite() {
    delete water_clip;
    delete water_model;
  }
  static std::vector<Plane> synthesized(int num_frames, std::uint64_t seed) {
    WaterSource source(water_model->model, {}, seed);
    WaterPainter painter(water_model->model, water_model->model.background, 1, seed);
    std::vector<Plane> frames;
    MovetonFrame frame;
    Image picture, layer;
    for (int t = 0; t < num_frames; ++t) {
      source.next_frame(frame);
      painter.paint(frame, picture, layer);
      frames.push_back(luma(picture));
    }
    return frames;
  }
  static ClipFrames* water_clip;
  static LearnedWater* water_model;
};
ClipFrames* WaterTest::water_clip = nullptr;
LearnedWater* WaterTest::water_model = nullptr;

TEST_F(WaterTest, LearnsFlowBasesAndLight) {
  const TexturedMotion& model = water_model->model;
  ASSERT_TRUE(model.water.has_value());
  EXPECT_NEAR(model.water->flow.at(32, 40).y, 4, 0.3);
  EXPECT_NEAR(model.water->flow.at(32, 40).x, 0, 0.3);
  EXPECT_GT(water_model->carry.mean_life, 4);
  EXPECT_GT(water_model->carry.psnr, water_model->carry.background_psnr + 6);
  EXPECT_LT(water_model->light, 4);
}

TEST_F(WaterTest, SynthesisFallsAsFastAndFlickersAsMuchWhereTheClipDoes) {
  const std::vector<Plane> frames = synthesized(80, 5);
  for (const int y : {20, 40, 60}) {
    double water = 0, observed = 0, rock = 0;
    for (const int x : {28, 30, 32, 34, 36}) {
      water += deviation_over_time(frames, x, y);
      observed += deviation_over_time(water_clip->luma, x, y);
    }
    for (const int x : {4, 8, 56, 60}) rock += deviation_over_time(frames, x, y);
    EXPECT_NEAR(water / observed, 1, 0.35) << y;
    EXPECT_LT(rock / 4, 3) << y;
  }
  std::vector<Plane> residuals = frames;
  for (Plane& plane : residuals)
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] -= water_model->model.background[0].values[i];
  EXPECT_NEAR(estimate_flow_field(residuals).at(32, 40).y, 4, 0.4);
}

TEST_F(WaterTest, SameSeedSameFramesOtherSeedOthers) {
  const std::vector<Plane> a = synthesized(6, 5), b = synthesized(6, 5), c = synthesized(6, 6);
  EXPECT_EQ(a[5].values, b[5].values);
  EXPECT_NE(a[5].values, c[5].values);
}

TEST_F(WaterTest, LoopComesBackAndItsEndLeadsToItsBeginning) {
  WaterSource source(water_model->model, {}, 4, 30);
  std::vector<Plane> frames;
  MovetonFrame frame;
  BaseRenderer renderer;
  for (int t = 0; t < 31; ++t) {
    source.next_frame(frame);
    EXPECT_EQ(frame.frame, t);
    Planes picture{Plane(kWidth, kHeight)};
    renderer.add(frame.bases, picture);
    frames.push_back(picture[0]);
  }
  EXPECT_EQ(frames[30].values, frames[0].values);
  double step = 0;
  for (int t = 14; t < 29; ++t)
    step += std::pow(10, -psnr(frames[static_cast<std::size_t>(t)], frames[static_cast<std::size_t>(t) + 1]) / 10) / 15;
  EXPECT_LT(std::pow(10, -psnr(frames[29], frames[30]) / 10), 1.5 * step);
}

TEST_F(WaterTest, TrackNumbersBelongToOneCableEach) {
  WaterSource source(water_model->model, {}, 4);
  MovetonFrame before, now;
  source.next_frame(before);
  int kept = 0;
  for (int t = 0; t < 20; ++t, std::swap(before, now)) {
    source.next_frame(now);
    std::set<std::int64_t> seen;
    for (const Moveton& moveton : now.movetons) EXPECT_TRUE(seen.insert(moveton.track).second);
    for (const Moveton& a : before.movetons)
      for (const Moveton& b : now.movetons)
        if (a.track == b.track) {
          EXPECT_LT(std::hypot(before.core_of(a).x - now.core_of(b).x, before.core_of(a).y - now.core_of(b).y), 25);
          ++kept;
        }
  }
  EXPECT_GT(kept, 400);
}

TEST_F(WaterTest, LayersOverTheBackgroundGiveThePictureAtTwiceTheSize) {
  WaterSource source(water_model->model, {}, 4);
  const Planes background{Plane(2 * kWidth, 2 * kHeight, 90)};
  WaterPainter painter(water_model->model, background, 2, 4);
  MovetonFrame frame;
  Image picture, layer;
  source.next_frame(frame);
  painter.paint(frame, picture, layer);
  ASSERT_EQ(picture.width, 2 * kWidth);
  Image over = to_image(background);
  paste(over, layer, 0, 0);
  EXPECT_GT(psnr(over, picture), 45);
}

TEST_F(WaterTest, BadInputIsRefused) {
  EXPECT_THROW(learn_water(fall(5)), InvalidInput);
  TexturedMotion other = water_model->model;
  other.water.reset();
  EXPECT_THROW(WaterSource(other, {}, 1), InvalidInput);
  EXPECT_THROW(WaterPainter(other, other.background, 1, 1), InvalidInput);
  EXPECT_THROW(WaterSource(water_model->model, {}, 1, 1), InvalidInput);
}

TEST(LooksLikeWater, AFallDoesAndTheNoiseOfACameraDoesNot) {
  EXPECT_TRUE(looks_like_water(fall(40)));
  EXPECT_FALSE(looks_like_water(fall(12)));
  Rng rng(1);
  ClipFrames still{kWidth, kHeight, 25, {}, {}};
  for (int t = 0; t < 40; ++t) {
    Plane& frame = still.luma.emplace_back(kWidth, kHeight, 90);
    for (float& value : frame.values) value += static_cast<float>(4 * rng.normal());
  }
  EXPECT_FALSE(looks_like_water(still));
}

TEST(Star, FindsTheWeightsOfAKnownProcess) {
  constexpr int kSide = 48;
  Rng rng(2);
  std::vector<Plane> frames;
  Plane z(kSide, kSide);
  for (int t = 0; t < 60; ++t) {
    Plane next(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const float up = y > 0 ? z.at(x, y - 1) : 0;
        next.at(x, y) = 0.6F * up + 0.3F * z.at(x, y) + static_cast<float>(rng.normal());
      }
    z = next;
    if (t >= 20) {
      for (float& v : next.values) v = 50 + 5 * v;
      frames.push_back(next);
    }
  }
  const StarModel model = fit_star(frames, {}, {1, 1, 0});
  for (const StarModel::Neighbour& n : model.neighbours) {
    const double truth = n.dx == 0 && n.dy == -1 ? 0.6 : n.dx == 0 && n.dy == 0 ? 0.3 : 0;
    EXPECT_NEAR(n.weight, truth, 0.03) << n.dx << "," << n.dy;
  }
  // predicting is better than the mean, and a sampled run has the deviation of the frames
  const std::vector<Plane> past(frames.end() - 3, frames.end() - 1);
  EXPECT_GT(psnr(predict_star(model, past), frames.back()), psnr(model.mean, frames.back()) + 1.5);
  StarSampler sampler(model, 4);
  std::vector<Plane> run;
  for (int t = 0; t < 90; ++t) {
    sampler.next();
    if (t >= 30) run.push_back(sampler.next());
  }
  double sampled = 0, observed = 0;
  for (int k = 8; k < 40; k += 4)
    sampled += deviation_over_time(run, k, k), observed += deviation_over_time(frames, k, k);
  EXPECT_NEAR(sampled / observed, 1, 0.2);
}

TEST(Star, StillFramesStayStillAndFewFramesAreRefused) {
  const std::vector<Plane> still(6, Plane(16, 16, 80));
  const StarModel model = fit_star(still, {});
  StarSampler sampler(model, 1);
  for (int t = 0; t < 20; ++t)
    for (const float v : sampler.next().values) EXPECT_NEAR(v, 80, 2);
  EXPECT_THROW(fit_star({still[0], still[1]}, {}), InvalidInput);
  EXPECT_THROW(predict_star(model, {still[0]}), InvalidInput);
}

/// Blobs and bars seen by a camera at (−dx, −dy).
Plane scenery(double dx, double dy) {
  Rng rng(9);
  BaseMap map{96, 64, 1, {}};
  for (int k = 0; k < 80; ++k) {
    Base base{BaseKind::kGaussian, rng.uniform(-10, 106) + dx, rng.uniform(-10, 74) + dy, rng.uniform(1.5, 4), 0, {}};
    base.coefficients[0] = static_cast<float>(rng.uniform(-300, 300));
    map.bases.push_back(base);
  }
  return reconstruct(map, {Plane(96, 64, 120)})[0];
}

TEST(Steady, FindsHowTheCameraMovedAndTakesItOut) {
  ClipFrames clip{96, 64, 25, {}, {}};
  for (int t = 0; t < 20; ++t) clip.luma.push_back(scenery(t < 4 ? 30 - 5 * t : 2 * std::sin(t), 0.1 * t));
  const std::vector<Shift> shifts = estimate_shifts(clip.luma);
  EXPECT_NEAR(shifts[16].dx - shifts[10].dx, 2 * (std::sin(16) - std::sin(10)), 0.05);
  EXPECT_NEAR(shifts[16].dy - shifts[10].dy, 0.6, 0.05);
  const SteadyClip out = steady(clip);
  EXPECT_TRUE(out.moved);
  EXPECT_EQ(out.first_frame, 4);
  EXPECT_EQ(out.clip.num_frames(), 16);
  EXPECT_LT(out.clip.width, 96);
  EXPECT_GT(out.clip.width, 84);
  EXPECT_GT(psnr(out.clip.luma.front(), out.clip.luma.back()), 40);
}

TEST(Steady, LeavesStillAndBoilingPicturesAlone) {
  ClipFrames still{96, 64, 25, std::vector<Plane>(14, scenery(0, 0)), {}}, boiling = still;
  Rng rng(4);
  for (Plane& plane : boiling.luma)
    for (float& v : plane.values) v = static_cast<float>(rng.uniform(0, 255));
  EXPECT_FALSE(steady(still).moved);
  EXPECT_FALSE(steady(boiling).moved);
  EXPECT_EQ(steady(boiling).clip.luma[3].values, boiling.luma[3].values);
}

}  // namespace
}  // namespace motex
