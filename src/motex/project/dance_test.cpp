// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/dance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"
#include "motex/project/load_beats.h"

namespace motex {
namespace {

TEST(LoadBeats, BadTexts) {
  for (const char* text :
       {"", "# nothing\n\n", "time\n", "1\n1\n", "2\n1\n", "-1\n", "1\nx\n", "1\n2x\n", "nan\n3\n2\n"})
    EXPECT_THROW(parse_beats(text, "beats.txt"), InvalidInput) << text;
}

TEST(LoadBeats, FirstNumberOfEachLine) {
  EXPECT_EQ(parse_beats("secs,bar\r\n0.5,1\r\n# later\n 1.25; 2\n\n3", "x.csv"), (std::vector<double>{0.5, 1.25, 3}));
}

TEST(MakeDance, BadRequests) {
  DanceRequest request;
  request.num_frames = 100;
  request.speed = 5;
  EXPECT_THROW(make_dance(sample_model(), request, {}), InvalidInput);
  request.speed = 1;
  request.is_loop = true;
  request.path = {0};
  EXPECT_THROW(make_dance(sample_model(), request, {}), InvalidInput);
  request.path.clear();
  SynthesizeOptions options;
  options.beats = {1};
  EXPECT_THROW(make_dance(sample_model(), request, options), InvalidInput);
  EXPECT_THROW(make_dances(sample_model(), request, {}, 0), InvalidInput);
}

TEST(MakeDance, AtAnySpeedItIsTheSameMotion) {
  DanceRequest request;
  request.num_frames = 401;
  const Dance own = make_dance(sample_model(), request, {});
  request.speed = 2;
  request.num_frames = 201;
  const Dance fast = make_dance(sample_model(), request, {});
  ASSERT_EQ(fast.clip.num_frames(), 201);
  EXPECT_EQ(fast.clip.rotations.row(50), own.clip.rotations.row(100));
  EXPECT_EQ(fast.report.played[1].start, (own.report.played[1].start + 1) / 2);
  request.speed = 0.25;
  request.num_frames = 300;
  EXPECT_EQ(make_dance(sample_model(), request, {}).clip.num_frames(), 300);
}

TEST(MakeDance, BeatsAreThoseOfTheClipThatComesOut) {
  SynthesizeOptions options;
  for (int i = 1; i < 40; ++i) options.beats.push_back(0.6 * i);
  DanceRequest request;
  request.num_frames = 1200;
  request.speed = 0.8;
  const Dance dance = make_dance(sample_model(), request, options);
  int num_on_beat = 0, num_begun = 0;
  for (const PlayedTexton& played : dance.report.played) {
    if (played.start == 0) continue;
    const double beats = static_cast<double>(played.start) / 60 / 0.6;
    num_on_beat += std::abs(beats - std::round(beats)) * 0.6 * 60 <= 1.5;
    ++num_begun;
  }
  EXPECT_GE(num_begun, 5);
  EXPECT_EQ(num_on_beat, num_begun);
  EXPECT_LE(dance.beats.median_offset, 1);
}

TEST(MakeDances, TheSameForAnyNumberOfThreadsAndDifferentFromOneAnother) {
  DanceRequest request;
  request.num_frames = 200;
  JobContext one, three;
  one.jobs = 1;
  three.jobs = 3;
  SynthesizeOptions options;
  options.seed = 5;
  const auto a = make_dances(sample_model(), request, options, 4, one);
  const auto b = make_dances(sample_model(), request, options, 4, three);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(a[k].clip.rotations, b[k].clip.rotations);
    EXPECT_EQ(a[k].seed, 5 + k);
    for (std::size_t i = 0; i < k; ++i) EXPECT_NE(a[k].clip.rotations, a[i].clip.rotations);
  }
  options.seed = 7;
  EXPECT_EQ(make_dance(sample_model(), request, options).clip.rotations, a[2].clip.rotations);
}

}  // namespace
}  // namespace motex
