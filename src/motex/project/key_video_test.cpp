// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/key_video.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

class KeyVideo : public testing::Test {
 protected:
  KeyVideo()
      : folder_(fs::path(testing::TempDir()) /
                ("motex_key_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::create_directories(folder_);
  }
  ~KeyVideo() override {
    std::error_code ec;
    fs::remove_all(folder_, ec);
  }

  /// A red block before green; odd sides; nobody when there is no block.
  fs::path write_clip(const std::string& name, int count, bool block = true) const {
    VideoWriter writer(folder_ / name, 95, 71);
    for (int t = 0; t < count; ++t) {
      Image image(95, 71, {40, 180, 60, 255});
      const int left = 35 + static_cast<int>(18 * std::sin(0.6 * t));
      for (int y = 20; block && y < 60; ++y)
        for (int x = left; x < left + 20; ++x) image.at(x, y) = {180, 40, 60, 255};
      writer.write(image);
    }
    writer.finish();
    return folder_ / name;
  }

  fs::path folder_;
};

TEST_F(KeyVideo, WritesAlphaAndACompositeTogether) {
  const fs::path clip = write_clip("take.mkv", 20), keyed = folder_ / "keyed.mkv";
  const KeyVideoReport report = key_video(clip, {}, nullptr, {keyed});
  EXPECT_EQ(report.footage.num_frames, 20);
  EXPECT_EQ(report.plate->kind, ScreenKind::kGreen);
  VideoReader reader(keyed);
  VideoFrame frame;
  ASSERT_TRUE(reader.next(frame));
  EXPECT_EQ(frame.image.at(45, 40), (Rgba{180, 40, 60, 255}));
  EXPECT_EQ(frame.image.at(5, 5).a, 0);
  EXPECT_EQ(frame.image.at(32, 40).a, 0);
  EXPECT_GT(frame.image.at(32, 40).r, 100) << "colours go on beyond the outline";

  Backdrop backdrop({0, 0, 255, 255}, 95, 71);
  key_video(clip, {}, &backdrop, {folder_ / "shown.mkv"});
  VideoReader shown(folder_ / "shown.mkv");
  ASSERT_TRUE(shown.next(frame));
  EXPECT_EQ(frame.image.at(5, 5), (Rgba{0, 0, 255, 255}));
  EXPECT_EQ(frame.image.at(45, 40), (Rgba{180, 40, 60, 255}));
}

TEST_F(KeyVideo, FootageWithAlphaIsTakenAsItIs) {
  const fs::path keyed = folder_ / "keyed.mkv", again = folder_ / "again.mkv";
  key_video(write_clip("take.mkv", 12), {}, nullptr, {keyed});
  EXPECT_TRUE(key_video(keyed, {}, nullptr, {again}).had_alpha);
}

TEST_F(KeyVideo, NobodyIsAnErrorAndNothingIsWritten) {
  EXPECT_THROW(key_video(write_clip("empty.mkv", 12, false), {}, nullptr, {folder_ / "keyed.mkv"}), InvalidInput);
  EXPECT_FALSE(fs::exists(folder_ / "keyed.mkv"));
}

TEST_F(KeyVideo, ThreeFramesBeforeAScreenAreEnough) {
  EXPECT_EQ(key_video(write_clip("three.mkv", 3), {}, nullptr, {folder_ / "keyed.mkv"}).footage.num_frames, 3);
}

/// Frames of a red block that moves before a colour; the folder's clip gets all shots one after another.
struct Shot {
  Rgba screen;
  int count = 0;
  bool restless = false;  // nothing in it stays as it is
};

fs::path write_shots(const fs::path& path, const std::vector<Shot>& shots) {
  VideoWriter writer(path, 95, 71);
  int t = 0;
  for (const Shot& shot : shots) {
    for (int k = 0; k < shot.count; ++k, ++t) {
      Image image(95, 71, shot.screen);
      for (int y = 0; shot.restless && y < 71; ++y)
        for (int x = 0; x < 95; ++x) {
          const auto hash = static_cast<std::uint32_t>((x + 5 * k) / 6 * 7919 + y / 6 * 104729) * 2654435761U;
          image.at(x, y) = {static_cast<std::uint8_t>(hash >> 24U), static_cast<std::uint8_t>(hash >> 16U),
                            static_cast<std::uint8_t>(hash >> 8U), 255};
        }
      const int left = 35 + static_cast<int>(18 * std::sin(0.6 * t));
      for (int y = 20; y < 60; ++y)
        for (int x = left; x < left + 20; ++x) image.at(x, y) = {180, 40, 60, 255};
      writer.write(image);
    }
  }
  writer.finish();
  return path;
}

constexpr Rgba kGreen{40, 180, 60, 255}, kBlue{40, 70, 190, 255};

TEST_F(KeyVideo, EveryShotIsKeyedByItsOwnBackground) {
  const fs::path clip = write_shots(folder_ / "cut.mkv", {{kGreen, 20}, {kBlue, 20}, {kGreen, 20}});
  KeyedFootage footage(clip);
  ASSERT_EQ(footage.shots().shots.size(), 3U);
  int count = 0;
  for (KeyedFrame frame; footage.next(frame); ++count) {
    EXPECT_EQ(frame.idx, count);
    EXPECT_EQ(frame.shot, count / 20);
    EXPECT_EQ(frame.sprite.left, 35 + static_cast<int>(18 * std::sin(0.6 * count)));
    EXPECT_EQ(frame.sprite.width, 20);
    EXPECT_EQ(frame.sprite.top, 20);
  }
  EXPECT_EQ(count, 60);
  EXPECT_EQ(footage.plate()->kind, ScreenKind::kGreen);
}

TEST_F(KeyVideo, AShotThatCannotBeKeyedIsSaidAndEmpty) {
  const fs::path clip = write_shots(folder_ / "cut.mkv", {{kGreen, 20}, {kBlue, 20, true}});
  std::string warnings;
  JobContext job;
  job.on_warning = [&](const std::string& warning) { warnings += warning; };
  KeyedFootage footage(clip, {}, job);
  int count = 0;
  for (KeyedFrame frame; footage.next(frame); ++count) EXPECT_EQ(frame.sprite.empty(), frame.idx >= 20) << frame.idx;
  EXPECT_EQ(count, 40);
  EXPECT_NE(warnings.find("frames 20 to 39"), std::string::npos) << warnings;
  EXPECT_THROW(KeyedFootage(write_shots(folder_ / "moving.mkv", {{kBlue, 20, true}})), InvalidInput);
}

/// A block before leaves that do not move; it crosses the picture, or sways in one place.
fs::path write_natural(const fs::path& path, bool crosses) {
  VideoWriter writer(path, 95, 71);
  for (int t = 0; t < 24; ++t) {
    Image image(95, 71);
    for (int y = 0; y < 71; ++y)
      for (int x = 0; x < 95; ++x) {
        const auto hash = static_cast<std::uint32_t>(x / 4 * 7919 + y / 4 * 104729) * 2654435761U;
        const auto level = static_cast<std::uint8_t>(hash >> 24U);
        image.at(x, y) = {level, static_cast<std::uint8_t>(255 - level), level, 255};
      }
    const int left = crosses ? 3 * t : 40 + static_cast<int>(4 * std::sin(0.6 * t));
    for (int y = 20; y < 60; ++y)
      for (int x = left; x < left + 20; ++x) image.at(x, y) = {180, 40, 60, 255};
    writer.write(image);
  }
  writer.finish();
  return path;
}

TEST_F(KeyVideo, AnActorWhoNeverLeavesHisPlaceInANaturalSceneIsSaid) {
  KeyFootageOptions options;
  options.plate.screen = BackgroundChoice::kNatural;
  for (const bool crosses : {true, false}) {
    std::string warnings;
    JobContext job;
    job.on_warning = [&](const std::string& warning) { warnings += warning; };
    KeyedFootage footage(write_natural(folder_ / "natural.mkv", crosses), options, job);
    for (KeyedFrame frame; footage.next(frame);) {
    }
    EXPECT_EQ(warnings.find("--plate") != std::string::npos, !crosses) << warnings;
  }
}

TEST_F(KeyVideo, APartOfTheVideoAlone) {
  KeyFootageOptions options;
  options.frames = {7, 9};
  KeyedFootage footage(write_clip("take.mkv", 24), options);
  int count = 0;
  for (KeyedFrame frame; footage.next(frame); ++count) EXPECT_EQ(frame.idx, 7 + count);
  EXPECT_EQ(count, 9);
}

TEST_F(KeyVideo, TheNumberOfThreadsDoesNotMatter) {
  const fs::path clip = write_clip("take.mkv", 12);
  JobContext one, three;
  one.jobs = 1, three.jobs = 3;
  KeyedFootage a(clip, {}, one), b(clip, {}, three);
  for (KeyedFrame x, y; a.next(x) && b.next(y);) EXPECT_EQ(x.sprite.pixels, y.sprite.pixels);
}

TEST(Backdrop, IsCutToTheShapeOfTheFrame) {
  Image picture(40, 10, {0, 0, 0, 255});
  for (int y = 0; y < 10; ++y)
    for (int x = 15; x < 25; ++x) picture.at(x, y) = {250, 250, 250, 255};
  const Image cut = fitted(picture, 20, 20);
  EXPECT_EQ(cut.width, 20);
  EXPECT_EQ(cut.at(0, 0).r, 250);
  EXPECT_EQ(cut.at(19, 19).r, 250);
}

}  // namespace
}  // namespace motex
