// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT

// Learns a motion texture from BVH files and dances on, frame after frame, as a player or a game would.
#include <cstdio>
#include <exception>
#include <vector>

#include "motex/motion_io/clip_io.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthesize.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: dance_on CLIP.bvh...\n");
    return 2;
  }
  try {
    std::vector<motex::Clip> clips;
    for (int i = 1; i < argc; ++i) clips.push_back(motex::read_clip(argv[i], {}, {}));

    motex::LearnReport report;
    const motex::MotionTexture model = motex::learn_motion_texture(clips, {}, report);
    std::printf("%d textons in %d segments of %ld frames\n", report.num_textons, report.num_segments,
                static_cast<long>(report.num_frames));

    motex::Synthesizer dance(model, {});
    motex::Clip now = motex::make_output_clip(model, 1);  // one frame, written again and again
    motex::Pose pose;
    for (int second = 0; second < 10; ++second) {
      for (int t = 0; t < 60; ++t) dance.next(now, 0);
      motex::forward_kinematics(now, 0, pose);
      std::printf("%2d s: the hips are at %7.1f %6.1f %7.1f;", second + 1, pose.positions(0, 0), pose.positions(1, 0),
                  pose.positions(2, 0));
      for (const motex::PlayedTexton& played : dance.take_played()) std::printf(" %d", played.texton);
      std::printf("\n");
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dance_on: %s\n", error.what());
    return 1;
  }
  return 0;
}
