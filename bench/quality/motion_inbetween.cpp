// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Gaps of clips that were not learned from, filled: the errors of LaFAN1 (L2P, L2Q, NPSS) at 30 frames/s against
// interpolation and zero velocity. Every 7th clip is held out; a gap every 40 frames.
#include "bench/motion_data.h"
#include "motex/motion/glitches.h"
#include "motex/motion/inbetween_measures.h"
#include "motex/motion_texture/inbetween.h"
#include "motex/motion_texture/learn.h"

namespace {

using motex::Clip;
using motex::Index;

constexpr int kSplits = 3;
constexpr Index kContext = 10, kEvery = 40;

struct Method {
  std::string name;
  std::vector<motex::InbetweenMeasures> measures;  ///< one a split
};

/// All methods on all gaps of one length.
void fill_gaps(const motex::bench::Split& split, const motex::MotionTexture& model, Index gap,
               std::vector<Method>& methods) {
  const int root = model.features.travelling_joint;
  const motex::Vector deviations = motex::window_position_deviations(split.training, root);
  for (Method& method : methods) method.measures.emplace_back(deviations, root);
  motex::InbetweenOptions lively, mean, unfixed;
  mean.aim = motex::InbetweenAim::kMean;
  unfixed.foot_fix = false;
  const motex::GapShape shape{gap, kContext, kContext}, one_target{gap, kContext, 1};
  const motex::Inbetweener ours[] = {{model, shape, lively},
                                     {model, shape, unfixed},
                                     {model, shape, mean},
                                     {model, one_target, lively},
                                     {model, one_target, mean}};
  for (const Clip& clip : split.held_out)
    for (Index first = kContext; first + gap + kContext <= clip.num_frames(); first += kEvery) {
      methods[0].measures.back().add(clip, hold_gap(clip, first, gap), first);
      methods[1].measures.back().add(clip, interpolate_gap(clip, first, gap), first);
      const Clip before = slice(clip, 0, first), after = slice(clip, first + gap, clip.num_frames() - first - gap);
      motex::InbetweenReport report;
      for (std::size_t i = 0; i < std::size(ours); ++i)
        methods[2 + i].measures.back().add(clip, ours[i].fill(before, i < 3 ? after : slice(after, 0, 1), report),
                                           first);
    }
}

void print_table(Index gap, const std::vector<Method>& methods) {
  std::printf("gap of %lld frames\n", static_cast<long long>(gap));
  for (const Method& method : methods) {
    motex::InbetweenErrors mean;
    const auto n = static_cast<double>(method.measures.size());
    for (const auto& measures : method.measures) {
      const motex::InbetweenErrors e = measures.errors();
      mean.l2p += e.l2p / n, mean.l2q += e.l2q / n, mean.npss += e.npss / n, mean.npss_real += e.npss_real / n;
      mean.num_gaps += e.num_gaps;
    }
    std::printf("  %-32s L2P %6.3f  L2Q %6.3f  NPSS %7.4f  (real part %7.4f)  %lld gaps;  L2P by split",
                method.name.c_str(), mean.l2p, mean.l2q, mean.npss, mean.npss_real,
                static_cast<long long>(mean.num_gaps));
    for (const auto& measures : method.measures) std::printf(" %.3f", measures.errors().l2p);
    std::printf("\n");
  }
}

void measure(const std::filesystem::path& folder) {
  const motex::bench::Dance dance = motex::bench::all_dances(folder).back();
  std::vector<Clip> clips;
  for (const Clip& clip : dance.clips) clips.push_back(resample(clip, 1.0 / 30));
  std::vector<motex::bench::Split> splits;
  std::vector<motex::MotionTexture> models;
  for (int i = 0; i < kSplits; ++i) {
    splits.push_back(motex::bench::split_by_clip(clips, static_cast<std::size_t>(i)));
    motex::LearnReport report;
    models.push_back(learn_motion_texture(splits.back().training, {}, report));
  }
  std::printf("%s at 30 frames/s: %zu clips, %zu held out in each of %d splits; %lld frames before and after\n",
              dance.name.c_str(), clips.size(), splits[0].held_out.size(), kSplits, static_cast<long long>(kContext));
  for (const Index gap : {5, 15, 30, 45}) {
    std::vector<Method> methods{{"zero velocity", {}},
                                {"interpolation", {}},
                                {"motex, lively", {}},
                                {"motex, lively, feet not held", {}},
                                {"motex, mean", {}},
                                {"motex, lively, one frame after", {}},
                                {"motex, mean, one frame after", {}}};
    for (int i = 0; i < kSplits; ++i)
      fill_gaps(splits[static_cast<std::size_t>(i)], models[static_cast<std::size_t>(i)], gap, methods);
    print_table(gap, methods);
  }
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
