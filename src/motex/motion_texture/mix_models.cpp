// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/mix_models.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/quantile.h"
#include "motex/motion/unify.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/texton_fitter.h"

namespace motex {
namespace {

constexpr double kCrossingWeight = 0.3;  // as of any jump (jumps.h)
constexpr double kSameRate = 1e-3;
constexpr double kLeastDeviation = 1;  // cm, as in learning

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void check_mixable(const MotionTexture& a, const MotionTexture& b) {
  const std::string difference = skeleton_difference(a.features.skeleton, b.features.skeleton);
  if (!difference.empty()) throw InvalidInput("the models are of different skeletons: " + difference);
  const double ratio = a.frame_time_secs() / b.frame_time_secs();
  if (std::abs(ratio - 1) > kSameRate) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "the models have different frame rates, %.6g and %.6g Hz; learn one of them anew with --resample",
                  1 / a.frame_time_secs(), 1 / b.frame_time_secs());
    throw InvalidInput(text);
  }
}

/// Runs as clips of their own, each where it stood.
void decode_runs(const MotionTexture& model, std::vector<Clip>& clips) {
  for (std::size_t r = 0; r < model.runs.size(); ++r) {
    const Run& run = model.runs[r];
    RootPlace place;
    for (const Instance& x : model.instances)
      if (x.row == run.row) place = x.place;
    clips.push_back(decode(model.features, model.corpus.middleRows(run.row, run.length).cast<double>(), place));
    clips.back().name = model.clip_names[at(run.clip_idx)];
  }
}

/// Clips, runs and instances of `from` go on behind those of the mixed model. Its new texton numbers.
std::vector<int> append_examples(const MotionTexture& from, MotionTexture& mixed) {
  const auto clip_offset = static_cast<int>(mixed.clip_names.size()), run_offset = static_cast<int>(mixed.runs.size());
  const Index row_offset = mixed.runs.empty() ? 0 : mixed.runs.back().row + mixed.runs.back().length;
  for (std::string name : from.clip_names) {
    while (std::find(mixed.clip_names.begin(), mixed.clip_names.end(), name) != mixed.clip_names.end()) name += " (2)";
    mixed.clip_names.push_back(name);
  }
  mixed.clip_lengths.insert(mixed.clip_lengths.end(), from.clip_lengths.begin(), from.clip_lengths.end());
  std::vector<Index> moved_by;  // rows, of each run: what was dropped is left out
  Index row = row_offset;
  for (const Run& run : from.runs) {
    mixed.runs.push_back({run.clip_idx + clip_offset, run.clip_start, row, run.length});
    moved_by.push_back(row - run.row);
    row += run.length;
  }
  std::vector<int> number(from.textons.size(), -1);
  for (std::size_t i = 0; i < from.textons.size(); ++i) {
    if (!from.textons[i].is_playable()) continue;
    number[i] = static_cast<int>(mixed.textons.size());
    mixed.textons.emplace_back();
  }
  for (const Instance& x : from.instances) {
    Instance moved = x;
    moved.texton = number[at(x.texton)];
    moved.run_idx += run_offset;
    moved.row += moved_by[at(x.run_idx)];
    mixed.textons[at(moved.texton)].instances.push_back(static_cast<int>(mixed.instances.size()));
    mixed.instances.push_back(moved);
  }
  return number;
}

void add_names(const MotionTexture& from, const std::vector<int>& number, MotionTexture& mixed) {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(mixed.edits.begin(), mixed.edits.end(), [&](const ModelEdit& e) { return e.name == name; });
  };
  for (std::size_t i = 0; i < number.size(); ++i) {
    std::string name = from.textons[i].name;
    if (number[i] < 0 || name.empty()) continue;
    while (is_taken(name)) name += " 2";
    mixed.edits.push_back({ModelEdit::Kind::kName, {number[i]}, 1, name});
  }
}

void add_transitions(const MotionTexture& from, const std::vector<int>& number, TransitionMatrix& out) {
  for (const TransitionCount& c : from.transitions.counts())
    if (number[at(c.from)] >= 0 && number[at(c.to)] >= 0) out.add_count(number[at(c.from)], number[at(c.to)], c.count);
}

/// A jump from each example to the nearest one of the other model; instances below num_of_a are a's.
void add_crossings(MotionTexture& model, std::size_t num_of_a, MixReport& report) {
  std::vector<double> crossing, usual;
  const auto& all = model.instances;
  TransitionMatrix crossings(static_cast<int>(model.textons.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Index end = hand_over_row(model, all[k]);
    double across = std::numeric_limits<double>::infinity(), within = across;
    std::size_t nearest = 0;
    for (std::size_t other = 0; other < all.size(); ++other) {
      if (other == k || (other == k + 1 && all[other].run_idx == all[k].run_idx)) continue;
      const double d = key_pose_distance(model.corpus, end, all[other].row);
      if ((other < num_of_a) == (k < num_of_a))
        within = std::min(within, d);
      else if (d < across)
        across = d, nearest = other;
    }
    crossings.add_count(all[k].texton, all[nearest].texton, kCrossingWeight);
    crossing.push_back(across);
    if (std::isfinite(within)) usual.push_back(within);
  }
  for (const TransitionCount& c : crossings.counts()) model.transitions.add_count(c.from, c.to, c.count);
  report.num_crossings = static_cast<int>(crossings.counts().size());
  report.crossing_distance = median(crossing);
  report.usual_distance = median(usual);
}

/// Textons fitted to their own segments in the common space.
void fit_textons(MotionTexture& model, const Corpus& corpus, const JobContext& job) {
  const TextonFitter fitter(corpus, model.options);
  model.global_subspace = fitter.shared();
  model.global_statistics = fitter.shared_statistics();
  const auto dims = static_cast<double>(corpus.features.cols());
  double squares = 0, count = 0;
  if (fitter.is_shared()) {
    model.subspaces = {fitter.shared()};
    squares = (corpus.features.rowwise() - fitter.shared().mean.transpose()).squaredNorm() -
              fitter.shared_states().squaredNorm();
    count = static_cast<double>(corpus.features.rows()) * (dims - static_cast<double>(fitter.shared().basis.cols()));
  }
  for (Texton& texton : model.textons) {
    job.check_cancelled();
    std::vector<LabelledSegment> segments;
    for (const int k : texton.instances) {
      const Instance& x = model.instances[at(k)];
      segments.push_back({x.texton, x.run_idx, x.row, x.length});
    }
    TextonFit fit = fitter.fit(segments, fitter.prior_frames());
    if (!fitter.is_shared()) {
      squares += fit.outside_squares;
      count += fit.statistics.count() * (dims - static_cast<double>(fit.dynamics.state_size()));
      model.subspaces.push_back(std::move(fit.subspace));
    }
    texton.dynamics = std::move(fit.dynamics);
    texton.statistics = std::move(fit.statistics);
  }
  model.outside_deviation =
      count > 0 ? std::max(kLeastDeviation, std::sqrt(std::max(0.0, squares) / count)) : kLeastDeviation;
}

/// Features of all runs in one space.
Corpus encode_runs(const std::vector<Clip>& clips, MotionTexture& model, const JobContext& job) {
  model.features = make_feature_space(clips, job);
  Corpus corpus;
  corpus.runs = model.runs;
  corpus.features.resize(model.runs.back().row + model.runs.back().length, model.features.size());
  for (std::size_t r = 0; r < clips.size(); ++r)
    corpus.features.middleRows(model.runs[r].row, model.runs[r].length) = encode(model.features, clips[r], job);
  model.corpus = corpus.features.cast<float>();
  for (Instance& x : model.instances)
    x.place = root_place(model.features, clips[at(x.run_idx)], x.row - model.runs[at(x.run_idx)].row);
  return corpus;
}

}  // namespace

MotionTexture mix_models(const MotionTexture& a, const MotionTexture& b, MixReport& report, const JobContext& job) {
  check_mixable(a, b);
  report = {};
  MotionTexture mixed;
  mixed.options = a.options;
  const bool both_own = a.options.basis == Basis::kOwn && b.options.basis == Basis::kOwn;
  mixed.options.basis = both_own ? Basis::kOwn : Basis::kShared;
  report.textons_of_a = append_examples(a, mixed);
  const std::size_t num_of_a = mixed.instances.size();
  report.textons_of_b = append_examples(b, mixed);
  add_names(a, report.textons_of_a, mixed);
  add_names(b, report.textons_of_b, mixed);

  std::vector<Clip> clips;
  decode_runs(a, clips);
  decode_runs(b, clips);
  for (Clip& clip : clips) clip.frame_time_secs = a.frame_time_secs();
  unify_clips(clips, job);
  const Corpus corpus = encode_runs(clips, mixed, job);
  job.progress("fitting textons", 0.4);
  fit_textons(mixed, corpus, job);
  mixed.transitions = TransitionMatrix(static_cast<int>(mixed.textons.size()), a.transitions.prior_count());
  add_transitions(a, report.textons_of_a, mixed.transitions);
  add_transitions(b, report.textons_of_b, mixed.transitions);
  add_crossings(mixed, num_of_a, report);
  mixed.feet = learn_foot_model(clips, {}, job);
  job.progress("mixed", 1);
  return mixed;
}

}  // namespace motex
