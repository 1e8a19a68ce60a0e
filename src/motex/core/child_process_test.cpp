// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace motex {
namespace {

TEST(ChildProcess, SaysWhetherTheWorkEndedByItself) {
  EXPECT_TRUE(survives_in_child([] {}, 5));
  EXPECT_TRUE(survives_in_child([] { throw std::runtime_error("met again by the caller"); }, 5));
  EXPECT_FALSE(survives_in_child([] { std::raise(SIGKILL); }, 5));
}

TEST(ChildProcess, EndsWorkThatDoesNotEnd) {
  volatile bool always = true;
  EXPECT_FALSE(survives_in_child(
      [&] {
        while (always) {
        }
      },
      1));
}

}  // namespace
}  // namespace motex
