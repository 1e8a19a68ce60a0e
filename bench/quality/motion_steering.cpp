// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Does a steered dance go where it is sent? Twenty random directions, one after another; each is held for three textons
// beside the one that plays when it comes. Beside it the same dance without commands, judged by the same directions.
#include <cmath>
#include <numbers>

#include "bench/motion_data.h"
#include "motex/core/rng.h"
#include "motex/motion/measures.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/steering.h"

namespace {

using motex::Index;

constexpr int kCommands = 20, kTextons = 3;
constexpr std::uint64_t kSeeds = 3;
constexpr double kLeastWayCm = 15;  // shorter ways have no direction
constexpr double kPi = std::numbers::pi;

/// Frames at which the texton that plays ends, and the ones after it.
struct Command {
  double direction = 0;
  Index start = 0;
  std::vector<Index> ends;
};

struct Dance {
  motex::Clip clip;
  std::vector<Command> commands;
};

Dance dance(const motex::MotionTexture& model, std::uint64_t seed, bool steered, bool facing) {
  motex::SynthesizeOptions options;
  options.seed = seed;
  motex::SteeredSynthesizer stream(model, options);
  motex::Rng rng(1000 + seed);
  constexpr Index kMost = 40000;
  Dance out{motex::make_output_clip(model, kMost), {}};
  Index frame = 0;
  std::vector<motex::PlayedTexton> played;
  for (int c = 0; c < kCommands; ++c) {
    Command command{rng.uniform(-kPi, kPi), frame + stream.delay(), {}};
    motex::Steering steering;
    (facing ? steering.facing : steering.direction) = command.direction;
    if (steered) stream.steer(steering);
    while (command.ends.size() <= kTextons && frame < kMost) {
      stream.next(out.clip, frame++);
      for (const motex::PlayedTexton& p : stream.take_played())
        if (p.start > command.start) command.ends.push_back(p.start);
    }
    while (frame < std::min(kMost, command.ends.back())) stream.next(out.clip, frame++);
    out.commands.push_back(command);
  }
  out.clip = motex::slice(out.clip, 0, frame);
  return out;
}

struct Score {
  double error = 0, speed = 0;  // degrees; m/s along the wanted direction
  int num_errors = 0, num = 0;
};

void score(const motex::MotionTexture& model, const Dance& d, bool facing, std::vector<Score>& scores) {
  const double cm = model.features.cm_per_unit;
  for (const Command& command : d.commands) {
    Index from = command.start;
    for (std::size_t k = 0; k <= kTextons; ++k) {
      const Index to = std::min(command.ends[k], d.clip.num_frames() - 1);
      const motex::RootPlace a = motex::root_place(model.features, d.clip, from),
                             b = motex::root_place(model.features, d.clip, to);
      const double x = b.x - a.x, z = b.z - a.z, way = std::hypot(x, z) * cm;
      const double angle = facing ? b.heading : std::atan2(x, z);
      if (facing || way >= kLeastWayCm) {
        scores[k].error += std::abs(std::remainder(angle - command.direction, 2 * kPi)) * 180 / kPi;
        ++scores[k].num_errors;
      }
      scores[k].speed += (x * std::sin(command.direction) + z * std::cos(command.direction)) * cm / 100 /
                         (static_cast<double>(std::max<Index>(1, to - from)) * d.clip.frame_time_secs);
      ++scores[k].num;
      from = to;
    }
  }
}

void print(const std::string& name, const motex::MotionTexture& model, const std::vector<motex::Clip>& clips,
           bool steered, bool facing) {
  std::vector<Score> scores(kTextons + 1);
  motex::CompareReport sum;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Dance d = dance(model, seed, steered, facing);
    score(model, d, facing, scores);
    const motex::CompareReport r = motex::compare_motion(clips, d.clip);
    sum.jerk_ratio += r.jerk_ratio / kSeeds;
    sum.contact_speed_ratio += r.contact_speed_ratio / kSeeds;
    sum.pose_jump_ratio = std::max(sum.pose_jump_ratio, r.pose_jump_ratio);
    sum.speed_ratio += r.speed_ratio / kSeeds;
  }
  std::printf("  %-22s", name.c_str());
  for (const Score& s : scores) std::printf("  %5.0f° %6.2f", s.error / std::max(1, s.num_errors), s.speed / s.num);
  std::printf("   | %5.3f %5.3f %5.3f %5.3f\n", sum.jerk_ratio, sum.contact_speed_ratio, sum.pose_jump_ratio,
              sum.speed_ratio);
}

void measure(const std::filesystem::path& folder) {
  for (const motex::bench::Dance& source : motex::bench::all_dances(folder)) {
    motex::LearnReport learned;
    const motex::MotionTexture model = motex::learn_motion_texture(source.clips, {}, learned);
    std::printf(
        "%s: mean error and m/s towards the command, in the rest of the texton that plays and in the next "
        "three | jerk, contact, jump, speed ratios\n",
        source.name.c_str());
    print("direction, unsteered", model, source.clips, false, false);
    print("direction, steered", model, source.clips, true, false);
    print("facing, unsteered", model, source.clips, false, true);
    print("facing, steered", model, source.clips, true, true);
  }
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
