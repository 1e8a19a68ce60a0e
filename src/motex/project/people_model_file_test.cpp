// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/people_model_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/people/measure_silhouette.h"
#include "motex/project/simulate_actor.h"

namespace motex {
namespace {

constexpr int kFrames = 100;  // two chunks

std::vector<Sprite> performed() {
  SimulateActorOptions options;
  options.frames = kFrames;
  options.width = 240;
  options.height = 160;
  const ActorSimulation simulation(options);
  std::vector<Sprite> sprites;
  for (int t = 0; t < kFrames; ++t) sprites.push_back(simulation.sprite(t, 0));
  sprites[7] = {};  // nobody there
  return sprites;
}

/// A take, the same mirrored, and an alphabet.
PeopleModel make_model(const std::vector<Sprite>& sprites, bool lossless) {
  PeopleModel model;
  PeopleTexture& texture = model.texture;
  texture.width = 240;
  texture.height = 160;
  texture.frames_per_sec = 30;
  texture.takes = {{"clip.mp4", 5, 0, false, {0, kFrames}}, {"clip.mp4", 5, 0, true, {kFrames, kFrames}}};
  for (const Sprite& one : sprites) texture.silhouettes.push_back(measure_silhouette(one));
  for (int t = 0; t < kFrames; ++t) texture.silhouettes.push_back(mirrored(texture.silhouettes[t], 240));
  texture.alphabet.motifs = {{"A", "high kick", 12, 0.25, 0.5, 3, {{3, 12, 0}, {20, 11, 0.25}}}};
  texture.alphabet.idle = {{33, 5}};
  texture.cuts = {{{3, 20, 6, 12.5, 0.75}}, 4.5};
  TakeFilmWriter writer(30, lossless);
  for (const Sprite& one : sprites) writer.add(one);
  model.films = {writer.finish(), {}};
  model.originals = original_takes(texture);
  model.plate = Image(240, 160, {10, 200, 30, 255});
  return model;
}

struct Likeness {
  double iou = 0, colour_error = 0;
};

Likeness compare(const std::vector<Sprite>& truth, SpriteSource& stored) {
  std::int64_t both = 0, either = 0, count = 0;
  double sum = 0;
  for (int t = 0; t < kFrames; ++t) {
    const auto got = stored.sprite(t);
    const Sprite& want = truth[static_cast<std::size_t>(t)];
    EXPECT_EQ(got->pixels.size(), want.pixels.size());
    for (std::size_t k = 0; k < std::min(got->pixels.size(), want.pixels.size()); ++k) {
      const PremultipliedRgba &a = want.pixels[k], &b = got->pixels[k];
      both += a[3] >= 128 && b[3] >= 128;
      either += a[3] >= 128 || b[3] >= 128;
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]), ++count;
    }
  }
  return {static_cast<double>(both) / static_cast<double>(either), sum / static_cast<double>(count)};
}

TEST(PeopleModelFile, ForeignAndDamagedFilesAreRefused) {
  EXPECT_THROW(parse_people_model("not a model", "x"), Error);
  const std::string bytes = people_model_bytes(make_model(performed(), false));
  EXPECT_THROW(parse_people_model(bytes.substr(0, bytes.size() / 2), "x"), ParseError);
  std::string altered = bytes;
  altered[bytes.size() / 3] = static_cast<char>(altered[bytes.size() / 3] ^ 1);
  EXPECT_THROW(parse_people_model(altered, "x"), ParseError);
}

TEST(PeopleModelFile, WhatDoesNotFitTogetherIsRefused) {
  const PeopleModel good = make_model(performed(), false);
  const auto refused = [&](const auto& spoil) {
    PeopleModel bad = good;
    spoil(bad);
    EXPECT_THROW(parse_people_model(people_model_bytes(bad), "x"), InvalidInput);
  };
  refused([](PeopleModel& m) { m.texture.silhouettes.pop_back(); });
  refused([](PeopleModel& m) { m.texture.takes[1].frames.start += 1; });
  refused([](PeopleModel& m) { m.texture.takes[1].source = "other"; });
  refused([](PeopleModel& m) { m.films[0].boxes[2].left -= 4000; });
  refused([](PeopleModel& m) { m.films[0].boxes.pop_back(); });
  refused([](PeopleModel& m) { m.films[0].chunks[1].canvas.right += 100000; });
  refused([](PeopleModel& m) { m.texture.alphabet.motifs[0].occurrences[1].start = 2 * kFrames - 3; });
  refused([](PeopleModel& m) { m.texture.cuts.cuts[0].to = 2 * kFrames; });
  refused([](PeopleModel& m) { m.texture.frames_per_sec = 0; });
  refused([](PeopleModel& m) { m.films[0].chunks.pop_back(); });
  refused([](PeopleModel& m) { m.plate = Image(3, 3); });
}

TEST(PeopleModelFile, FootageThatIsNoVideoIsAnErrorWhenItIsRead) {
  PeopleModel model = make_model(performed(), false);
  model.films[0].chunks[0].video = std::make_shared<const std::string>("garbage");
  StoredFootage stored(parse_people_model(people_model_bytes(model), "x"));
  EXPECT_THROW(stored.sprite(0), Error);
}

TEST(PeopleModelFile, ReadingGivesWhatWasWrittenAndTheSameBytes) {
  const PeopleModel model = make_model(performed(), false);
  const std::string bytes = people_model_bytes(model);
  const PeopleModel again = parse_people_model(bytes, "x");
  EXPECT_EQ(people_model_bytes(again), bytes);
  EXPECT_EQ(again.texture.takes[1].source, "clip.mp4");
  EXPECT_TRUE(again.texture.takes[1].mirrored);
  EXPECT_EQ(again.originals, (std::vector<int>{0, 0}));
  EXPECT_EQ(again.texture.alphabet.motifs[0].name, "high kick");
  EXPECT_EQ(again.texture.alphabet.motifs[0].occurrences[1].length, 11);
  EXPECT_EQ(again.texture.alphabet.idle, model.texture.alphabet.idle);
  EXPECT_EQ(again.texture.cuts.cuts[0].smoothness, 0.75);
  EXPECT_EQ(again.texture.silhouettes[5].mu30, model.texture.silhouettes[5].mu30);
  EXPECT_EQ(again.plate.pixels, model.plate.pixels);
}

TEST(PeopleModelFile, StoredPicturesLookAsTheyDid) {
  const std::vector<Sprite> truth = performed();
  const PeopleModel model = parse_people_model(people_model_bytes(make_model(truth, false)), "x");
  StoredFootage stored(model);
  const Likeness likeness = compare(truth, stored);
  EXPECT_GT(likeness.iou, 0.998);
  EXPECT_LT(likeness.colour_error, 3);
  EXPECT_LT(model.footage_bytes(), 1000000 * kFrames / 30);
}

TEST(PeopleModelFile, LosslessPicturesAreTheSame) {
  const std::vector<Sprite> truth = performed();
  StoredFootage stored(parse_people_model(people_model_bytes(make_model(truth, true)), "x"));
  for (int t = 0; t < kFrames; ++t) EXPECT_EQ(stored.sprite(t)->pixels, truth[static_cast<std::size_t>(t)].pixels) << t;
}

TEST(PeopleModelFile, AnyOrderGivesTheSamePicturesAndMirroredTakesAreMirrored) {
  const PeopleModel model = make_model(performed(), false);
  StoredFootage rising(model), jumping(model);
  std::vector<std::shared_ptr<const Sprite>> all;
  for (int t = 0; t < 2 * kFrames; ++t) all.push_back(rising.sprite(t));
  for (const int t : {39, 2, 160, 17, 0, 179, 38, 99, 60, 3}) {
    const auto one = jumping.sprite(t);
    EXPECT_EQ(one->pixels, all[static_cast<std::size_t>(t)]->pixels) << t;
    EXPECT_EQ(one->left, all[static_cast<std::size_t>(t)]->left) << t;
  }
  const Sprite turned = mirrored(*all[12], 240);
  EXPECT_EQ(all[kFrames + 12]->pixels, turned.pixels);
  EXPECT_EQ(all[kFrames + 12]->left, turned.left);
  EXPECT_TRUE(all[7]->empty());
  EXPECT_THROW(rising.sprite(2 * kFrames), InvalidInput);
}

TEST(PeopleModelFile, OldFilesAreRead) {
  const auto path = std::filesystem::path(MOTEX_TEST_DATA) / "../old_files/people_texture_v1.motex";
  const PeopleModel model = load_people_model(path);
  ASSERT_EQ(model.texture.takes.size(), 2U);
  EXPECT_EQ(model.texture.num_frames(), 180);
  EXPECT_EQ(model.texture.width, 64);
  EXPECT_EQ(model.originals, (std::vector<int>{0, 0}));
  StoredFootage stored(model);
  for (const int t : {0, 89, 90, 150}) {
    const Silhouette now = measure_silhouette(*stored.sprite(t)), then = model.texture.silhouettes[t];
    EXPECT_NEAR(now.area / then.area, 1, 0.05) << t;
    EXPECT_NEAR(now.centroid_x, then.centroid_x, 0.5) << t;
  }
}

}  // namespace
}  // namespace motex
