// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/markov/segmentation.h"
#include "motex/motion_texture/emissions.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/subspace.h"

namespace motex {
namespace {

struct Emissions {
  FrameMatrix features;
  FrameMatrixF values;  ///< frames × textons
};

/// F of every frame of a clip under every texton, or under the one global system.
Emissions evaluate(const MotionTexture& model, const Clip& clip, bool global, const JobContext& job) {
  Emissions out;
  out.features = encode(model.features, clip, job);
  const std::vector<Run> runs{{0, 0, 0, out.features.rows()}};
  const bool shared = global || model.subspaces.size() == 1;
  const Subspace& space = global ? model.global_subspace : model.subspaces[0];
  EmissionBank bank(out.features, runs, shared ? &space : nullptr, model.outside_deviation);
  std::vector<int> all;
  if (global) {
    bank.set_texton(0, space, fit_lds(model.global_statistics, make_prior(model.global_statistics, 1)));
    all.push_back(0);
  } else {
    for (int i = 0; i < static_cast<int>(model.textons.size()); ++i) {
      bank.set_texton(i, model.subspace(i), model.textons[static_cast<std::size_t>(i)].dynamics);
      all.push_back(i);
    }
  }
  out.values.resize(out.features.rows(), static_cast<Index>(all.size()));
  bank.evaluate(all, out.values, job);
  return out;
}

/// Transitions with the learner's prior on top of the observed counts and jumps, so that a new clip may do anything.
TransitionMatrix open_transitions(const MotionTexture& model) {
  TransitionMatrix transitions = model.transitions;
  transitions.set_prior_count(model.options.transition_prior);
  return transitions;
}

SegmentOptions segment_rules(const MotionTexture& model) {
  const double frame = model.frame_time_secs();
  return {std::max<Index>(5, std::lround(model.options.min_duration / frame)),
          std::max<Index>(10, std::lround(model.options.max_duration / frame)), 0};
}

}  // namespace

std::vector<RecognisedSegment> segment_clip(const MotionTexture& model, const Clip& clip) {
  const Emissions emissions = evaluate(model, clip, false, {});
  const TransitionMatrix transitions = open_transitions(model);
  const SegmentationInput input{emissions.values, {}, transitions, segment_rules(model)};
  std::vector<RecognisedSegment> out;
  for (const Segment& s : segment_sequence(input).segments)
    out.push_back({s.state, s.start, s.length, segment_score(input, s) / static_cast<double>(s.length)});
  if (out.empty()) throw InvalidInput(clip.name + ": no lengths of segments add up to the clip");
  return out;
}

ScoreReport score_clips(const MotionTexture& model, std::span<const Clip> clips, const JobContext& job) {
  ScoreReport report;
  double textons = 0, global = 0;
  const TransitionMatrix transitions = open_transitions(model);
  for (const Clip& clip : clips) {
    job.check_cancelled();
    if (clip.num_frames() < 3) throw InvalidInput(clip.name + ": a clip needs at least 3 frames to be scored");
    const Emissions own = evaluate(model, clip, false, job);
    const SegmentationReport best = segment_sequence({own.values, {}, transitions, segment_rules(model)});
    if (!best.is_feasible()) throw InvalidInput(clip.name + ": no lengths of segments add up to the clip");
    textons += best.score;
    global += evaluate(model, clip, true, job).values.cast<double>().sum();
    report.num_frames += clip.num_frames() - 2;
  }
  if (report.num_frames == 0) throw InvalidInput("no clip to score");
  report.log_likelihood_per_frame = textons / static_cast<double>(report.num_frames);
  report.global_lds_log_likelihood_per_frame = global / static_cast<double>(report.num_frames);
  return report;
}

}  // namespace motex
