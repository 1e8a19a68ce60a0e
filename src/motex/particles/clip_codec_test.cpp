// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/clip_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

QuantisedPath random_path(Rng& rng, int length, std::size_t num_kinds) {
  QuantisedPath path;
  path.kind = static_cast<BaseKind>(rng.below(num_kinds));
  path.precision = static_cast<std::int32_t>(rng.below(8)) + kFinestPlace;
  const double size = std::ldexp(1.0, -path.precision);
  const bool turns = is_oriented(path.kind);
  double x = rng.uniform(-30, 130), y = rng.uniform(-30, 110);
  const double vx = rng.uniform(-4, 4), vy = rng.uniform(-4, 4);
  for (int k = 0; k < length; ++k, x += vx, y += vy) {
    QuantisedState& state = path.states.emplace_back();
    state.x = static_cast<std::int32_t>(std::lround(x * size + rng.normal()));
    state.y = static_cast<std::int32_t>(std::lround(y * size + rng.normal()));
    state.scale = static_cast<std::int32_t>(rng.below(30)) - 4;
    state.luma = static_cast<std::int32_t>(std::lround(20 * rng.normal()));
    state.blue = static_cast<std::int32_t>(std::lround(2 * rng.normal()));
    state.red = static_cast<std::int32_t>(std::lround(2 * rng.normal()));
    if (turns) state.angle = static_cast<std::int32_t>(rng.below(90)) - 20;
  }
  return path;
}

QuantisedClip random_clip(std::uint64_t seed, int num_planes = 3, std::size_t num_kinds = kNumBaseKinds) {
  Rng rng(seed);
  QuantisedClip clip;
  clip.width = 101;
  clip.height = 67;
  clip.num_planes = num_planes;
  clip.num_frames = 12;
  clip.frames_per_sec = 29.97F;
  clip.coefficient_step = 7.5F;
  clip.background_step = 3;
  for (int k = 0; k < 60; ++k) {
    QuantisedCable& cable = clip.cables.emplace_back();
    cable.first_frame = static_cast<std::int64_t>(rng.below(12));
    const int length = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(12 - cable.first_frame)));
    cable.core = random_path(rng, length, num_kinds);
    for (std::uint64_t coil = rng.below(3); coil > 0; --coil)
      cable.coils.push_back(random_path(rng, length, num_kinds));
  }
  if (num_planes == 1)
    for (QuantisedCable& cable : clip.cables) {
      for (QuantisedState& state : cable.core.states) state.blue = state.red = 0;
      for (QuantisedPath& coil : cable.coils)
        for (QuantisedState& state : coil.states) state.blue = state.red = 0;
    }
  sort_for_coding(clip);
  return clip;
}

Planes slopes(const QuantisedClip& clip) {
  Planes planes;
  for (int k = 0; k < clip.num_planes; ++k) {
    Plane& plane = planes.emplace_back(clip.width, clip.height);
    for (int y = 0; y < clip.height; ++y)
      for (int x = 0; x < clip.width; ++x) plane.at(x, y) = static_cast<float>(50 + x + (k + 1) * std::sin(0.3 * y));
  }
  return planes;
}

TEST(ClipCodec, ReadsExactlyWhatWasWritten) {
  for (const int num_planes : {1, 3})
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const QuantisedClip clip = random_clip(seed, num_planes);
      const Planes background = slopes(clip);
      const std::string bytes = write_clip_bytes(clip, background);
      const QuantisedClip back = read_clip_bytes(bytes, "x");
      ASSERT_EQ(back.cables.size(), clip.cables.size());
      for (std::size_t k = 0; k < clip.cables.size(); ++k)
        ASSERT_TRUE(back.cables[k] == clip.cables[k]) << "cable " << k << " of seed " << seed;
      EXPECT_EQ(back.num_frames, 12);
      EXPECT_EQ(back.frames_per_sec, 29.97F);
      EXPECT_EQ(back.coefficient_step, 7.5F);
      EXPECT_GT(psnr(back.background, background), 46);
      EXPECT_EQ(write_clip_bytes(back, background), bytes);
    }
}

/// Readers before version 2 know four kinds and refuse what they do not know by its version.
TEST(ClipCodec, OnlyClipsWithStreaksAreVersionTwo) {
  for (const std::size_t num_kinds : {kNumBaseKinds - 1, kNumBaseKinds}) {
    const QuantisedClip clip = random_clip(4, 3, num_kinds);
    std::string bytes = write_clip_bytes(clip, slopes(clip));
    EXPECT_EQ(bytes[7], num_kinds == kNumBaseKinds ? 2 : 1);
    EXPECT_TRUE(read_clip_bytes(bytes, "x").cables == clip.cables);
    bytes[7] = 3;
    EXPECT_THROW(read_clip_bytes(bytes, "x"), UnsupportedFile);
  }
}

TEST(ClipCodec, AnEmptyClipIsABackground) {
  QuantisedClip clip = random_clip(1);
  clip.cables.clear();
  const QuantisedClip back = read_clip_bytes(write_clip_bytes(clip, slopes(clip)), "x");
  EXPECT_TRUE(back.cables.empty());
  EXPECT_EQ(back.num_frames, 12);
}

TEST(ClipCodec, SteadyFlightCostsAFewBits) {
  QuantisedClip clip = random_clip(1, 1);
  clip.cables.clear();
  clip.num_frames = 200;
  Rng rng(4);
  for (int k = 0; k < 50; ++k) {
    QuantisedCable& cable = clip.cables.emplace_back();
    double x = rng.uniform(0, 100), y = rng.uniform(0, 60);
    for (int t = 0; t < 200; ++t, x += 0.25, y += 0.5) {
      QuantisedState& state = cable.core.states.emplace_back();
      state.x = static_cast<std::int32_t>(std::lround(x + 0.3 * rng.normal()));
      state.y = static_cast<std::int32_t>(std::lround(y + 0.3 * rng.normal()));
      state.luma = 20;
    }
  }
  const double bits = 8.0 * static_cast<double>(write_clip_bytes(clip, slopes(clip)).size()) / (50 * 200);
  EXPECT_LT(bits, 5.5);
}

TEST(ClipCodec, DamagedBytesAreSaid) {
  const QuantisedClip clip = random_clip(2);
  const std::string whole = write_clip_bytes(clip, slopes(clip));
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 50)
    EXPECT_THROW(read_clip_bytes(whole.substr(0, size), "x"), ParseError) << size;
  for (std::size_t place = 0; place < whole.size(); place += 1 + whole.size() / 50) {
    std::string altered = whole;
    altered[place] = static_cast<char>(altered[place] ^ 0x41);
    EXPECT_THROW(read_clip_bytes(altered, "x"), InvalidInput) << place;
  }
}

TEST(ClipCodec, ForeignStreamsUnderARightChecksumEndOrAreSaid) {
  const QuantisedClip clip = random_clip(3);
  const std::string whole = write_clip_bytes(clip, slopes(clip));
  int num_refused = 0;
  for (std::size_t place = 40; place + 4 < whole.size(); place += 1 + whole.size() / 200) {
    std::string altered = whole;
    altered[place] = static_cast<char>(altered[place] ^ 0x3C);
    const std::uint32_t checksum = archive_checksum(std::string_view(altered).substr(0, altered.size() - 4));
    std::memcpy(altered.data() + altered.size() - 4, &checksum, 4);
    try {
      read_clip_bytes(altered, "x");
    } catch (const ParseError&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 50);
}

}  // namespace
}  // namespace motex
