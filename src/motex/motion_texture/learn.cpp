// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/learn.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "motex/core/options_check.h"
#include "motex/markov/graph.h"
#include "motex/motion_texture/corpus.h"
#include "motex/motion_texture/expectation_maximisation.h"
#include "motex/motion_texture/initial_segments.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/subspace.h"

namespace motex {
namespace {

constexpr double kGreedyShare = 0.45;  // of the distance of two random poses
constexpr double kPiecesPerTexton = 5.1;
constexpr double kSmallGain = 1e-5;  // nats per frame: EM has settled

struct Durations {
  Index min_frames, max_frames;
};

Durations durations(const LearnOptions& options, double frame_time_secs) {
  if (!(frame_time_secs >= kLeastFrameTimeSecs && frame_time_secs <= kMostFrameTimeSecs))
    throw InvalidInput("the clips have " + std::to_string(1 / frame_time_secs) +
                       " frames a second; give the true rate with --fps");
  if (options.max_duration < 2 * options.min_duration)
    throw InvalidInput("max_duration must be at least twice min_duration");
  const auto frames = [&](double secs) { return static_cast<Index>(std::lround(secs / frame_time_secs)); };
  return {std::max<Index>(frames(options.min_duration), 5), std::max<Index>(frames(options.max_duration), 10)};
}

bool starts_greedy(const LearnOptions& options) {
  return options.init == Init::kGreedy || (options.init == Init::kAuto && options.basis == Basis::kOwn);
}

Segmentation first_segments(const Corpus& corpus, const TextonFitter& fitter, const LearnOptions& options,
                            const MovePaths* paths, const Durations& limits, LearnReport& report,
                            const JobContext& job) {
  if (!starts_greedy(options) && paths != nullptr) {
    report.threshold = options.threshold > 0 ? options.threshold : kPiecesPerTexton;
    return merged_moves(corpus, *paths, report.threshold, limits.min_frames, job);
  }
  if (!starts_greedy(options)) {
    report.threshold = options.threshold;
    return merged_segments(corpus, fitter, options.threshold, limits.min_frames, job);
  }
  report.threshold =
      options.threshold > 0 ? options.threshold : kGreedyShare * random_pose_distance(corpus, options.seed);
  return greedy_segments(corpus, fitter, report.threshold, limits.min_frames, limits.max_frames, job);
}

/// What textons are besides dynamics; none with own bases, without weight, or where nothing moves.
std::optional<MovePaths> move_paths(const Corpus& corpus, const TextonFitter& fitter, const LearnOptions& options,
                                    Index min_frames) {
  if (!fitter.is_shared() || options.path_weight == 0) return std::nullopt;
  MovePaths paths(fitter.shared_states(), corpus.runs, min_frames, options.path_weight);
  return paths.size() > 0 ? std::optional(std::move(paths)) : std::nullopt;
}

void run_em(ExpectationMaximisation& em, const LearnOptions& options, Index frames, LearnReport& report,
            const JobContext& job) {
  for (int i = 0; i < options.max_iterations && !report.converged; ++i) {
    report.objective.push_back(em.iterate(job));
    const std::size_t n = report.objective.size();
    const double gain = n > 1 ? report.objective[n - 1] - report.objective[n - 2] : HUGE_VAL;
    report.converged = em.converged() || gain < kSmallGain * static_cast<double>(frames);
    job.progress("learning textons", 0.3 + 0.65 * (i + 1) / options.max_iterations);
  }
  em.finish(job);
}

/// Textons without a segment are dropped, the others numbered in order of first appearance.
void keep_used_textons(const ExpectationMaximisation& em, const TextonFitter& fitter, MotionTexture& model) {
  std::vector<int> name(em.textons().size(), -1);
  if (fitter.is_shared()) model.subspaces.push_back(fitter.shared());
  for (const LabelledSegment& segment : em.segments()) {
    int& texton = name[static_cast<std::size_t>(segment.texton)];
    if (texton < 0) {
      texton = static_cast<int>(model.textons.size());
      const TextonFit& fit = em.textons()[static_cast<std::size_t>(segment.texton)];
      model.textons.push_back({fit.dynamics, fit.statistics, {}});
      if (!fitter.is_shared()) model.subspaces.push_back(fit.subspace);
    }
    model.textons[static_cast<std::size_t>(texton)].instances.push_back(static_cast<int>(model.instances.size()));
    model.instances.push_back({texton, segment.run_idx, segment.row, segment.length, {}});
  }
}

void find_places(std::span<const Clip> clips, MotionTexture& model) {
  for (Instance& instance : model.instances) {
    const Run& run = model.runs[static_cast<std::size_t>(instance.run_idx)];
    instance.place = root_place(model.features, clips[static_cast<std::size_t>(run.clip_idx)],
                                run.clip_start + instance.row - run.row);
  }
}

void describe_graph(const MotionTexture& model, LearnReport& report) {
  TransitionMatrix observed(static_cast<int>(model.textons.size()), 0);
  for (std::size_t k = 1; k < model.instances.size(); ++k)
    if (model.instances[k].run_idx == model.instances[k - 1].run_idx)
      observed.add_count(model.instances[k - 1].texton, model.instances[k].texton);
  report.num_dead_ends = static_cast<int>(dead_ends(counted_graph(observed)).size());
  const Components components = strongly_connected_components(counted_graph(model.transitions));
  report.num_components = static_cast<int>(components.members.size());
  report.largest_component =
      static_cast<double>(components.largest().size()) / static_cast<double>(model.textons.size());
}

}  // namespace

MotionTexture learn_motion_texture(std::span<const Clip> clips, const LearnOptions& options, LearnReport& report,
                                   const JobContext& job) {
  check_options(options);
  report = {};
  MotionTexture model;
  model.options = options;
  model.features = make_feature_space(clips, job);
  const Durations limits = durations(options, model.features.frame_time_secs);
  Corpus corpus = make_corpus(model.features, clips, limits.min_frames, options.keep_glitches, job);
  job.progress("finding the subspace", 0.02);
  const TextonFitter fitter(corpus, options);
  const std::optional<MovePaths> paths = move_paths(corpus, fitter, options, limits.min_frames);
  const MovePaths* path_of_moves = paths ? &*paths : nullptr;
  Segmentation start = first_segments(corpus, fitter, options, path_of_moves, limits, report, job);
  ExpectationMaximisation em(corpus, fitter, options, limits.min_frames, limits.max_frames, std::move(start),
                             path_of_moves);
  run_em(em, options, corpus.features.rows(), report, job);

  keep_used_textons(em, fitter, model);
  model.outside_deviation = em.outside_deviation();
  model.global_subspace = fitter.shared();
  model.global_statistics = fitter.shared_statistics();
  model.corpus = corpus.features.cast<float>();
  model.heights = corpus.features.col(2);
  model.runs = corpus.runs;
  find_places(clips, model);
  for (const Clip& clip : clips) {
    model.clip_names.push_back(clip.name);
    model.clip_lengths.push_back(clip.num_frames());
  }
  model.transitions = transitions_with_jumps(model);
  model.feet = learn_foot_model(clips, {}, job);

  report.num_frames = corpus.features.rows();
  report.num_glitch_frames = corpus.num_glitch_frames;
  report.num_clips = static_cast<int>(clips.size());
  report.num_textons = static_cast<int>(model.textons.size());
  report.num_segments = static_cast<int>(model.instances.size());
  report.state_size = static_cast<int>(fitter.shared().basis.cols());
  describe_graph(model, report);
  job.progress("learned", 1);
  return model;
}

}  // namespace motex
