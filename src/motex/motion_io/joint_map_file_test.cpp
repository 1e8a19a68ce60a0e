// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/joint_map_file.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

const JointNamePairs kPairs{{"Hips", "hip"}, {"a,\"b\"", "c d"}};

TEST(JointMapFile, WhatIsWrittenIsRead) {
  Skeleton source, target;
  source.joints = {{"hip", -1, Vector3::Zero(), {}}, {"c d", 0, Vector3::Zero(), {}}};
  target.joints = {
      {"Hips", -1, Vector3::Zero(), {}}, {"a,\"b\"", 0, Vector3::Zero(), {}}, {"Tail", 0, Vector3::Zero(), {}}};
  const JointMap map = joint_map_by_names(source, target, kPairs);
  for (const char* name : {"map.csv", "map.json"})
    EXPECT_EQ(read_joint_map_bytes(joint_map_text(source, target, map, name), name), kPairs) << name;
}

TEST(JointMapFile, ByHand) {
  EXPECT_EQ(read_joint_map_bytes("# mine\r\nHips , hip\r\n\"a,\"\"b\"\"\",c d", "m.csv"), kPairs);
  EXPECT_EQ(read_joint_map_bytes(R"({"Hips": "hip", "Tail": null, "a,\"b\"": "c d"})", "m.json"), kPairs);
}

TEST(JointMapFile, Errors) {
  const auto says = [](const char* text, const char* name, const char* part) {
    try {
      read_joint_map_bytes(text, name);
      ADD_FAILURE() << text;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  says("a,b\na,b,c\n", "m.csv", "m.csv:2");
  says("target,source\n", "m.csv", "joins nothing");
  says("[1]", "m.json", "object");
  says("{\"a\": 1", "m.json", "object");
  says("{\"a\": 1}", "m.json", "'a'");
}

}  // namespace
}  // namespace motex
