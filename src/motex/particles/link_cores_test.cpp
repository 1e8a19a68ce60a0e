// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/link_cores.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/track_score.h"

namespace motex {
namespace {

struct Walk {
  double vx = 1.5, vy = 5, persistence = 0.9, step = 0.35, start = 0.8, noise = 0.3, missed = 0.05;
  int per_frame = 60, num_frames = 60, width = 200, height = 160;
};

struct Scene {
  std::vector<Track> truth;
  std::vector<std::vector<TrackPoint>> seen;
};

/// Elements that enter everywhere around the picture and drift through it.
Scene scene_of(const Walk& w, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  scene.seen.resize(static_cast<std::size_t>(w.num_frames));
  struct Element {
    double x, y, vx, vy;
    Track track;
  };
  std::vector<Element> alive;
  const double margin = 24;
  const auto is_near = [&](const Element& e) {
    return e.x > -margin && e.y > -margin && e.x < w.width + margin && e.y < w.height + margin;
  };
  const double area = (w.width + 2 * margin) * (w.height + 2 * margin);
  const auto population = static_cast<std::size_t>(w.per_frame * area / (w.width * w.height));
  for (int t = -60; t < w.num_frames; ++t) {
    while (alive.size() < population) {
      Element e{rng.uniform(-margin, w.width + margin),
                rng.uniform(-margin, w.height + margin),
                w.vx + w.start * rng.normal(),
                w.vy + w.start * rng.normal(),
                {}};
      if (t > -60) (rng.uniform() < 0.75 ? e.y : e.x) = -margin + 1;
      alive.push_back(e);
    }
    std::vector<Element> next;
    for (Element& e : alive) {
      const bool is_inside = e.x > -0.5 && e.y > -0.5 && e.x < w.width - 0.5 && e.y < w.height - 0.5;
      if (t >= 0 && is_inside) {
        e.track.points.push_back({t, e.x, e.y, 1, 0, 1});
        if (rng.uniform() >= w.missed)
          scene.seen[static_cast<std::size_t>(t)].push_back(
              {t, e.x + w.noise * rng.normal(), e.y + w.noise * rng.normal(), 1, 0, 1});
      }
      e.vx = w.vx + w.persistence * (e.vx - w.vx) + w.step * rng.normal();
      e.vy = w.vy + w.persistence * (e.vy - w.vy) + w.step * rng.normal();
      e.x += e.vx;
      e.y += e.vy;
      if (is_near(e) && t + 1 < w.num_frames) {
        next.push_back(e);
      } else if (!e.track.points.empty()) {
        scene.truth.push_back(e.track);
      }
    }
    alive = std::move(next);
  }
  for (std::size_t k = 0; k < scene.truth.size(); ++k) scene.truth[k].id = static_cast<std::int64_t>(k);
  return scene;
}

TEST(LinkCores, RefusesWhatIsNoNumber) {
  EXPECT_THROW(link_points({{{0, std::nan(""), 1, 1, 0, 1}}}, 10, 10), InvalidInput);
  EXPECT_THROW(link_cores({{Base{BaseKind::kGaussian, 1, std::numeric_limits<double>::infinity(), 1, 0, {}}}}, 10, 10),
               InvalidInput);
  EXPECT_TRUE(link_points({}, 10, 10).empty());
  EXPECT_TRUE(link_points({{}, {}, {}}, 10, 10).empty());
  EXPECT_EQ(link_points({{{0, 5, 5, 1, 0, 1}}}, 10, 10).size(), 1U) << "one frame: everything is at both of its ends";
}

TEST(LinkCores, LearnsFlowPersistenceAndNoise) {
  const Walk walk;
  const Scene scene = scene_of(walk, 1);
  LinkReport report;
  const std::vector<Track> tracks = link_points(scene.seen, walk.width, walk.height, {}, &report);
  EXPECT_TRUE(report.flow.is_trusted);
  EXPECT_NEAR(report.flow.flow.vx, walk.vx, 0.3);
  EXPECT_NEAR(report.flow.flow.vy, walk.vy, 0.3);
  EXPECT_NEAR(report.model.y.persistence, walk.persistence, 0.05);
  EXPECT_NEAR(std::sqrt(report.model.x.step_variance), walk.step, 0.06);
  EXPECT_NEAR(std::sqrt(report.model.x.noise_variance), walk.noise, 0.06);
  EXPECT_NEAR(report.model.seen, 1 - walk.missed, 0.03);
  const TrackingScore score = score_tracks(scene.truth, visible_part(tracks, walk.width, walk.height));
  EXPECT_GT(score.beta, 0.92);
  EXPECT_GT(score.jsc_tracks, 0.93);
  EXPECT_LT(report.expected_wrong_share, 0.02);
}

TEST(LinkCores, ASceneWithoutFlowIsLinkedToo) {
  Walk walk;
  walk.vx = walk.vy = 0;
  walk.start = 1.5;
  walk.per_frame = 25;
  const Scene scene = scene_of(walk, 2);
  const std::vector<Track> tracks = link_points(scene.seen, walk.width, walk.height);
  EXPECT_GT(score_tracks(scene.truth, visible_part(tracks, walk.width, walk.height)).beta, 0.85);
}

TEST(LinkCores, FilledGapsLieOnThePath) {
  std::vector<std::vector<TrackPoint>> frames(20);
  for (int t = 0; t < 20; ++t)
    for (int k = 0; k < 4; ++k)
      if (t < 8 || t > 9 || k > 0)
        frames[static_cast<std::size_t>(t)].push_back({t, 20.0 + 3 * t, 20.0 + 30 * k + 0.5 * t, 1.5, 0, 50});
  LinkReport report;
  const std::vector<Track> tracks = link_points(frames, 200, 160, {}, &report);
  ASSERT_EQ(tracks.size(), 4U);
  EXPECT_EQ(report.num_filled, 2);
  for (const Track& track : tracks) {
    ASSERT_EQ(track.points.size(), 20U);
    for (const TrackPoint& point : track.points) EXPECT_NEAR(point.x, 20.0 + 3 * static_cast<double>(point.frame), 0.3);
  }
}

TEST(LinkCores, ShortPathsInTheMiddleAreDropped) {
  Walk walk;
  walk.per_frame = 20;
  Scene scene = scene_of(walk, 3);
  Rng rng(4);
  for (auto& frame : scene.seen)
    frame.push_back({0, rng.uniform(30, walk.width - 30), rng.uniform(30, walk.height - 30), 1, 0, 1});
  LinkReport report;
  const std::vector<Track> tracks = link_points(scene.seen, walk.width, walk.height, {}, &report);
  EXPECT_GT(report.num_dropped, 40);
  EXPECT_GT(score_tracks(scene.truth, visible_part(tracks, walk.width, walk.height)).beta, 0.88);
}

TEST(LinkCores, SaysHowUnsureItIs) {
  Walk dense, sparse;
  dense.per_frame = 900;
  dense.num_frames = 12;
  sparse.num_frames = 12;
  LinkReport of_dense, of_sparse;
  const Scene many = scene_of(dense, 5);
  const std::vector<Track> tracks = link_points(many.seen, dense.width, dense.height, {}, &of_dense);
  link_points(scene_of(sparse, 5).seen, sparse.width, sparse.height, {}, &of_sparse);
  EXPECT_GT(of_dense.expected_wrong_share, 3 * of_sparse.expected_wrong_share);
  EXPECT_LT(of_dense.flow.flow.peak_ratio, of_sparse.flow.flow.peak_ratio);
  EXPECT_EQ(of_dense.confidences.size(), tracks.size());
}

TEST(LinkCores, AmplitudesTellCrossingElementsApart) {
  // Two that meet at the same place in frame 10, and turn back: by places alone they would pass through each other.
  std::vector<std::vector<TrackPoint>> frames(21);
  for (int t = 0; t <= 20; ++t)
    for (int side = 0; side < 2; ++side) {
      const double away = std::abs(t - 10) * 1.0 + 0.6;
      frames[static_cast<std::size_t>(t)].push_back(
          {t, 50 + (side == 0 ? -away : away), 20 + 3.0 * t, side == 0 ? 1.2 : 2.4, 0, side == 0 ? 40.0 : 150.0});
    }
  // others, from which the levels' spread is learned
  Rng rng(6);
  for (int k = 0; k < 12; ++k) {
    const double x = 100 + 12 * k, amplitude = rng.uniform(40, 150), scale = rng.uniform(1.2, 2.4);
    for (int t = 0; t <= 20; ++t)
      frames[static_cast<std::size_t>(t)].push_back({t, x + 0.2 * rng.normal(), 20 + 3.0 * t + 0.2 * rng.normal(),
                                                     scale * std::exp(0.03 * rng.normal()), 0,
                                                     amplitude * std::exp(0.03 * rng.normal())});
  }
  for (const Track& track : link_points(frames, 300, 120))
    for (const TrackPoint& point : track.points)
      EXPECT_LT(std::abs(std::log(point.amplitude / track.points[0].amplitude)), 0.5);
}

TEST(LinkPoints, CanBeStopped) {
  const std::atomic<bool> stop{true};
  JobContext job;
  job.cancel = &stop;
  std::vector<std::vector<TrackPoint>> frames(3);
  for (std::size_t t = 0; t < frames.size(); ++t) frames[t].push_back({static_cast<int>(t), 10 + 2.0 * t, 20});
  EXPECT_THROW(link_points(frames, 64, 48, {}, nullptr, job), Cancelled);
}

}  // namespace
}  // namespace motex
