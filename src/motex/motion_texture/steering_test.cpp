// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/steering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "motex/core/error.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;

const MotionTexture& model() { return sample_model(); }

Clip play(SteeredSynthesizer& stream, Index frames) {
  Clip clip = make_output_clip(model(), frames);
  for (Index t = 0; t < frames; ++t) stream.next(clip, t);
  return clip;
}

RootPlace place(const Clip& clip, Index frame) { return root_place(model().features, clip, frame); }

/// Angle between the way from frame a to frame b and the wanted one.
double way_error(const Clip& clip, Index a, Index b, double direction) {
  const RootPlace from = place(clip, a), to = place(clip, b);
  return std::abs(std::remainder(std::atan2(to.x - from.x, to.z - from.z) - direction, 2 * kPi));
}

double largest_step(const Clip& clip) {
  const FrameMatrix p = world_positions(clip);
  return (p.bottomRows(p.rows() - 1) - p.topRows(p.rows() - 1)).cwiseAbs().maxCoeff();
}

TEST(Steering, ExcursionIsWhatTheExampleDoes) {
  for (const int i : {0, 3}) {
    const Instance& a = model().instances[static_cast<std::size_t>(i)];
    const Index length = hand_over_row(model(), a) + 2 - a.row;
    const Clip clip = decode(model().features, model().corpus.middleRows(a.row, length).cast<double>());
    const Excursion way = excursion(model(), i);
    const RootPlace end = place(clip, length - 1);
    EXPECT_NEAR(way.x, end.x, 1e-3);
    EXPECT_NEAR(way.z, end.z, 1e-3);
    EXPECT_NEAR(std::remainder(way.turn - end.heading, 2 * kPi), 0, 1e-5);
    EXPECT_NEAR(way.secs, static_cast<double>(length - 1) / 60, 1e-9);
  }
}

TEST(Steering, GoesWhereItIsSent) {
  for (const double direction : {-3.0, -1.5, 0.4, 2.2}) {
    SteeredSynthesizer stream(model(), {});
    play(stream, 120);
    Steering steering;
    steering.direction = direction;
    stream.steer(steering);
    const Clip clip = play(stream, 900);
    EXPECT_LT(way_error(clip, 420, 899, direction), 0.35) << direction;
    check_clip(clip);
  }
}

TEST(Steering, FacesWhereItIsTold) {
  SteeredSynthesizer stream(model(), {});
  Steering steering;
  steering.facing = 2;
  stream.steer(steering);
  const Clip clip = play(stream, 900);
  double sum = 0;
  for (Index t = 480; t < 900; ++t) sum += std::abs(std::remainder(place(clip, t).heading - 2, 2 * kPi));
  EXPECT_LT(sum / 420, 0.6);
}

TEST(Steering, TurnsGentlyAndWithoutASeam) {
  SteeredSynthesizer free(model(), {}), steered(model(), {});
  const double usual = largest_step(play(free, 1200));
  Clip clip = make_output_clip(model(), 1200);
  for (Index t = 0; t < 1200; ++t) {
    if (t % 50 == 0) {
      Steering steering;
      steering.direction = static_cast<double>(t % 7);
      steered.steer(steering);
    }
    steered.next(clip, t);
  }
  EXPECT_LT(largest_step(clip), 1.5 * usual);
}

TEST(Steering, ARequestedTextonIsPlayedSoon) {
  for (int texton = 0; texton < static_cast<int>(model().textons.size()); ++texton) {
    SteeredSynthesizer stream(model(), {});
    play(stream, 100);
    stream.take_played();
    stream.request(texton);
    play(stream, 600);
    const auto played = stream.take_played();
    EXPECT_TRUE(std::any_of(played.begin(), played.end(), [&](const PlayedTexton& p) { return p.texton == texton; }))
        << texton;
  }
}

TEST(Steering, AFasterPaceShortensTextons) {
  const auto count = [](double pace) {
    SteeredSynthesizer stream(model(), {});
    Steering steering;
    steering.pace = pace;
    stream.steer(steering);
    play(stream, 6000);
    return static_cast<double>(stream.take_played().size());
  };
  EXPECT_GT(count(1.25) / count(0.8), 1.2);
}

TEST(Steering, SameCommandsSameFrames) {
  const auto once = [] {
    SteeredSynthesizer stream(model(), {});
    Clip clip = make_output_clip(model(), 400);
    Steering steering;
    steering.direction = 1;
    steering.speed = 0.7;
    for (Index t = 0; t < 400; ++t) {
      if (t == 77) stream.steer(steering);
      if (t == 200) stream.request(0);
      stream.next(clip, t);
    }
    return clip;
  };
  const Clip a = once(), b = once();
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.translations, b.translations);
}

TEST(Steering, BadCommands) {
  SteeredSynthesizer stream(model(), {});
  Steering steering;
  steering.direction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(stream.steer(steering), InvalidInput);
  steering = {};
  steering.speed = -1;
  EXPECT_THROW(stream.steer(steering), InvalidInput);
  steering = {};
  steering.pace = 2;
  EXPECT_THROW(stream.steer(steering), InvalidInput);
  EXPECT_THROW(stream.request(static_cast<int>(model().textons.size())), InvalidInput);
  EXPECT_THROW(stream.request(-1), InvalidInput);
  SteerOptions options;
  options.max_turn = -1;
  EXPECT_THROW(SteeredSynthesizer(model(), {}, options), InvalidInput);
}

}  // namespace
}  // namespace motex
