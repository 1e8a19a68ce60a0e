// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/textured_motion_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

Base make_base(BaseKind kind, double x, double y) {
  Base base;
  base.kind = kind;
  base.x = x;
  base.y = y;
  base.scale = 1.5;
  base.coefficients = {100, 120, 140};
  return base;
}

/// Two cables, one with coils and poses, a template of two poses, a burst.
TexturedMotion make_model() {
  TexturedMotion model;
  model.width = 16;
  model.height = 12;
  model.num_planes = 3;
  model.num_frames = 5;
  model.source = "birds.mkv";
  model.seed = 18446744073709551615U;
  model.background = {Plane(16, 12, 10), Plane(16, 12, 20), Plane(16, 12, 30)};
  model.background[1].at(3, 4) = 200;
  model.noise = 4;
  model.flow = {1.5, 6, 40};
  MovetonTemplate bird;
  bird.pose_transitions = TransitionMatrix(2, 1);
  bird.pose_transitions.add_count(0, 1, 3);
  bird.poses.resize(2);
  bird.poses[1].coils.resize(1);
  bird.poses[1].coils[0].u = {0.5, 0.1};
  bird.poses[1].coils[0].coefficient[2] = {-0.4, 0.2};
  model.templates = {bird};
  model.dynamics.resize(1);
  model.dynamics[0].y = {1.7, -0.7, 0.9, 0.25, 1, 3, 0.4, 0.05, 0, 3, 0.4};
  Cable plain;
  plain.core = {make_base(BaseKind::kGaussian, 1, 2), make_base(BaseKind::kGaussian, 2, 3)};
  Cable flapping;
  flapping.first_frame = 2;
  flapping.species = 0;
  flapping.core = {make_base(BaseKind::kGaborCos, 5, 6), make_base(BaseKind::kGaborCos, 7, 6),
                   make_base(BaseKind::kGaborCos, 9, 6)};
  flapping.coils = {flapping.core};
  flapping.poses = {0, 1, 1};
  model.cables = {plain, flapping};
  BirthDeathMaps& maps = model.maps;
  maps.width = 16;
  maps.height = 12;
  maps.births_per_frame = 0.4;
  maps.bandwidth = 3;
  maps.births = {{5, 6, 2, 0, 2, 1}};
  maps.deaths = {{2, 3, 1, 1, 1, 0}};
  maps.bursts = {{4, 6, 1.5, {1}}};
  maps.source = maps.sink = maps.occupancy = maps.hazard = Plane(16, 12, 1.0F / 192);
  return model;
}

TEST(TexturedMotionFile, WhatWasWrittenIsRead) {
  const TexturedMotion model = make_model();
  const std::string bytes = textured_motion_bytes(model);
  const TexturedMotion read = parse_textured_motion(bytes, "m");
  EXPECT_EQ(textured_motion_bytes(read), bytes);
  EXPECT_EQ(read.seed, model.seed);
  EXPECT_EQ(read.source, "birds.mkv");
  EXPECT_EQ(read.background[1].at(3, 4), 200);
  EXPECT_EQ(read.templates[0].poses[1].coils[0].coefficient[2].mean, -0.4);
  EXPECT_EQ(read.templates[0].pose_transitions.count(0, 1), 3);
  EXPECT_EQ(read.dynamics[0].y.persistence(), 0.7);
  EXPECT_EQ(read.cables[1].poses, model.cables[1].poses);
  EXPECT_EQ(read.cables[1].coils[0][2].x, 9);
  EXPECT_EQ(read.cables[1].core[0].coefficients[2], 140);
  EXPECT_EQ(read.maps.births[0].frame, 2);
  EXPECT_EQ(read.maps.bursts[0].cables, std::vector<int>{1});
}

/// Programs that know version 1 alone know no streaks: they refuse such a model by its version.
TEST(TexturedMotionFile, OnlyModelsWithStreaksAreVersionTwo) {
  constexpr std::size_t kVersionByte = 8;
  const std::string plain = textured_motion_bytes(make_model());
  EXPECT_EQ(plain[kVersionByte], 1);
  TexturedMotion in_core = make_model(), in_coil = make_model(), in_pose = make_model(), in_template = make_model();
  in_core.cables[0].core[1].kind = BaseKind::kStreak;
  in_coil.cables[1].coils[0][0].kind = BaseKind::kStreak;
  in_pose.templates[0].poses[1].core_kind = BaseKind::kStreak;
  in_template.templates[0].poses[1].coils[0].kind = BaseKind::kStreak;
  for (const TexturedMotion& model : {in_core, in_coil, in_pose, in_template}) {
    std::string bytes = textured_motion_bytes(model);
    EXPECT_EQ(bytes[kVersionByte], 2);
    EXPECT_EQ(textured_motion_bytes(parse_textured_motion(bytes, "m")), bytes);
    bytes[kVersionByte] = 1;  // says what it is not
    const std::uint32_t sum = archive_checksum(bytes.substr(0, bytes.size() - 4));
    std::memcpy(bytes.data() + bytes.size() - 4, &sum, 4);
    EXPECT_THROW(parse_textured_motion(bytes, "m"), InvalidInput);
  }
}

TEST(TexturedMotionFile, AModelWithoutAnythingLearnedIsKept) {
  TexturedMotion model = make_model();
  model.cables.clear();
  model.templates.clear();
  model.dynamics.clear();
  model.maps = {};
  const TexturedMotion read = parse_textured_motion(textured_motion_bytes(model), "m");
  EXPECT_TRUE(read.cables.empty());
  EXPECT_TRUE(read.maps.source.values.empty());
}

TEST(TexturedMotionFile, EveryTruncationIsAnError) {
  const std::string bytes = textured_motion_bytes(make_model());
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_THROW(parse_textured_motion(bytes.substr(0, size), "m"), Error) << size;
}

/// Flips bytes and seals the file again: nothing but an Error may come of it.
TEST(TexturedMotionFile, HostileEditsAreErrorsOrModels) {
  const std::string bytes = textured_motion_bytes(make_model());
  Rng rng(5);
  int num_refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string edited = bytes.substr(0, bytes.size() - 4);
    for (int k = 0; k < 3; ++k) edited[rng.below(edited.size())] = static_cast<char>(rng.below(256));
    const std::uint32_t sum = archive_checksum(edited);
    for (unsigned shift = 0; shift < 32; shift += 8) edited += static_cast<char>((sum >> shift) & 255U);
    try {
      parse_textured_motion(edited, "m");
    } catch (const Error&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 300);
}

/// A file of every format version is kept (tests/old_files); what it held when it was new is what it holds for ever.
TEST(TexturedMotionFile, ReadsVersionOne) {
  const auto path = std::filesystem::path(MOTEX_TEST_DATA) / "../old_files/textured_motion_v1.motex";
  const TexturedMotion model = load_textured_motion(path);
  EXPECT_TRUE(textured_motion_bytes(model) == read_file(path));
  EXPECT_EQ(model.source, "old/scene.mkv");
  EXPECT_EQ(model.width, 64);
  EXPECT_EQ(model.num_frames, 12);
  EXPECT_EQ(model.cables.size(), 10U);
  ASSERT_EQ(model.dynamics.size(), 1U);
  EXPECT_NEAR(model.dynamics[0].x.persistence(), 0.7228749640222573, 1e-15);
  EXPECT_NEAR(model.maps.births_per_frame, 0.36363636363636365, 1e-15);
}

TEST(TexturedMotionFile, ReadsVersionTwo) {
  const auto path = std::filesystem::path(MOTEX_TEST_DATA) / "../old_files/textured_motion_v2.motex";
  const TexturedMotion model = load_textured_motion(path);
  EXPECT_TRUE(textured_motion_bytes(model) == read_file(path));
  int num_streaks = 0;
  for (const Cable& cable : model.cables) num_streaks += cable.core[0].kind == BaseKind::kStreak ? 1 : 0;
  EXPECT_EQ(num_streaks, 7);
  ASSERT_FALSE(model.cables.empty());
  EXPECT_NEAR(model.cables[0].core[0].x, 46.029712677001953, 1e-15);
}

}  // namespace
}  // namespace motex
