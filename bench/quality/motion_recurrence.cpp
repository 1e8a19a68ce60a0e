// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Do textons recur? Clips that were not learned from are recognised, on three splits by clip: how far their segments
// are from the training segments of their label (measure_recurrence()), how many of their transitions are known, how
// well their frames are predicted. Then the trade-off: what path_weight and the number of textons do to all of it.
#include <string_view>

#include "bench/motion_data.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/recurrence.h"

namespace {

constexpr std::size_t kSplits = 3;

double gain(const motex::ScoreReport& score) {
  return score.log_likelihood_per_frame - score.global_lds_log_likelihood_per_frame;
}

void print_split(const std::string& name, const motex::bench::Split& split, const motex::LearnOptions& options,
                 bool with_control) {
  motex::LearnReport learned;
  const motex::MotionTexture model = motex::learn_motion_texture(split.training, options, learned);
  const motex::RecurrenceReport report = motex::measure_recurrence(model, split.held_out);
  std::printf("%-22s %4d %5d %5.2f   %5.1f / %5.1f = %5.3f (%5.1f)   %5.3f / %5.3f = %4.1f (%3d)   %+6.2f  %+6.2f",
              name.c_str(), learned.num_textons, learned.num_segments,
              static_cast<double>(learned.num_segments) / learned.num_textons, report.distance_to_label,
              report.distance_to_random, report.distance_ratio(), report.distance_to_nearest, report.transitions_seen,
              report.transitions_chance, report.transitions_seen / report.transitions_chance, report.num_transitions,
              gain(motex::score_clips(model, split.held_out)),
              report.log_likelihood_per_frame - report.global_lds_log_likelihood_per_frame);
  if (with_control) {
    motex::LearnOptions control = options;
    control.common_dynamics = true;
    const motex::MotionTexture noise_only = motex::learn_motion_texture(split.training, control, learned);
    std::printf("  %+6.2f", gain(motex::score_clips(noise_only, split.held_out)));
  }
  std::printf("\n");
}

void measure(const std::filesystem::path& folder, bool with_curve) {
  const motex::bench::Dance dance = motex::bench::all_dances(folder).back();
  std::printf("%s; wanted: segments/texton >= 4, distance ratio <= 0.55, seen >= 4 x chance, gain >= +5\n",
              dance.name.c_str());
  std::printf(
      "                       textons segs  s/t     label  random   ratio (nearest)  seen  chance           (n)"
      "   nats: best, along labels, noise only\n");
  for (std::size_t s = 0; s < kSplits; ++s)
    print_split("default, split " + std::to_string(s), motex::bench::split_by_clip(dance.clips, s), {}, true);
  if (!with_curve) return;
  const motex::bench::Split split = motex::bench::split_by_clip(dance.clips, 0);
  for (const double weight : {0.0, 1.0, 2.0, 4.0, 16.0}) {
    motex::LearnOptions options;
    options.path_weight = weight;
    print_split("path_weight " + std::to_string(weight).substr(0, 4), split, options, false);
  }
  for (const double pieces : {2.0, 3.5, 7.0, 10.0}) {
    motex::LearnOptions options;
    options.threshold = pieces;
    print_split("threshold " + std::to_string(pieces).substr(0, 4), split, options, false);
  }
}

}  // namespace

/// motion_recurrence [FOLDER [splits]]: with "splits", without the curve.
int main(int argc, char** argv) {
  const bool with_curve = argc < 3 || std::string_view(argv[2]) != "splits";
  return motex::bench::run(argc, argv, [&](const std::filesystem::path& folder) { measure(folder, with_curve); });
}
