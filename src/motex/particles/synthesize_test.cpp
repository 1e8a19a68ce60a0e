// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/synthesize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "motex/core/error.h"
#include "motex/particles/arrivals.h"
#include "motex/particles/birth_death.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/simulate.h"

namespace motex {
namespace {

constexpr int kWidth = 120, kHeight = 90;
constexpr std::int64_t kFrames = 60;

Base spot(double x, double y, double scale, double amplitude) {
  Base base{BaseKind::kGaussian, x, y, scale, 0, {}};
  base.coefficients.fill(static_cast<float>(coefficient_of_peak(base, amplitude)));
  return base;
}

/// What a perfect tracker would make of simulated snow.
TexturedMotion snow_model(double elements = 40) {
  SimulateSnowOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.frames = kFrames;
  options.elements = elements;
  options.spread = 0.3;
  const SimulatedScene scene = simulate_snow(options);
  TexturedMotion model;
  model.width = kWidth;
  model.height = kHeight;
  model.num_frames = kFrames;
  for (const SimulatedPoint& point : scene.points) {
    const auto track = static_cast<std::size_t>(point.track);
    if (model.cables.size() <= track) model.cables.resize(track + 1);
    Cable& cable = model.cables[track];
    if (cable.core.empty()) cable.first_frame = point.frame;
    if (cable.end_frame() == point.frame) cable.core.push_back(spot(point.x, point.y, point.scale, point.amplitude));
  }
  std::erase_if(model.cables, [](const Cable& cable) { return cable.core.empty(); });
  model.background = Planes(1, Plane(kWidth, kHeight, 70));
  model.maps = estimate_maps(model.cables, kWidth, kHeight, kFrames);
  return model;
}

bool is_inside(const Base& base) {
  return base.x >= -0.5 && base.y >= -0.5 && base.x < kWidth - 0.5 && base.y < kHeight - 0.5;
}

struct Flow {
  double vx = 0, vy = 0, count = 0;
};

Flow flow_of(const std::vector<Cable>& cables, std::int64_t num_frames) {
  Flow flow;
  double steps = 0;
  for (const Cable& cable : cables)
    for (std::size_t k = 0; k < cable.core.size(); ++k) {
      if (!is_inside(cable.core[k])) continue;
      flow.count += 1 / static_cast<double>(num_frames);
      if (k == 0) continue;
      flow.vx += cable.core[k].x - cable.core[k - 1].x;
      flow.vy += cable.core[k].y - cable.core[k - 1].y;
      steps += 1;
    }
  flow.vx /= steps;
  flow.vy /= steps;
  return flow;
}

bool same(const MovetonFrame& a, const MovetonFrame& b) {
  if (a.bases.size() != b.bases.size()) return false;
  std::multiset<std::pair<double, double>> of_a, of_b;
  for (const Base& base : a.bases) of_a.emplace(base.x, base.y);
  for (const Base& base : b.bases) of_b.emplace(base.x, base.y);
  return of_a == of_b;
}

TEST(Arrivals, KeepTheRateAndRepeatWithThePeriod) {
  const Arrivals arrivals(0.37, 0, Rng(1));
  int num = 0;
  for (std::int64_t t = -1000; t < 1000; ++t) arrivals.at(t, [&](std::int64_t, Rng&) { ++num; });
  EXPECT_NEAR(num, 740, 3);
  const Arrivals periodic(0.37, 50, Rng(1));
  std::vector<std::vector<std::int64_t>> numbers(150);
  for (std::int64_t t = -50; t < 100; ++t)
    periodic.at(t, [&](std::int64_t number, Rng&) { numbers[static_cast<std::size_t>(t + 50)].push_back(number); });
  std::size_t in_period = 0;
  for (std::size_t t = 0; t < 50; ++t) {
    EXPECT_EQ(numbers[t], numbers[t + 50]);
    EXPECT_EQ(numbers[t], numbers[t + 100]);
    in_period += numbers[t].size();
  }
  EXPECT_EQ(in_period, 19U) << "18.5 rounded";
}

TEST(WeightedDeck, TakesEachAsOftenAsItsWeightSays) {
  WeightedDeck deck({1, 3, 0, 4}, Rng(1));
  std::vector<int> times(4);
  for (std::int64_t n = 0; n < 800; ++n) ++times[deck.draw(n)];
  EXPECT_NEAR(times[0], 100, 12);
  EXPECT_NEAR(times[1], 300, 12);
  EXPECT_EQ(times[2], 0);
  EXPECT_TRUE(WeightedDeck({0, 0}, Rng(1)).empty());
}

TEST(Synthesize, RefusesWhatCannotBe) {
  const TexturedMotion model = snow_model();
  SynthesizeParticlesOptions options;
  EXPECT_THROW(CableSynthesizer(TexturedMotion{}, options), InvalidInput);
  EXPECT_THROW(synthesize_cables(model, options, 0), InvalidInput);
  options.rate = -1;
  EXPECT_THROW(CableSynthesizer(model, options), InvalidInput);
  options = {};
  options.source_map = Plane(kWidth, kHeight, 0);
  EXPECT_THROW(CableSynthesizer(model, options), InvalidInput) << "black";
  options.source_map = Plane(7, 7, 1);
  EXPECT_THROW(CableSynthesizer(model, options), InvalidInput) << "another size";
  options = {};
  options.appearance = ParticleAppearance::kTemplates;
  EXPECT_THROW(CableSynthesizer(model, options), InvalidInput) << "no templates";
  options = {};
  options.loop = true;
  EXPECT_THROW(CableSynthesizer(model, options, 0), InvalidInput);
  options = {};
  options.looks_of_species = 3;
  EXPECT_THROW(CableSynthesizer(model, options), InvalidInput);
}

TEST(Synthesize, NothingWithoutBirths) {
  TexturedMotion model = snow_model();
  SynthesizeParticlesOptions options;
  options.rate = 0;
  EXPECT_TRUE(synthesize_cables(model, options, 30).empty());
  model.cables.clear();
  EXPECT_TRUE(synthesize_cables(model, {}, 30).empty());
}

TEST(Synthesize, MovesAndNumbersAsLearned) {
  const TexturedMotion model = snow_model();
  const Flow learned = flow_of(model.cables, kFrames);
  SynthesizeParticlesReport report;
  const std::vector<Cable> cables = synthesize_cables(model, {}, 400, {}, &report);
  const Flow made = flow_of(cables, 400);
  EXPECT_NEAR(made.count / learned.count, 1, 0.05);
  EXPECT_NEAR(made.vx, learned.vx, 0.08);
  EXPECT_NEAR(made.vy, learned.vy, 0.08);
  EXPECT_NEAR(report.learned_per_frame, learned.count, 1e-9);
  // steady from the first frame on
  const Flow early = flow_of(synthesize_cables(model, {}, 20), 20);
  EXPECT_NEAR(early.count / learned.count, 1, 0.2);
}

TEST(Synthesize, SameSeedSameFrames) {
  const TexturedMotion model = snow_model(15);
  SynthesizeParticlesOptions options;
  const std::vector<Cable> a = synthesize_cables(model, options, 20), b = synthesize_cables(model, options, 20);
  options.seed = 2;
  const std::vector<Cable> c = synthesize_cables(model, options, 20);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].core.back().x, b[k].core.back().x);
  EXPECT_NE(a[0].core[0].x, c[0].core[0].x);
}

TEST(Synthesize, LoopsRepeatExactly) {
  const TexturedMotion model = snow_model();
  SynthesizeParticlesOptions options;
  options.loop = true;
  CableSynthesizer synthesizer(model, options, 25);
  std::vector<MovetonFrame> frames(51);
  for (MovetonFrame& frame : frames) synthesizer.next_frame(frame);
  EXPECT_FALSE(frames[0].bases.empty());
  for (std::size_t t = 0; t < 26; ++t) EXPECT_TRUE(same(frames[t], frames[t + 25])) << t;
  EXPECT_FALSE(same(frames[0], frames[1]));
}

TEST(Synthesize, WindBlowsAndKeepsThePictureFull) {
  const TexturedMotion model = snow_model();
  const Flow learned = flow_of(model.cables, kFrames);
  SynthesizeParticlesOptions options;
  options.wind_x = 6;
  const std::vector<Cable> cables = synthesize_cables(model, options, 300);
  const Flow made = flow_of(cables, 300);
  EXPECT_NEAR(made.vx, learned.vx + 6, 0.15);
  EXPECT_NEAR(made.vy, learned.vy, 0.15);
  EXPECT_NEAR(made.count / learned.count, 1, 0.15);
  double left = 0, all = 0;  // the lower left would be empty if flakes came from above alone
  for (const Cable& cable : cables)
    for (const Base& base : cable.core) {
      all += is_inside(base) ? 1 : 0;
      left += is_inside(base) && base.x < kWidth / 2.0 && base.y > kHeight / 2.0 ? 1 : 0;
    }
  EXPECT_NEAR(left / all, 0.25, 0.08);
}

TEST(Synthesize, SpeedAndGravityAndRate) {
  const TexturedMotion model = snow_model();
  const Flow learned = flow_of(model.cables, kFrames);
  SynthesizeParticlesOptions options;
  options.speed = 2;
  const Flow fast = flow_of(synthesize_cables(model, options, 300), 300);
  EXPECT_NEAR(fast.vx / learned.vx, 2, 0.15);
  EXPECT_NEAR(fast.count / learned.count, 1, 0.1) << "time runs faster, density stays";
  options = {};
  options.gravity = 0.3;
  EXPECT_GT(flow_of(synthesize_cables(model, options, 100), 100).vy, learned.vy + 0.3);
  options = {};
  options.rate = 3;
  EXPECT_NEAR(flow_of(synthesize_cables(model, options, 300), 300).count / learned.count, 3, 0.2);
}

TEST(Synthesize, BirthsFollowThePaintedMap) {
  const TexturedMotion model = snow_model();
  SynthesizeParticlesOptions options;
  options.source_map = Plane(kWidth, kHeight);
  for (int y = 40; y < 50; ++y)
    for (int x = 60; x < 70; ++x) options.source_map.at(x, y) = 1;
  for (const Cable& cable : synthesize_cables(model, options, 60)) {
    if (cable.first_frame == 0) continue;
    EXPECT_NEAR(cable.core[0].x, 64.5, 5.1);
    EXPECT_NEAR(cable.core[0].y, 44.5, 5.1);
  }
  options.source_map = {};
  options.uniform = true;
  double mean_y = 0, num = 0;
  for (const Cable& cable : synthesize_cables(model, options, 300)) {
    if (cable.first_frame == 0) continue;
    mean_y += cable.core[0].y;
    num += 1;
  }
  EXPECT_NEAR(mean_y / num, kHeight / 2.0, 8);
}

TEST(Synthesize, DeathsFollowThePaintedMap) {
  const TexturedMotion model = snow_model();
  SynthesizeParticlesOptions options;
  options.sink_map = Plane(kWidth, kHeight);
  for (int x = 0; x < kWidth; ++x)
    for (int y = 50; y < 54; ++y) options.sink_map.at(x, y) = 255;
  double above = 0, below = 0;
  for (const Cable& cable : synthesize_cables(model, options, 200))
    for (const Base& base : cable.core) (base.y < 50 ? above : below) += is_inside(base) ? 1 : 0;
  EXPECT_LT(below, 0.5 * above * (kHeight - 50) / 50.0);
}

TEST(Synthesize, DeathsHaveThePaintedProbability) {
  const TexturedMotion model = snow_model();
  SynthesizeParticlesOptions options;
  options.hazard_map = Plane(kWidth, kHeight);
  for (int x = 0; x < kWidth; ++x)
    for (int y = 48; y < 56; ++y) options.hazard_map.at(x, y) = 1;
  int above = 0, below = 0, born_below = 0;
  for (const Cable& cable : synthesize_cables(model, options, 200)) {
    born_below += cable.core[0].y >= 48 ? 1 : 0;
    if (cable.core[0].y >= 40) continue;
    ++above;
    below += cable.core.back().y > 70 ? 1 : 0;  // it fades over a few frames
  }
  EXPECT_GT(above, 50);
  EXPECT_LT(below, above / 50);
  EXPECT_GT(born_below, 0);
  options.hazard_map = Plane(kWidth, kHeight, 0);
  for (const Cable& cable : synthesize_cables(model, options, 60)) {
    const Base& last = cable.core.back();
    const bool inside = last.x > 5 && last.y > 5 && last.x < kWidth - 5 && last.y < kHeight - 5;
    EXPECT_TRUE(!inside || cable.end_frame() == 60);
  }
  options.sink_map = Plane(kWidth, kHeight, 1);
  EXPECT_THROW(synthesize_cables(model, options, 10), InvalidInput);
}

/// Elements that move nowhere for the whole clip are there in the synthesis, too.
TEST(Synthesize, KeepsResidents) {
  TexturedMotion model;
  model.width = kWidth;
  model.height = kHeight;
  model.num_frames = kFrames;
  for (int k = 0; k < 6; ++k) {
    Cable cable;
    for (int t = 0; t < kFrames; ++t) cable.core.push_back(spot(20 + 15 * k + 0.02 * t, 40, 2, 90));
    model.cables.push_back(cable);
  }
  model.maps = estimate_maps(model.cables, kWidth, kHeight, kFrames);
  EXPECT_NEAR(flow_of(synthesize_cables(model, {}, 600), 600).count, 6, 1);
}

TEST(Synthesize, BurstsComeAsAWhole) {
  TexturedMotion model;
  model.width = kWidth;
  model.height = kHeight;
  model.num_frames = kFrames;
  Burst burst{60, 45, 10, {}};
  for (int k = 0; k < 12; ++k) {
    const double angle = k * 0.5236;
    Cable cable;
    cable.first_frame = 10 + k % 2;
    for (int t = 0; t < 15; ++t)
      cable.core.push_back(spot(60 + 1.2 * t * std::cos(angle), 45 + 1.2 * t * std::sin(angle), 1, 100));
    burst.cables.push_back(k);
    model.cables.push_back(cable);
  }
  model.maps.bursts.push_back(burst);
  model.maps.bursts_per_frame = 1.0 / kFrames;
  model.maps.bandwidth = 5;
  model.dynamics.push_back(fit_dynamics(model.cables));
  const std::vector<Cable> cables = synthesize_cables(model, {}, 300);
  std::map<std::int64_t, int> births;
  for (const Cable& cable : cables)
    if (cable.first_frame > 0) ++births[cable.first_frame];
  EXPECT_GE(births.size(), 6U);
  for (const auto& [frame, num] : births) EXPECT_EQ(num, 6) << "every second one a frame later, as learned";
  for (const Cable& cable : cables) EXPECT_LE(cable.num_frames(), 16);
}

TEST(Synthesize, AppearanceOfTemplates) {
  TexturedMotion model = snow_model(15);
  MovetonTemplate star;
  TemplatePose pose;
  pose.coils.resize(2);
  pose.coils[0].u = {1.5, 0};
  pose.coils[1].u = {-1.5, 0};
  for (TemplateCoil& coil : pose.coils) coil.coefficient[0] = {0.5, 0};
  star.poses.push_back(pose);
  star.pose_transitions = TransitionMatrix(1);
  star.pose_transitions.add_count(0, 0);
  star.log_scale = {0.4, 0.1};
  star.amplitude = {80, 10};
  star.colour = {Spread{1, 0}, Spread{1, 0}, Spread{1, 0}};
  model.templates.push_back(star);
  model.dynamics.push_back(fit_dynamics(model.cables));
  for (Cable& cable : model.cables) cable.species = 0;
  SynthesizeParticlesOptions options;
  options.appearance = ParticleAppearance::kTemplates;
  const std::vector<Cable> cables = synthesize_cables(model, options, 30);
  ASSERT_FALSE(cables.empty());
  for (const Cable& cable : cables) {
    EXPECT_EQ(cable.coils.size(), 2U);
    EXPECT_EQ(cable.species, 0);
    for (const Base& base : cable.core) {
      EXPECT_GT(base.scale, 0.5);
      EXPECT_LT(base.scale, 4);
      EXPECT_GT(peak_amplitude(base), 0);
    }
  }
}

}  // namespace
}  // namespace motex
