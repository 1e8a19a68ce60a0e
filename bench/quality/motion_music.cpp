// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Textons on beats: how far their beginnings lie from beats, and whether the dance is as smooth and grounded as without
// beats. Loops: whether the seam is a step like others.
#include "bench/motion_data.h"
#include "motex/motion/measures.h"
#include "motex/motion_texture/learn.h"
#include "motex/project/dance.h"

namespace {

using motex::Index;
using motex::MotionTexture;

constexpr double kSecs = 90;
constexpr std::uint64_t kSeeds = 3;

/// Beats that drift by a few percent, as a band plays.
std::vector<double> beats_of(double bpm) {
  std::vector<double> beats;
  for (double t = 0.37; t < kSecs; t += 60 / (bpm * (1 + 0.03 * std::sin(t / 7)))) beats.push_back(t);
  return beats;
}

void print_ratios(const std::vector<motex::CompareReport>& reports) {
  double jerk = 0, contact = 0, jump = 0, speed = 0;
  for (const motex::CompareReport& r : reports) {
    const auto n = static_cast<double>(reports.size());
    jerk += r.jerk_ratio / n, contact += r.contact_speed_ratio / n, jump += r.pose_jump_ratio / n;
    speed += r.speed_ratio / n;
  }
  std::printf("  jerk %.2f  contact %.2f  jump %.2f  speed %.2f\n", jerk, contact, jump, speed);
}

void measure_beats(const motex::bench::Dance& dance, const MotionTexture& model) {
  std::printf("beats: %.0f s, seeds 1 ... %d; mean of seeds\n", kSecs, static_cast<int>(kSeeds));
  for (const double bpm : {0.0, 50.0, 70.0, 100.0, 130.0, 190.0}) {
    double median = 0, largest = 0, share = 0, stretch = 0, count = 0;
    std::vector<motex::CompareReport> reports;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      motex::SynthesizeOptions options;
      options.seed = seed;
      if (bpm > 0) options.beats = beats_of(bpm);
      motex::DanceRequest request;
      request.num_frames = static_cast<Index>(kSecs / model.frame_time_secs());
      const motex::Dance made = make_dance(model, request, options);
      median += made.beats.median_offset / kSeeds, largest = std::max(largest, made.beats.largest_offset);
      share += made.beats.share_on_beat / kSeeds, stretch += made.beats.median_stretch / kSeeds;
      count += made.beats.num_boundaries;
      reports.push_back(compare_motion(dance.clips, made.clip));
    }
    if (bpm > 0)
      std::printf("%3.0f a minute: median offset %.2f frames, largest %.1f, %.1f %% within one, of %.0f; stretch %.2f;",
                  bpm, median, largest, 100 * share, count, stretch);
    else
      std::printf("without beats:");
    print_ratios(reports);
  }
}

void measure_loops(const motex::bench::Dance& dance, const MotionTexture& model) {
  std::printf("loops: largest second difference at the seam / inside\n");
  for (const Index frames : {120, 300, 600}) {
    std::printf("%3lld frames:", static_cast<long long>(frames));
    std::vector<motex::CompareReport> reports;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      motex::SynthesizeOptions options;
      options.seed = seed;
      motex::DanceRequest request;
      request.num_frames = frames;
      request.is_loop = true;
      const motex::Dance made = make_dance(model, request, options);
      std::printf(" %.2f", made.seam_ratio);
      reports.push_back(compare_motion(dance.clips, repeat_loop(model.features, made.clip, request.step, 4)));
    }
    print_ratios(reports);
  }
}

void measure(const std::filesystem::path& folder) {
  const motex::bench::Dance dance = motex::bench::all_dances(folder).back();
  motex::LearnReport report;
  const MotionTexture model = learn_motion_texture(dance.clips, {}, report);
  std::printf("%s\n", dance.name.c_str());
  measure_beats(dance, model);
  measure_loops(dance, model);
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
