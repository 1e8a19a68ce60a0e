// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_paths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Four textons, 0 → 1 → 2 and 0 → 2 at a lower probability, 2 → 0; 3 leads to 0 and nothing leads to 3.
MotionTexture small_model() {
  MotionTexture model;
  model.transitions = TransitionMatrix(4);
  model.transitions.add_count(0, 1, 9);
  model.transitions.add_count(0, 2, 1);
  model.transitions.add_count(1, 2, 1);
  model.transitions.add_count(2, 0, 1);
  model.transitions.add_count(3, 0, 1);
  model.textons.resize(4);
  const Index lengths[] = {10, 20, 30, 40, 15};
  Index row = 0;
  for (int i = 0; i < 5; ++i) {
    model.instances.push_back({i % 4, 0, row, lengths[i], {}});
    model.textons[static_cast<std::size_t>(i % 4)].instances.push_back(i);
    row += lengths[i];
  }
  model.runs.push_back({0, 0, 0, row + 2});
  return model;
}

std::string message_of(int from, int to, int num_textons = 0) {
  try {
    find_texton_paths(small_model(), from, to, num_textons);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(TextonPaths, ErrorsNameWhatThereIs) {
  EXPECT_EQ(message_of(0, 4), "there is no texton 4; the model has 0 … 3");
  EXPECT_EQ(message_of(-1, 0), "there is no texton -1; the model has 0 … 3");
  EXPECT_EQ(message_of(0, 3), "there is no path from texton 0 to texton 3; from texton 0 one reaches 0, 1, 2");
  EXPECT_EQ(message_of(1, 2, 3),
            "there is no path of 3 textons from texton 1 to texton 2; the nearest possible: 2 and 4");
  EXPECT_NE(message_of(0, 1, -1), "");
}

TEST(TextonPaths, TheLikeliestComesFirst) {
  const TextonPaths paths = find_texton_paths(small_model(), 0, 2);
  EXPECT_EQ(paths.best.textons, (std::vector<int>{0, 1, 2}));
  EXPECT_NEAR(paths.best.log_prob, std::log(0.9), 1e-12);
  EXPECT_EQ(paths.best.shortest, 10 + 20 + 30 + 2);
  EXPECT_EQ(paths.best.longest, 15 + 20 + 30 + 2);
  ASSERT_TRUE(paths.runner_up.has_value());
  EXPECT_EQ(paths.runner_up->textons, (std::vector<int>{0, 2}));
  EXPECT_NEAR(paths.runner_up->log_prob, std::log(0.1), 1e-12);
  EXPECT_FALSE(find_texton_paths(small_model(), 1, 2).runner_up.has_value());
}

TEST(TextonPaths, OfAGivenLength) {
  EXPECT_EQ(find_texton_paths(small_model(), 0, 2, 2).best.textons, (std::vector<int>{0, 2}));
  EXPECT_EQ(find_texton_paths(small_model(), 0, 2, 6).best.textons.size(), 6U);
}

}  // namespace
}  // namespace motex
