// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/recurrence.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/motion_texture/recognition.h"

namespace motex {
namespace {

struct Distances {
  bool is_counted = false;
  double label = 0, random = 0, nearest = 0;
};

/// Of the segment of that texton that starts at `row` of the frames.
Distances distances(const MotionTexture& model, const FrameMatrixF& frames, Index row, int texton, Index num_frames) {
  Vector sums = Vector::Zero(static_cast<Index>(model.textons.size())), counts = sums;
  for (const Instance& instance : model.instances) {
    if (instance.length < num_frames) continue;
    double sum = 0;
    for (Index t = 0; t < num_frames; ++t)
      sum += static_cast<double>((frames.row(row + t) - model.corpus.row(instance.row + t)).norm());
    sums(instance.texton) += sum / static_cast<double>(num_frames);
    ++counts(instance.texton);
  }
  Distances out;
  if (counts(texton) == 0) return out;
  out = {true, sums(texton) / counts(texton), sums.sum() / counts.sum(), HUGE_VAL};
  for (Index i = 0; i < sums.size(); ++i)
    if (counts(i) > 0) out.nearest = std::min(out.nearest, sums(i) / counts(i));
  return out;
}

using Pairs = std::vector<std::pair<int, int>>;

void measure_transitions(const MotionTexture& model, const Pairs& found, RecurrenceReport& report) {
  std::set<std::pair<int, int>> known;
  for (std::size_t k = 1; k < model.instances.size(); ++k)
    if (model.instances[k].run_idx == model.instances[k - 1].run_idx)
      known.insert({model.instances[k - 1].texton, model.instances[k].texton});
  std::size_t seen = 0, by_chance = 0;
  for (const auto& [from, to] : found) {
    seen += known.count({from, to});
    for (const auto& [other, other_to] : found) by_chance += known.count({from, other_to});
  }
  const auto n = static_cast<double>(std::max<std::size_t>(found.size(), 1));
  report.num_transitions = static_cast<int>(found.size());
  report.transitions_seen = static_cast<double>(seen) / n;
  report.transitions_chance = static_cast<double>(by_chance) / (n * n);
}

}  // namespace

RecurrenceReport measure_recurrence(const MotionTexture& model, std::span<const Clip> clips, const JobContext& job) {
  RecurrenceReport report;
  const Corpus corpus = make_corpus(model.features, clips, shortest_segment(model), model.options.keep_glitches, job);
  const Recognition recognition(model, corpus, job);
  const Index num_frames = recognition.rules().min_length;
  std::vector<std::pair<Index, int>> segments;  // first row, texton
  Pairs transitions;
  double log_likelihood = 0, counted_frames = 0;
  for (const Run& run : corpus.runs) {
    job.check_cancelled();
    const std::vector<Segment> found = recognition.by_moves(run);
    log_likelihood += recognition.log_likelihood(run, found);
    counted_frames += static_cast<double>(run.length - 2);
    report.num_segments += static_cast<int>(found.size());
    for (std::size_t k = 1; k < found.size(); ++k) transitions.emplace_back(found[k - 1].state, found[k].state);
    for (const Segment& segment : found)
      if (segment.length >= num_frames) segments.emplace_back(run.row + segment.start, segment.state);
  }
  const FrameMatrixF frames = corpus.features.cast<float>();
  std::vector<Distances> all(segments.size());
  parallel_for(job.jobs, static_cast<int>(segments.size()), [&](int k) {
    job.check_cancelled();
    const auto& [row, texton] = segments[static_cast<std::size_t>(k)];
    all[static_cast<std::size_t>(k)] = distances(model, frames, row, texton, num_frames);
  });
  double counted = 0;
  for (const Distances& d : all) {
    if (!d.is_counted) continue;
    ++counted;
    report.distance_to_label += d.label;
    report.distance_to_random += d.random;
    report.distance_to_nearest += d.nearest;
  }
  if (counted == 0) throw InvalidInput("no segment of the clips is as long as the shortest of the model");
  report.distance_to_label /= counted;
  report.distance_to_random /= counted;
  report.distance_to_nearest /= counted;
  measure_transitions(model, transitions, report);
  report.log_likelihood_per_frame = log_likelihood / counted_frames;
  report.global_lds_log_likelihood_per_frame = global_log_densities(model, corpus, job).sum() / counted_frames;
  return report;
}

}  // namespace motex
