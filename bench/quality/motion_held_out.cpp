// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// How well clips that were not learned from are predicted: nats per frame more than one global linear dynamic system of
// the same state size, beside the control whose textons differ in noise alone.
#include "bench/motion_data.h"
#include "motex/motion_texture/learn.h"

namespace {

using motex::bench::Dance;

constexpr int kSplits = 3;

struct Gain {
  double nats = 0;  ///< per frame over the global system
  std::vector<double> by_clip;
  int num_textons = 0;
};

double nats_gained(const motex::ScoreReport& score) {
  return score.log_likelihood_per_frame - score.global_lds_log_likelihood_per_frame;
}

Gain held_out_gain(const motex::bench::Split& split, const motex::LearnOptions& options) {
  motex::LearnReport report;
  const motex::MotionTexture model = motex::learn_motion_texture(split.training, options, report);
  const motex::ScoreReport score = motex::score_clips(model, split.held_out);
  Gain gain{nats_gained(score), {}, report.num_textons};
  for (const motex::Clip& clip : split.held_out)
    gain.by_clip.push_back(nats_gained(motex::score_clips(model, {&clip, 1})));
  return gain;
}

struct Row {
  const char* name;
  motex::LearnOptions options;
  const char* known;
};

void print_splits(const std::vector<motex::bench::Split>& splits, const Row& row) {
  std::string gains, controls, textons;
  std::vector<double> by_clip;
  double sum = 0, control_sum = 0;
  for (const motex::bench::Split& split : splits) {
    const Gain gain = held_out_gain(split, row.options);
    sum += gain.nats;
    by_clip.insert(by_clip.end(), gain.by_clip.begin(), gain.by_clip.end());
    char text[64];
    std::snprintf(text, sizeof text, "%+7.2f", gain.nats);
    gains += text;
    textons += (textons.empty() ? "" : ", ") + std::to_string(gain.num_textons);
    if (row.options.basis == motex::Basis::kOwn) continue;  // the control is for the shared basis
    motex::LearnOptions control = row.options;
    control.common_dynamics = true;
    const Gain noise_only = held_out_gain(split, control);
    control_sum += noise_only.nats;
    std::snprintf(text, sizeof text, "%+7.2f", noise_only.nats);
    controls += text;
  }
  const auto n = static_cast<double>(splits.size());
  const auto [lowest, highest] = std::minmax_element(by_clip.begin(), by_clip.end());
  std::printf("%-16s %s   mean %+6.2f   clips %+.2f ... %+.2f ... %+.2f   noise only ", row.name, gains.c_str(),
              sum / n, *lowest, motex::bench::median(by_clip), *highest);
  if (controls.empty())
    std::printf("(none for own)");
  else
    std::printf("%s   mean %+6.2f", controls.c_str(), control_sum / n);
  std::printf("   textons %s   known %s\n", textons.c_str(), row.known);
}

void print_curve(const motex::bench::Split& split) {
  std::printf("curve on split 0: full, noise only\n");
  const auto print_point = [&](const char* name, int value, motex::LearnOptions options) {
    const Gain gain = held_out_gain(split, options);
    options.common_dynamics = true;
    const Gain control = held_out_gain(split, options);
    std::printf("  %-10s %5d   %+6.2f (clips: median %+6.2f)   %+6.2f   %3d textons\n", name, value, gain.nats,
                motex::bench::median(gain.by_clip), control.nats, gain.num_textons);
  };
  for (const int state_size : {10, 15, 20, 25, 30, 40}) {
    motex::LearnOptions options;
    options.path_weight = 0;
    options.state_size = state_size;
    print_point("state size", state_size, options);
  }
  for (const int prior : {30, 100, 300, 1000}) {
    motex::LearnOptions options;
    options.path_weight = 0;
    options.prior = prior;
    print_point("prior", prior, options);
  }
}

void measure(const std::filesystem::path& folder) {
  const Dance dance = motex::bench::all_dances(folder).back();
  std::vector<motex::bench::Split> splits;
  for (std::size_t i = 0; i < kSplits; ++i) splits.push_back(motex::bench::split_by_clip(dance.clips, i));
  std::printf("%s, %zu clips, %zu held out in each of %d splits by clip; wanted: shared >= +7\n", dance.name.c_str(),
              dance.clips.size(), splits[0].held_out.size(), kSplits);
  std::printf("nats per frame over one global LDS of the same state size; clips: lowest, median, highest\n");
  motex::LearnOptions moves, shared, greedy, own;
  shared.path_weight = greedy.path_weight = 0;
  greedy.init = motex::Init::kGreedy;
  own.basis = motex::Basis::kOwn;
  print_splits(splits, {"shared, moves", moves, "(default)"});
  print_splits(splits, {"shared, merge", shared, "+7.8, of which +6.7 noise"});
  print_splits(splits, {"shared, greedy", greedy, "+5.8"});
  print_splits(splits, {"own, greedy", own, "no better"});
  print_curve(splits[0]);
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
