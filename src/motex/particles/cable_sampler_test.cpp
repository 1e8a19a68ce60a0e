// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/core_image.h"
#include "motex/particles/track_score.h"

namespace motex {
namespace {

struct Scene {
  std::vector<Cable> truth;
  std::vector<Plane> pictures;  ///< elements and noise; no background
};

struct SceneOptions {
  int width = 160, height = 120, num_frames = 12, num_elements = 45;
  double persistence = 0.7, step = 0.25, noise = 4;
  BaseKind kind = BaseKind::kGaussian;
  double sign = 1;
};

/// Elements of velocity v_t = (2, 1.5) + φ (v_{t−1} − (2, 1.5)) + d n that cross the picture.
Scene make_scene(const SceneOptions& options, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  const double spread = options.step / std::sqrt(1 - options.persistence * options.persistence);
  for (int i = 0; i < options.num_elements; ++i) {
    double x = rng.uniform(-25, options.width), y = rng.uniform(-20, options.height);
    double vx = spread * rng.normal(), vy = spread * rng.normal();
    const double log_scale = std::log(rng.uniform(1, 2.1)), peak = options.sign * rng.uniform(45, 105);
    const double angle = rng.uniform(0, 3);
    Cable cable;
    for (int t = 0; t < options.num_frames; ++t) {
      if (x > -3 && x < options.width + 2 && y > -3 && y < options.height + 2) {
        if (cable.core.empty()) cable.first_frame = t;
        cable.core.push_back(core_base(options.kind, {x, y, log_scale, peak, angle}));
      } else if (!cable.core.empty()) {
        break;
      }
      vx = options.persistence * vx + options.step * rng.normal();
      vy = options.persistence * vy + options.step * rng.normal();
      x += 2 + vx;
      y += 1.5 + vy;
    }
    if (!cable.core.empty()) scene.truth.push_back(cable);
  }
  for (int t = 0; t < options.num_frames; ++t) {
    Plane noise(options.width, options.height);
    for (float& value : noise.values) value = static_cast<float>(options.noise * rng.normal());
    ResidualFrame frame(noise);
    for (const Cable& cable : scene.truth)
      if (cable.covers(t)) paint_core(frame, options.kind, core_state(cable.at(t)), 1);
    for (int y = 0; y < noise.height; ++y) std::copy_n(frame.row(y), noise.width, noise.row(y));
    scene.pictures.push_back(noise);
  }
  return scene;
}

CablePrior prior_of(const Scene& scene, const std::vector<Cable>& cables) {
  EstimatePriorOptions options;
  options.num_frames = static_cast<int>(scene.pictures.size());
  return estimate_prior(cables, scene.pictures[0].width, scene.pictures[0].height, options);
}

/// Steps along a cable that lead from one true element to another.
int num_switches(const Scene& scene, const std::vector<Cable>& cables) {
  const auto identity = [&](const Base& base, std::int64_t frame) {
    double nearest = 2;
    int found = -1;
    if (base.x < 0 || base.y < 0 || base.x > scene.pictures[0].width - 1 || base.y > scene.pictures[0].height - 1)
      return -1;  // nothing can be seen there
    for (std::size_t k = 0; k < scene.truth.size(); ++k) {
      if (!scene.truth[k].covers(frame)) continue;
      const Base& other = scene.truth[k].at(frame);
      const double distance = std::hypot(base.x - other.x, base.y - other.y);
      if (distance < nearest) {
        nearest = distance;
        found = static_cast<int>(k);
      }
    }
    return found;
  };
  int num = 0;
  for (const Cable& cable : cables)
    for (std::int64_t t = cable.first_frame + 1; t < cable.end_frame(); ++t) {
      const int before = identity(cable.at(t - 1), t - 1), now = identity(cable.at(t), t);
      num += before >= 0 && now >= 0 && before != now ? 1 : 0;
    }
  return num;
}

/// Exchanges what follows a random frame between random near cables, so many times.
std::vector<Cable> with_swapped_tails(std::vector<Cable> cables, int num, Rng& rng) {
  while (num > 0) {
    Cable &a = cables[rng.below(cables.size())], &b = cables[rng.below(cables.size())];
    const auto t = static_cast<std::int64_t>(2 + rng.below(8));
    if (&a == &b || !a.covers(t) || !b.covers(t) || !a.covers(t - 1) || !b.covers(t - 1)) continue;
    if (std::hypot(a.at(t).x - b.at(t).x, a.at(t).y - b.at(t).y) > 8.5) continue;
    const auto in_a = a.core.begin() + (t - a.first_frame), in_b = b.core.begin() + (t - b.first_frame);
    std::vector<Base> tail_a(in_a, a.core.end()), tail_b(in_b, b.core.end());
    a.core.erase(in_a, a.core.end());
    b.core.erase(in_b, b.core.end());
    a.core.insert(a.core.end(), tail_b.begin(), tail_b.end());
    b.core.insert(b.core.end(), tail_a.begin(), tail_a.end());
    --num;
  }
  return cables;
}

double track_share(const Scene& scene, const std::vector<Cable>& cables) {
  const int width = scene.pictures[0].width, height = scene.pictures[0].height;
  return score_tracks(visible_part(tracks_of(scene.truth, 1), width, height),
                      visible_part(tracks_of(cables, 1), width, height), 3)
      .jsc_tracks;
}

TEST(CableSampler, RefusesWhatCannotBeSampled) {
  EXPECT_THROW(sample_cables({}, {}, CablePrior{}, {}), InvalidInput);
  CablePrior prior;
  prior.width = prior.height = 9;
  EXPECT_THROW(sample_cables({Plane(8, 9)}, {}, prior, {}), InvalidInput);
  EXPECT_THROW(sample_cables({Plane(9, 9), Plane(9, 8)}, {}, prior, {}), InvalidInput);
  prior.noise = 0;
  EXPECT_THROW(sample_cables({Plane(9, 9)}, {}, prior, {}), InvalidInput);
  EXPECT_THROW(estimate_prior({}, 9, 9, {}), InvalidInput);
}

TEST(CableSampler, StopsWhenAsked) {
  const Scene scene = make_scene({}, 1);
  const std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(sample_cables(scene.pictures, scene.truth, prior_of(scene, scene.truth), {}, job), Cancelled);
}

TEST(CableSampler, SwappedIdentitiesAreRepaired) {
  SceneOptions options;
  options.num_elements = 60;
  const Scene scene = make_scene(options, 3);
  Rng rng(8);
  const std::vector<Cable> corrupted = with_swapped_tails(scene.truth, 47, rng);
  ASSERT_GT(num_switches(scene, corrupted), 40);
  SampleCablesOptions sampling;
  sampling.sweeps = 30;
  sampling.learn_sweeps = 20;
  const SampleCablesReport report = sample_cables(scene.pictures, corrupted, prior_of(scene, corrupted), sampling);
  EXPECT_EQ(num_switches(scene, report.cables), 0);
}

TEST(CableSampler, FindsWhatIsMissingAndDropsWhatIsNotThere) {
  const Scene scene = make_scene({}, 5);
  Rng rng(4);
  std::vector<Cable> start;
  for (std::size_t k = 0; k < scene.truth.size(); ++k) {
    const Cable& cable = scene.truth[k];
    if (k % 9 == 4) continue;  // never seen
    Cable left = cable, right = cable;
    if (k % 3 == 0 && cable.core.size() > 6) {  // a gap of two frames
      left.core.resize(3);
      right.first_frame += 5;
      right.core.erase(right.core.begin(), right.core.begin() + 5);
      start.push_back(right);
    }
    start.push_back(left);
  }
  for (int i = 0; i < 12; ++i) {  // and some that are not there
    Cable ghost;
    ghost.first_frame = static_cast<std::int64_t>(rng.below(10));
    for (int t = 0; t < 2; ++t)
      ghost.core.push_back(
          core_base(BaseKind::kGaussian, {rng.uniform(10, 150) + 2 * t, rng.uniform(10, 110), 0.4, 50, 0}));
    start.push_back(ghost);
  }
  EXPECT_LT(track_share(scene, start), 0.75);
  SampleCablesOptions sampling;
  sampling.learn_sweeps = 16;
  const SampleCablesReport report = sample_cables(scene.pictures, start, prior_of(scene, start), sampling);
  EXPECT_GT(track_share(scene, report.cables), 0.95);
  EXPECT_GT(report.log_posterior_trace.back(), report.log_posterior_trace.front());
}

TEST(CableSampler, TheTraceIsThePosteriorAndThreadsDoNotMatter) {
  const Scene scene = make_scene({}, 6);
  const CablePrior prior = prior_of(scene, scene.truth);
  SampleCablesOptions options;
  options.sweeps = 9;
  JobContext one, two;
  one.jobs = 1;
  two.jobs = 2;
  const SampleCablesReport a = sample_cables(scene.pictures, scene.truth, prior, options, one),
                           b = sample_cables(scene.pictures, scene.truth, prior, options, two);
  EXPECT_EQ(a.log_posterior_trace, b.log_posterior_trace);
  EXPECT_NEAR(a.log_posterior_trace.back(), log_posterior_of(scene.pictures, a.cables, prior), 0.5);
  ASSERT_EQ(a.cables.size(), b.cables.size());
  for (std::size_t k = 0; k < a.cables.size(); ++k) {
    ASSERT_EQ(a.cables[k].core.size(), b.cables[k].core.size());
    EXPECT_EQ(a.cables[k].core.back().x, b.cables[k].core.back().x);
  }
  std::int64_t proposed = 0;
  for (const MoveCount& move : a.moves) {
    EXPECT_LE(move.accepted, move.proposed) << move.name;
    proposed += move.proposed;
  }
  EXPECT_GT(proposed, 10000);
}

/// Regression on raw detections finds far too little persistence; on samples, the truth, whatever it begins with.
TEST(CableSampler, PersistenceIsFoundFromAnyStart) {
  SceneOptions options;
  options.num_frames = 16;
  options.num_elements = 70;
  const Scene scene = make_scene(options, 12);
  const CablePrior exact = prior_of(scene, scene.truth);
  const double truth = 0.5 * (exact.dynamics.x.persistence() + exact.dynamics.y.persistence());
  EXPECT_NEAR(truth, 0.7, 0.05);
  Rng rng(2);
  std::vector<Cable> detected = scene.truth;
  for (Cable& cable : detected)
    for (Base& base : cable.core) {
      base.x += 0.4 * rng.normal();
      base.y += 0.4 * rng.normal();
    }
  EXPECT_LT(prior_of(scene, detected).dynamics.x.persistence(), 0.35);
  for (const double start : {0.0, 0.95}) {
    CablePrior prior = prior_of(scene, detected);
    for (CoordinateDynamics* line : {&prior.dynamics.x, &prior.dynamics.y}) {
      line->a = 1 + start;
      line->b = -start;
      line->c = (1 - start) * line->c0;
      line->d = 0.5;
    }
    SampleCablesOptions sampling;
    sampling.learn_sweeps = 20;
    const SampleCablesReport report = sample_cables(scene.pictures, detected, prior, sampling);
    const MovetonDynamics& learned = report.prior.dynamics;
    EXPECT_NEAR(0.5 * (learned.x.persistence() + learned.y.persistence()), 0.7, 0.05) << "from " << start;
    EXPECT_NEAR(learned.x.d, 0.25, 0.05);
    EXPECT_NEAR(learned.x.mean_velocity(), 2, 0.15);
  }
}

TEST(CableSampler, TheBackgroundIsSampledWithTheCables) {
  Scene scene = make_scene({}, 9);
  for (Plane& picture : scene.pictures)
    for (int y = 40; y < 80; ++y)
      for (int x = 40; x < 120; ++x) picture.at(x, y) += 6;
  SampleCablesOptions options;
  options.sweeps = 12;
  options.static_background = true;
  const SampleCablesReport report = sample_cables(scene.pictures, scene.truth, prior_of(scene, scene.truth), options);
  double inside = 0, outside = 0;
  for (int x = 0; x < 80; ++x) {
    inside += static_cast<double>(report.background_change.at(40 + x, 60)) / 80;
    outside += static_cast<double>(report.background_change.at(40 + x, 20)) / 80;
  }
  EXPECT_NEAR(inside, 6, 1);
  EXPECT_NEAR(outside, 0, 1);
}

/// Birds: dark bars, whose angles are sampled too.
TEST(CableSampler, OrientedDarkCoresAreSampled) {
  SceneOptions options;
  options.kind = BaseKind::kGaborCos;
  options.sign = -1;
  options.num_elements = 8;
  options.num_frames = 6;
  const Scene scene = make_scene(options, 21);
  Rng rng(3);
  std::vector<Cable> start = scene.truth;
  for (Cable& cable : start)
    for (Base& base : cable.core) {
      base.x += 0.4 * rng.normal();
      base.y += 0.4 * rng.normal();
      base.angle += 0.15 * rng.normal();
    }
  SampleCablesOptions sampling;
  sampling.sweeps = 16;
  sampling.search_sweeps = 4;
  sampling.learn_sweeps = 6;
  const CablePrior prior = prior_of(scene, start);
  EXPECT_EQ(prior.sign, -1);
  const SampleCablesReport report = sample_cables(scene.pictures, start, prior, sampling);
  const TrackingScore score = score_tracks(tracks_of(scene.truth, 1), tracks_of(report.cables, 1), 3);
  EXPECT_GT(score.jsc_tracks, 0.85);
  EXPECT_LT(score.rmse, 0.2);
}

/// Broken paths add false births and deaths; the caps keep the rates in bounds.
TEST(EstimatePrior, RatesAreCapped) {
  const Scene scene = make_scene({}, 2);
  std::vector<Cable> broken;
  for (const Cable& cable : scene.truth)
    for (std::int64_t t = cable.first_frame; t + 1 < cable.end_frame(); t += 2)
      broken.push_back({t, {cable.at(t), cable.at(t + 1)}, {}, -1, {}});
  const CablePrior prior = prior_of(scene, broken), whole = prior_of(scene, scene.truth);
  EXPECT_LE(prior.death_inside, 0.1);
  EXPECT_LT(whole.death_inside, 0.02);
  const double area = (160 + 2 * prior.margin) * (120 + 2 * prior.margin);
  EXPECT_LE(prior.births_inside * area, 0.1 * 45);
  EXPECT_LT(whole.births_inside * area, 0.3);
  EXPECT_NEAR(whole.dynamics.x.mean_velocity(), 2, 0.1);
  EXPECT_GT(whole.band_left, whole.band_right);
}

}  // namespace
}  // namespace motex
