// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/learn_people.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "motex/core/error.h"
#include "motex/project/crowd.h"
#include "motex/project/simulate_actor.h"
#include "motex/project/sprite_atlas.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

/// Films of a simulated actor in a folder of their own.
class LearnPeople : public testing::Test {
 protected:
  LearnPeople()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("learn_people_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
    options_.frames = 560;
    options_.width = 240;
    options_.height = 160;
    options_.actions = "left_kick,bow";
    options_.repetitions = 4;
  }
  ~LearnPeople() override { fs::remove_all(folder_); }

  fs::path film(const std::string& name) {
    const ActorSimulation simulation(options_);
    fs::path path = folder_ / name;
    VideoWriter writer(path, options_.width, options_.height, {options_.frames_per_sec});
    for (int t = 0; t < options_.frames; ++t) writer.write(simulation.frame(t).image);
    writer.finish();
    return path;
  }

  fs::path folder_;
  SimulateActorOptions options_;
};

double likeness(const Sprite& truth, const Sprite& got, int width, int height) {
  const Image a = to_image(truth, width, height), b = to_image(got, width, height);
  int both = 0, either = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k) {
    both += a.pixels[k].a >= 128 && b.pixels[k].a >= 128;
    either += a.pixels[k].a >= 128 || b.pixels[k].a >= 128;
  }
  return static_cast<double>(both) / either;
}

TEST_F(LearnPeople, NothingToLearnFromIsAnError) {
  EXPECT_THROW(learn_people({}), InvalidInput);
  options_.frames = 3;
  options_.repetitions = 0;
  EXPECT_THROW(learn_people({film("short.mkv")}), InvalidInput);
}

TEST_F(LearnPeople, ClipsMustAgree) {
  options_.frames = 60;
  options_.repetitions = 0;
  const fs::path one = film("one.mkv");
  options_.frames_per_sec = 15;
  const fs::path other = film("other.mkv");
  try {
    learn_people({one, other});
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("30"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("15"), std::string::npos) << error.what();
  }
}

TEST_F(LearnPeople, ClipsOfAnotherSizeAreScaled) {
  options_.frames = 60;
  options_.repetitions = 0;
  const fs::path one = film("one.mkv");
  options_.width = 120, options_.height = 90;
  const fs::path other = film("other.mkv");
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const PeopleTexture texture = learn_people({one, other}, {}, {}, {}, {}, job).model.texture;
  ASSERT_EQ(texture.takes.size(), 2U);
  EXPECT_EQ(texture.width, 240);
  const auto tallest = [&](const Take& take) {
    int height = 0;
    for (int t = take.frames.start; t < take.frames.end(); ++t)
      height = std::max(height, texture.silhouettes[static_cast<std::size_t>(t)].box.height());
    return height;
  };
  EXPECT_NEAR(tallest(texture.takes[0]), tallest(texture.takes[1]), 0.06 * tallest(texture.takes[0]));
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(),
                          [](const std::string& text) { return text.find("120 × 90") != std::string::npos; }));
}

TEST(ParseCues, OneLineAPerson) {
  const std::vector<Cue> cues = parse_cues("# who comes\n0\n\n 1.5 stand 2s, high kick x2 # late\r\n", "c.txt");
  ASSERT_EQ(cues.size(), 2U);
  EXPECT_EQ(cues[0].start_secs, 0);
  EXPECT_EQ(cues[0].script, "");
  EXPECT_EQ(cues[1].start_secs, 1.5);
  EXPECT_EQ(cues[1].script, "stand 2s, high kick x2");
  EXPECT_THROW(parse_cues("1\nbow\n", "c.txt"), ParseError);
  EXPECT_THROW(parse_cues("-1", "c.txt"), ParseError);
  EXPECT_THROW(parse_cues("1x", "c.txt"), ParseError);
}

TEST_F(LearnPeople, FromFilmToModelToAtlasAndCrowd) {
  LearnPeopleOptions options;
  options.mirror = true;
  const LearnedPeople learned = learn_people({film("film.mkv")}, {}, {}, {}, options);
  const PeopleTexture& texture = learned.model.texture;
  ASSERT_EQ(texture.takes.size(), 2U);
  EXPECT_EQ(texture.takes[0].frames, (FrameSpan{0, 560}));
  EXPECT_TRUE(texture.takes[1].mirrored);
  EXPECT_EQ(texture.num_frames(), 1120);
  EXPECT_EQ(learned.model.plate.width, 240);

  const PeopleModel model = parse_people_model(people_model_bytes(learned.model), "x");
  const ActorSimulation simulation(options_);
  StoredFootage stored(model);
  for (const int t : {0, 100, 333, 559})
    EXPECT_GT(likeness(simulation.sprite(t, 0), *stored.sprite(t), 240, 160), 0.95);

  ASSERT_GE(texture.alphabet.motifs.size(), 1U);
  SpriteAtlasOptions small;
  small.page_size = 512;
  const SpriteAtlas atlas = plan_atlas(model.texture, stored, small);
  std::vector<Image> pages;
  draw_atlas(atlas, stored, small.page_size, [&](int, const Image& page) { pages.push_back(page); });
  ASSERT_EQ(pages.size(), static_cast<std::size_t>(atlas.num_pages));
  for (const AtlasFrame& frame : atlas.frames) {
    const Image part = crop(pages[static_cast<std::size_t>(frame.page)], frame.x, frame.y, frame.width, frame.height);
    const Image whole = to_image(*stored.sprite(frame.source), 240, 160);
    const Image want = crop(whole, frame.left, frame.top, frame.width, frame.height);
    for (std::size_t k = 0; k < want.pixels.size(); ++k) ASSERT_EQ(part.pixels[k].a, want.pixels[k].a);
  }
  for (const AtlasAction& action : atlas.actions)
    for (const int frame : action.frames) ASSERT_LT(frame, static_cast<int>(atlas.frames.size()));

  ASSERT_FALSE(texture.cuts.cuts.empty());
  CrowdOptions crowd_options;
  crowd_options.people = 3;
  const std::vector<PeopleModel> models{model};
  JobContext alone;
  alone.jobs = 1;
  Crowd a(models, 20, crowd_options), b(models, 20, crowd_options, {}, {}, alone);
  for (std::size_t k = 1; k < 3; ++k) EXPECT_GE(a.extras()[k].scale, a.extras()[k - 1].scale);
  for (int t = 0; t < 20; ++t) {
    Image left(240, 160, {0, 0, 0, 255}), right = left;
    ASSERT_TRUE(a.next(left));
    ASSERT_TRUE(b.next(right));
    ASSERT_EQ(left.pixels, right.pixels) << t;
    EXPECT_NE(left.pixels, Image(240, 160, {0, 0, 0, 255}).pixels);
  }
  Image rest(240, 160);
  EXPECT_FALSE(a.next(rest));

  crowd_options.people = 2;
  const double half = 10 / texture.frames_per_sec;
  Crowd cued(models, 20, crowd_options, {}, {}, {}, {{2 * half, ""}, {half, texture.alphabet.motifs[0].letter}});
  for (int t = 0; t < 20; ++t) {
    Image picture(240, 160, {0, 0, 0, 255});
    ASSERT_TRUE(cued.next(picture));
    EXPECT_EQ(picture.pixels == Image(240, 160, {0, 0, 0, 255}).pixels, t < 10) << t;
  }
  EXPECT_THROW(Crowd(models, 20, crowd_options, {}, {}, {}, {{}, {}, {}}), InvalidInput);
}

}  // namespace
}  // namespace motex
