// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/recognition.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/motion_texture/emissions.h"
#include "motex/motion_texture/move_path.h"
#include "motex/motion_texture/subspace.h"

namespace motex {
namespace {

FrameMatrixF texton_emissions(const MotionTexture& model, const Corpus& corpus, const JobContext& job) {
  const bool shared = model.subspaces.size() == 1;
  EmissionBank bank(corpus.features, corpus.runs, shared ? &model.subspaces[0] : nullptr, model.outside_deviation);
  std::vector<int> playable;
  for (int i = 0; i < static_cast<int>(model.textons.size()); ++i) {
    bank.set_texton(i, model.subspace(i), model.textons[static_cast<std::size_t>(i)].dynamics);
    if (model.textons[static_cast<std::size_t>(i)].is_playable()) playable.push_back(i);
  }
  FrameMatrixF values(corpus.features.rows(), bank.num_textons());
  values.setConstant(-std::numeric_limits<float>::infinity());  // dropped textons
  bank.evaluate(playable, values, job);
  return values;
}

/// The textons' paths follow from their instances, so that they need no place in files and follow a person's edits.
FrameMatrixF path_densities(const MotionTexture& model, const Corpus& corpus, Index min_frames, const JobContext& job) {
  const bool has_paths = model.options.basis == Basis::kShared && model.options.path_weight > 0;
  if (!has_paths || model.subspaces.size() != 1) return {};
  const Subspace& space = model.subspaces[0];
  const MovePaths moves(project(space, model.corpus.cast<double>()), model.runs, min_frames, model.options.path_weight);
  if (moves.size() == 0) return {};
  std::vector<Vector> paths;
  for (const Texton& texton : model.textons) {
    PathStatistics sum = moves.nothing();
    for (const int k : texton.instances) sum += moves.observe(model.instances[static_cast<std::size_t>(k)].row);
    paths.push_back(moves.path(sum));
  }
  return moves.start_densities(moves.windows(project(space, corpus.features), corpus.runs), paths, job);
}

SegmentOptions segment_rules(const MotionTexture& model) {
  return {shortest_segment(model),
          std::max<Index>(10, std::lround(model.options.max_duration / model.frame_time_secs())), 0};
}

SegmentationReport best(const SegmentationInput& input) {
  SegmentationReport report = segment_sequence(input);
  if (!report.is_feasible()) throw InvalidInput("no lengths of segments add up to a stretch of a clip");
  return report;
}

}  // namespace

Recognition::Recognition(const MotionTexture& model, const Corpus& corpus, const JobContext& job)
    : rules_(segment_rules(model)),
      transitions_(model.transitions),
      emissions_(texton_emissions(model, corpus, job)),
      starts_(path_densities(model, corpus, rules_.min_length, job)) {
  // The learner's prior on top of the observed counts and jumps, so that a new clip may do anything.
  transitions_.set_prior_count(model.options.transition_prior);
}

SegmentationInput Recognition::input(const Run& run, bool with_paths) const {
  const bool has = with_paths && starts_.size() > 0;
  return {emissions_.middleRows(run.row, run.length),
          {},
          transitions_,
          rules_,
          starts_.middleRows(has ? run.row : 0, has ? run.length : 0)};
}

SegmentationReport Recognition::by_dynamics(const Run& run) const { return best(input(run, false)); }

std::vector<Segment> Recognition::by_moves(const Run& run) const { return best(input(run, true)).segments; }

double Recognition::log_likelihood(const Run& run, const std::vector<Segment>& segments) const {
  return score_segmentation(input(run, false), segments);
}

Index shortest_segment(const MotionTexture& model) {
  return std::max<Index>(5, std::lround(model.options.min_duration / model.frame_time_secs()));
}

Vector global_log_densities(const MotionTexture& model, const Corpus& corpus, const JobContext& job) {
  EmissionBank bank(corpus.features, corpus.runs, &model.global_subspace, model.outside_deviation);
  bank.set_texton(0, model.global_subspace, fit_lds(model.global_statistics, make_prior(model.global_statistics, 1)));
  FrameMatrixF values(corpus.features.rows(), 1);
  bank.evaluate({0}, values, job);
  return values.col(0).cast<double>();
}

}  // namespace motex
