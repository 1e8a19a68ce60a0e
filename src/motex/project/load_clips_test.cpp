// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/load_clips.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "motex/motion/stick_figure.h"
#include "motex/motion_io/clip_io.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

class LoadClips : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("motex_load_clips_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write_walk(const std::string& name, double frame_rate) const {
    StickFigureOptions options;
    options.num_frames = 60;
    options.frame_rate = frame_rate;
    write_clip(folder_ / name, walk_stick_figure(options).clip);
    return folder_ / name;
  }

  fs::path folder_;
};

TEST_F(LoadClips, EmptyFolderIsNamed) {
  try {
    load_clips({folder_});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos);
  }
}

TEST_F(LoadClips, ErrorIsThatOfTheFirstBadFile) {
  const fs::path good = write_walk("a.bvh", 60);
  for (int i = 0; i < 5; ++i) {
    try {
      load_clips({good, folder_ / "first.bvh", good, folder_ / "second.bvh"});
      FAIL();
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("first.bvh"), std::string::npos) << error.what();
    }
  }
}

TEST_F(LoadClips, FolderGivesItsClipsByName) {
  write_walk("b.bvh", 60);
  write_walk("a.glb", 60);
  const fs::path last = write_walk("0.bvh", 60);
  write_walk("notes.csv", 60);
  fs::create_directories(folder_ / "inner.bvh");
  EXPECT_EQ(find_clip_files({folder_, last}),
            (std::vector<fs::path>{folder_ / "0.bvh", folder_ / "a.glb", folder_ / "b.bvh", last}));
}

TEST_F(LoadClips, RatesBecomeTheLowestAndItIsSaid) {
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  const auto clips = load_clips({write_walk("fast.bvh", 120), write_walk("slow.bvh", 30)}, {}, job);
  ASSERT_EQ(clips.size(), 2U);
  EXPECT_EQ(clips[0].name, "fast");
  EXPECT_NEAR(clips[0].frame_rate(), 30, 1e-3);
  EXPECT_NEAR(clips[1].frame_rate(), 30, 1e-3);
  EXPECT_EQ(warnings.size(), 1U);
}

TEST_F(LoadClips, StopsWhenTold) {
  const std::atomic<bool> cancel = true;
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(load_clips({write_walk("a.bvh", 60)}, {}, job), Cancelled);
}

}  // namespace
}  // namespace motex
