// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/people_footage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/project/signal_plot.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 200, kHeight = 120;

/// Films before a green screen in a folder of their own.
class ReadPeopleFootage : public testing::Test {
 protected:
  ReadPeopleFootage()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("people_footage_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~ReadPeopleFootage() override { fs::remove_all(folder_); }

  /// draw: puts people into frame t.
  fs::path film(int num_frames, const std::function<void(Image&, int)>& draw) {
    fs::path path = folder_ / "film.mkv";
    VideoWriter writer(path, kWidth, kHeight, {25});
    Rng rng(7);
    for (int t = 0; t < num_frames; ++t) {
      Image image(kWidth, kHeight, {40, 170, 60, 255});
      draw(image, t);
      for (Rgba& pixel : image.pixels)
        for (std::uint8_t* level : {&pixel.r, &pixel.g, &pixel.b})
          *level = static_cast<std::uint8_t>(std::clamp(*level + 1.5 * rng.normal(), 0.0, 255.0));
      writer.write(image);
    }
    writer.finish();
    return path;
  }

  JobContext listening() {
    JobContext job;
    job.on_warning = [this](const std::string& warning) { warnings_ += warning + "\n"; };
    return job;
  }

  fs::path folder_;
  std::string warnings_;
};

void stand(Image& image, int left, int width = 24) {
  for (int y = 25; y < 110; ++y)
    for (int x = left; x < left + width; ++x) image.at(x, y) = {150, 70, 60, 255};
}

int swing(int t) { return static_cast<int>(std::lround(12 * std::sin(0.3 * t))); }

TEST_F(ReadPeopleFootage, EachShotIsATakeAndTheCutIsSaid) {
  const fs::path path = film(70, [](Image& image, int t) { stand(image, t < 30 ? 40 + swing(t) : 130 - swing(t)); });
  std::map<int, int> told;
  const PeopleFootage footage = read_people_footage(
      path, {}, [&](int track, int, const Sprite&) { ++told[track]; }, listening());
  ASSERT_EQ(footage.takes.size(), 2U);
  EXPECT_EQ(footage.takes[1].take.source_start, 30);
  EXPECT_EQ(footage.takes[1].take.frames, (FrameSpan{30, 40}));
  EXPECT_NEAR(footage.takes[0].silhouettes[3].box.left, 40 + swing(3), 1);
  EXPECT_EQ(told[footage.takes[1].track], 40);
  EXPECT_NE(warnings_.find("cut at frame 30"), std::string::npos) << warnings_;
}

TEST_F(ReadPeopleFootage, TwoPeopleAreTwoTakesFromTheLeft) {
  const fs::path path = film(40, [](Image& image, int t) {
    stand(image, 130 + swing(t));
    stand(image, 40 - swing(t), 20);
  });
  const PeopleFootage footage = read_people_footage(path);
  ASSERT_EQ(footage.takes.size(), 2U);
  EXPECT_EQ(footage.takes[0].take.person, 0);
  EXPECT_EQ(footage.takes[1].take.person, 1);
  EXPECT_NEAR(footage.takes[0].silhouettes[5].box.width(), 20, 2);
  const PeopleTexture texture = people_texture_of(footage);
  EXPECT_EQ(texture.num_frames(), 80);
  const std::string table = signals_csv(texture, measure_signals(texture));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 81);
  EXPECT_NE(table.find("\n40,film.mkv,0,1,0,1,"), std::string::npos);
}

TEST_F(ReadPeopleFootage, NobodyAndTooFewFramesAreRefused) {
  const fs::path empty = film(30, [](Image&, int) {});
  EXPECT_THROW(read_people_footage(empty), InvalidInput);
  const fs::path brief = film(3, [](Image& image, int t) { stand(image, 40 + 5 * t); });
  try {
    read_people_footage(brief);
    FAIL() << "three frames are too few";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("3 frames"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace motex
