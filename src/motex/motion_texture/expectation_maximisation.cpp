// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/expectation_maximisation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "motex/core/parallel.h"
#include "motex/markov/segmentation.h"

namespace motex {
namespace {

constexpr double kLeastDeviation = 1;  // cm

bool same_segments(const std::vector<LabelledSegment>& a, const std::vector<LabelledSegment>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LabelledSegment& x, const LabelledSegment& y) {
    return x.row == y.row && x.length == y.length && x.texton == y.texton;
  });
}

}  // namespace

ExpectationMaximisation::ExpectationMaximisation(const Corpus& corpus, const TextonFitter& fitter,
                                                 const LearnOptions& options, Index min_frames, Index max_frames,
                                                 Segmentation start, const MovePaths* paths)
    : corpus_(corpus),
      fitter_(fitter),
      options_(options),
      min_frames_(min_frames),
      max_frames_(max_frames),
      segments_(std::move(start)),
      paths_(paths) {
  int textons = 0;
  for (const LabelledSegment& segment : segments_) textons = std::max(textons, segment.texton + 1);
  fits_.resize(static_cast<std::size_t>(textons));
  fitted_to_.resize(fits_.size());
}

std::vector<std::vector<LabelledSegment>> ExpectationMaximisation::by_texton() const {
  std::vector<std::vector<LabelledSegment>> out(fits_.size());
  for (const LabelledSegment& segment : segments_) out[static_cast<std::size_t>(segment.texton)].push_back(segment);
  return out;
}

/// Of one texton's frames and prior to J.
double ExpectationMaximisation::contribution(const TextonFit& fit) const {
  double sum = log_likelihood(fit.dynamics, fit.statistics) + fit.log_prior;
  if (!fitter_.is_shared()) {
    const auto dims = static_cast<double>(corpus_.features.cols() - fit.dynamics.state_size());
    sum -= 0.5 * (fit.statistics.count() * dims * std::log(2 * std::numbers::pi * deviation_ * deviation_) +
                  fit.outside_squares / (deviation_ * deviation_));
  }
  return sum;
}

TextonFit ExpectationMaximisation::refit(int texton, const std::vector<LabelledSegment>& own) const {
  const TextonFit& before = fits_[static_cast<std::size_t>(texton)];
  const bool is_first = before.dynamics.offset.size() == 0;
  if (fitter_.is_shared()) return fitter_.fit(own, fitter_.prior_frames());
  if (own.empty()) return fitter_.fit_within(before.subspace, own, fitter_.prior_frames());
  TextonFit fit = fitter_.fit(own, fitter_.prior_frames());
  if (is_first) return fit;
  // A new subspace need not be better under J; the best dynamics in the old one are never worse than before.
  TextonFit kept = fitter_.fit_within(before.subspace, own, fitter_.prior_frames());
  return contribution(fit) >= contribution(kept) ? fit : kept;
}

/// s: what lies outside the subspaces under the first segmentation, never less than 1 cm. Kept from then on.
double ExpectationMaximisation::choose_deviation() const {
  double squares = 0, count = 0;
  const auto dims = static_cast<double>(corpus_.features.cols());
  if (fitter_.is_shared()) {
    const auto& shared = fitter_.shared();
    squares =
        (corpus_.features.rowwise() - shared.mean.transpose()).squaredNorm() - fitter_.shared_states().squaredNorm();
    count = static_cast<double>(corpus_.features.rows()) * (dims - static_cast<double>(shared.basis.cols()));
  } else {
    for (const TextonFit& fit : fits_) {
      squares += fit.outside_squares;
      count += fit.statistics.count() * (dims - static_cast<double>(fit.dynamics.state_size()));
    }
  }
  return count > 0 ? std::max(kLeastDeviation, std::sqrt(std::max(0.0, squares) / count)) : kLeastDeviation;
}

void ExpectationMaximisation::maximise(const JobContext& job) {
  const auto own = by_texton();
  std::vector<int> changed;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!bank_ || !same_segments(own[i], fitted_to_[i])) changed.push_back(static_cast<int>(i));
  parallel_for(job.jobs, static_cast<int>(changed.size()), [&](int c) {
    job.check_cancelled();
    const int i = changed[static_cast<std::size_t>(c)];
    fits_[static_cast<std::size_t>(i)] = refit(i, own[static_cast<std::size_t>(i)]);
  });
  fitted_to_ = own;
  if (!bank_) {
    deviation_ = choose_deviation();
    bank_ = std::make_unique<EmissionBank>(corpus_.features, corpus_.runs,
                                           fitter_.is_shared() ? &fitter_.shared() : nullptr, deviation_);
    emissions_.resize(corpus_.features.rows(), static_cast<Index>(fits_.size()));
  }
  for (const int i : changed) {
    const TextonFit& fit = fits_[static_cast<std::size_t>(i)];
    bank_->set_texton(i, fitter_.is_shared() ? fitter_.shared() : fit.subspace, fit.dynamics);
  }
  if (!changed.empty()) bank_->evaluate(changed, emissions_, job);
  if (paths_ != nullptr) fit_paths(own, job);
  transitions_ = TransitionMatrix(static_cast<int>(fits_.size()), options_.transition_prior);
  for (std::size_t k = 1; k < segments_.size(); ++k)
    if (segments_[k].run_idx == segments_[k - 1].run_idx)
      transitions_.add_count(segments_[k - 1].texton, segments_[k].texton);
}

void ExpectationMaximisation::fit_paths(const std::vector<std::vector<LabelledSegment>>& own, const JobContext& job) {
  path_of_.clear();
  for (const auto& segments : own) {
    PathStatistics sum = paths_->nothing();
    for (const LabelledSegment& segment : segments) sum += paths_->observe(segment.row);
    path_of_.push_back(paths_->path(sum));
  }
  starts_ = paths_->start_densities(paths_->windows(), path_of_, job);
}

double ExpectationMaximisation::expect(const JobContext& job) {
  const std::size_t num_runs = corpus_.runs.size();
  std::vector<std::vector<Segment>> found(num_runs);
  std::vector<double> scores(num_runs);
  const SegmentOptions rules{min_frames_, max_frames_, 0};
  parallel_for(job.jobs, static_cast<int>(num_runs), [&](int r) {
    job.check_cancelled();
    const auto i = static_cast<std::size_t>(r);
    const Run& run = corpus_.runs[i];
    const Index rows = paths_ == nullptr ? 0 : run.length;
    SegmentationReport report = segment_sequence({emissions_.middleRows(run.row, run.length),
                                                  {},
                                                  transitions_,
                                                  rules,
                                                  starts_.middleRows(paths_ == nullptr ? 0 : run.row, rows)});
    if (!report.is_feasible())
      throw InvalidInput("no lengths between min_duration and max_duration add up to a stretch of " +
                         std::to_string(run.length) + " frames");
    found[i] = std::move(report.segments);
    scores[i] = report.score;
  });
  Segmentation segments;
  for (std::size_t r = 0; r < num_runs; ++r)
    for (const Segment& s : found[r])
      segments.push_back({s.state, static_cast<int>(r), corpus_.runs[r].row + s.start, s.length});
  converged_ = same_segments(segments, segments_);
  segments_ = std::move(segments);
  double objective = std::accumulate(scores.begin(), scores.end(), 0.0) + transitions_.log_prior();
  for (const TextonFit& fit : fits_) objective += fit.log_prior;
  for (const Vector& path : path_of_) objective += paths_->log_prior(path);
  return objective;
}

double ExpectationMaximisation::iterate(const JobContext& job) {
  maximise(job);
  return expect(job);
}

}  // namespace motex
