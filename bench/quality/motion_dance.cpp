// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// 10,000 frames of endless dance against their source, seams included: against all of it, and against the source frames
// of the segments that the dance used.
#include <cmath>

#include "bench/motion_data.h"
#include "motex/motion/measures.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthesize.h"

namespace {

using motex::Index;

constexpr Index kFrames = 10000;
constexpr std::uint64_t kSeeds = 5;
constexpr const char* kHeader =
    "                          jerk contact    jump   speed | used: jerk contact    jump   speed | height cm   copy s";

std::vector<motex::ClipRange> used_ranges(const motex::MotionTexture& model, const motex::SynthesizeReport& report) {
  std::vector<motex::ClipRange> ranges;
  for (const motex::PlayedTexton& played : report.played) {
    const motex::Instance& instance = model.instances[static_cast<std::size_t>(played.instance)];
    const motex::Run& run = model.runs[static_cast<std::size_t>(instance.run_idx)];
    ranges.push_back({run.clip_idx, run.clip_start + instance.row - run.row, instance.length});
  }
  return ranges;
}

struct Result {
  motex::CompareReport whole, used;
  double height_cm = 0;  ///< how far out of the source's range
  double copy_secs = 0;
};

Result dance_once(const motex::MotionTexture& model, const std::vector<motex::Clip>& clips,
                  motex::SynthesizeOptions options, std::uint64_t seed) {
  options.seed = seed;
  motex::SynthesizeReport report;
  const motex::Clip dance = motex::synthesize_motion(model, kFrames, {}, options, report);
  Result result;
  result.whole = motex::compare_motion(clips, dance);
  result.used = motex::compare_motion(clips, used_ranges(model, report), dance);
  const motex::MotionMeasures &source = result.whole.reference, &made = result.whole.generated;
  const double out = std::max({0.0, source.height_min - made.height_min, made.height_max - source.height_max});
  result.height_cm = out * model.features.cm_per_unit;
  result.copy_secs = static_cast<double>(report.longest_copy) * model.frame_time_secs();
  return result;
}

void print_row(const std::string& name, const motex::CompareReport& whole, const motex::CompareReport& used,
               double height_cm, double copy_secs) {
  std::printf("  %-20s %7.3f %7.3f %7.3f %7.3f |   %7.3f %7.3f %7.3f %7.3f |   %7.2f  %7.2f\n", name.c_str(),
              whole.jerk_ratio, whole.contact_speed_ratio, whole.pose_jump_ratio, whole.speed_ratio, used.jerk_ratio,
              used.contact_speed_ratio, used.pose_jump_ratio, used.speed_ratio, height_cm, copy_secs);
}

/// The value that lies farther from 1, or higher where only that is bad.
void take_worst(motex::CompareReport& worst, const motex::CompareReport& report) {
  worst.jerk_ratio = std::max(worst.jerk_ratio, report.jerk_ratio);
  worst.contact_speed_ratio = std::max(worst.contact_speed_ratio, report.contact_speed_ratio);
  worst.pose_jump_ratio = std::max(worst.pose_jump_ratio, report.pose_jump_ratio);
  if (worst.speed_ratio == 0 || std::abs(report.speed_ratio - 1) > std::abs(worst.speed_ratio - 1))
    worst.speed_ratio = report.speed_ratio;
}

void print_dances(const std::string& name, const motex::MotionTexture& model, const std::vector<motex::Clip>& clips,
                  const motex::SynthesizeOptions& options) {
  std::printf(" %s\n", name.c_str());
  Result worst;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Result result = dance_once(model, clips, options, seed);
    print_row("seed " + std::to_string(seed), result.whole, result.used, result.height_cm, result.copy_secs);
    take_worst(worst.whole, result.whole);
    take_worst(worst.used, result.used);
    worst.height_cm = std::max(worst.height_cm, result.height_cm);
    worst.copy_secs = std::max(worst.copy_secs, result.copy_secs);
  }
  print_row("worst", worst.whole, worst.used, worst.height_cm, worst.copy_secs);
}

void measure(const std::filesystem::path& folder) {
  std::printf("%ld endless frames / source; wanted: jerk, contact <= 1.10, jump <= 1.05, speed 0.90 ... 1.10,\n",
              static_cast<long>(kFrames));
  std::printf("height <= 5 cm out of range. known: GenMM 0.98-1.09, 1.02-1.23, 1.00-1.06\n%s\n", kHeader);
  for (const motex::bench::Dance& dance : motex::bench::all_dances(folder)) {
    std::printf("%s\n", dance.name.c_str());
    motex::LearnReport report;
    motex::LearnOptions own;
    own.basis = motex::Basis::kOwn;
    motex::SynthesizeOptions as_solved;
    as_solved.foot_fix = as_solved.floor_fix = false;
    const motex::MotionTexture model = motex::learn_motion_texture(dance.clips, {}, report);
    print_dances("default", model, dance.clips, {});
    print_dances("without foot pass", model, dance.clips, as_solved);
    print_dances("own basis", motex::learn_motion_texture(dance.clips, own, report), dance.clips, {});
  }
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
