// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "motex/core/gemm.h"
#include "motex/core/rng.h"
#include "motex/motion/clip.h"

int main() {
  motex::Skeleton skeleton;
  skeleton.joints.push_back({.name = "hips"});
  skeleton.joints.push_back({.name = "spine", .parent_idx = 0, .offset = {0, 2, 0}});
  const motex::Clip clip = motex::make_clip(skeleton, 1, 1.0 / 60);
  const motex::FrameMatrix positions = motex::world_positions(clip);
  double product = 0;
  const double two = 2;
  motex::gemm(false, false, 1, 1, 1, 1.0, &positions(0, 4), 1, &two, 1, 0.0, &product, 1);
  std::printf("spine height times two: %g\n", product);
  return product == 4 && motex::Rng(1).below(1) == 0 ? 0 : 1;
}
