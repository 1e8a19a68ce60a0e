// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "motex/core/error.h"
#include "motex/markov/segmentation.h"
#include "motex/motion_texture/corpus.h"
#include "motex/motion_texture/emissions.h"
#include "motex/motion_texture/learn.h"

namespace motex {
namespace {

/// F of every frame of the runs under every texton, or under the one global system: frames × textons.
FrameMatrixF evaluate(const MotionTexture& model, const Corpus& corpus, bool global, const JobContext& job) {
  const bool shared = global || model.subspaces.size() == 1;
  const Subspace& space = global ? model.global_subspace : model.subspaces[0];
  EmissionBank bank(corpus.features, corpus.runs, shared ? &space : nullptr, model.outside_deviation);
  std::vector<int> all;
  if (global) {
    bank.set_texton(0, space, fit_lds(model.global_statistics, make_prior(model.global_statistics, 1)));
    all.push_back(0);
  } else {
    for (int i = 0; i < static_cast<int>(model.textons.size()); ++i) {
      bank.set_texton(i, model.subspace(i), model.textons[static_cast<std::size_t>(i)].dynamics);
      if (model.textons[static_cast<std::size_t>(i)].is_playable()) all.push_back(i);
    }
  }
  FrameMatrixF values(corpus.features.rows(), bank.num_textons());
  values.setConstant(-std::numeric_limits<float>::infinity());  // dropped textons
  bank.evaluate(all, values, job);
  return values;
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
  if (clip.num_frames() < 3)
    throw InvalidInput(clip.name + ": has " + std::to_string(clip.num_frames()) +
                       " frames; a texton can be recognised from 3 on");
  Corpus corpus;
  corpus.features = encode(model.features, clip);
  corpus.runs = {{0, 0, 0, clip.num_frames()}};
  const FrameMatrixF emissions = evaluate(model, corpus, false, {});
  const TransitionMatrix transitions = open_transitions(model);
  const SegmentationInput input{emissions, {}, transitions, segment_rules(model)};
  std::vector<RecognisedSegment> out;
  for (const Segment& s : segment_sequence(input).segments)
    out.push_back({s.state, s.start, s.length, segment_score(input, s) / static_cast<double>(s.length)});
  if (out.empty()) throw InvalidInput(clip.name + ": no lengths of segments add up to the clip");
  return out;
}

ScoreReport score_clips(const MotionTexture& model, std::span<const Clip> clips, const JobContext& job) {
  const SegmentOptions rules = segment_rules(model);
  const Corpus corpus = make_corpus(model.features, clips, rules.min_length, model.options.keep_glitches, job);
  const TransitionMatrix transitions = open_transitions(model);
  const FrameMatrixF own = evaluate(model, corpus, false, job);
  ScoreReport report;
  double textons = 0;
  for (const Run& run : corpus.runs) {
    job.check_cancelled();
    const SegmentationReport best = segment_sequence({own.middleRows(run.row, run.length), {}, transitions, rules});
    if (!best.is_feasible()) throw InvalidInput("no lengths of segments add up to a stretch of a clip");
    textons += best.score;
    report.num_frames += run.length - 2;
  }
  const double global = evaluate(model, corpus, true, job).cast<double>().sum();
  report.log_likelihood_per_frame = textons / static_cast<double>(report.num_frames);
  report.global_lds_log_likelihood_per_frame = global / static_cast<double>(report.num_frames);
  return report;
}

}  // namespace motex
