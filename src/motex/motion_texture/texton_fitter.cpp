// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_fitter.h"

#include <algorithm>

#include "motex/core/error.h"
#include "motex/motion_texture/subspace.h"

namespace motex {
namespace {

constexpr double kSharedPrior = 300, kOwnPrior = 30;

}  // namespace

double prior_frames_of(const LearnOptions& options) {
  if (options.prior > 0) return options.prior;
  return options.basis == Basis::kShared ? kSharedPrior : kOwnPrior;
}

TextonFitter::TextonFitter(const Corpus& corpus, const LearnOptions& options)
    : corpus_(corpus), options_(options), prior_frames_(prior_frames_of(options)) {
  const Index own_size = options.state_size > 0 ? options.state_size : 15;
  shared_ = principal_subspace(corpus.features, is_shared() ? options.state_size : own_size, 0.995, 2, 30);
  states_ = project(shared_, corpus.features);
  statistics_ = LdsStatistics(shared_.basis.cols());
  for (const Run& run : corpus.runs) statistics_.add(states_, run.row + 2, run.length - 2);
  if (is_shared()) {
    if (options.common_dynamics) common_transition_ = fit_lds(statistics_, make_prior(statistics_, 1)).transition;
    return;
  }
  if (options.common_dynamics) throw InvalidInput("common_dynamics is a control for the shared basis only");
  LdsStatistics lagged(corpus.features.cols());
  for (const Run& run : corpus.runs) lagged.add(corpus.features, run.row + 2, run.length - 2);
  lagged_ = centred(lagged);
}

Index TextonFitter::num_counted(const LabelledSegment& segment) const {
  const Index skipped = corpus_.runs[static_cast<std::size_t>(segment.run_idx)].row + 2 - segment.row;
  return segment.length - std::clamp<Index>(skipped, 0, segment.length);
}

LdsPrior TextonFitter::own_prior(const Subspace& subspace, double prior_frames) const {
  const Index dims = subspace.mean.size(), d = subspace.basis.cols();
  LdsPrior prior;
  prior.frames = prior_frames;
  prior.mean.resize(3 * d);
  prior.covariance.resize(3 * d, 3 * d);
  for (Index a = 0; a < 3; ++a) {
    prior.mean.segment(a * d, d) = subspace.basis.transpose() * (lagged_.mean.segment(a * dims, dims) - subspace.mean);
    for (Index b = 0; b < 3; ++b)
      prior.covariance.block(a * d, b * d, d, d).noalias() = subspace.basis.transpose() *
                                                             lagged_.scatter.block(a * dims, b * dims, dims, dims) *
                                                             subspace.basis / lagged_.count;
  }
  prior.covariance.diagonal().array() += 1e-9 * prior.covariance.trace() / static_cast<double>(3 * d) + 1e-12;
  return prior;
}

Lds TextonFitter::fit_dynamics(const LdsStatistics& statistics, const LdsPrior& prior) const {
  return common_transition_.size() > 0 ? fit_noise(statistics, prior, common_transition_) : fit_lds(statistics, prior);
}

TextonFit TextonFitter::fit_within(const Subspace& subspace, std::span<const LabelledSegment> segments,
                                   double prior_frames) const {
  TextonFit fit;
  fit.statistics = LdsStatistics(is_shared() ? shared_.basis.cols() : subspace.basis.cols());
  for (const LabelledSegment& segment : segments) {
    const Index counted = num_counted(segment);
    if (counted == 0) continue;
    const Index first = segment.row + segment.length - counted;
    if (is_shared()) {
      fit.statistics.add(states_, first, counted);
    } else {
      const FrameMatrix rows =
          corpus_.features.middleRows(first - 2, counted + 2).rowwise() - subspace.mean.transpose();
      const FrameMatrix x = rows * subspace.basis;
      fit.statistics.add(x, 2, counted);
      fit.outside_squares += rows.bottomRows(counted).squaredNorm() - x.bottomRows(counted).squaredNorm();
    }
  }
  const LdsPrior prior = is_shared() ? make_prior(statistics_, prior_frames) : own_prior(subspace, prior_frames);
  fit.dynamics = fit_dynamics(fit.statistics, prior);
  fit.log_prior = log_prior(fit.dynamics, prior);
  if (!is_shared()) fit.subspace = subspace;
  return fit;
}

TextonFit TextonFitter::fit(std::span<const LabelledSegment> segments, double prior_frames) const {
  if (is_shared()) return fit_within(shared_, segments, prior_frames);
  Index frames = 0;
  for (const LabelledSegment& segment : segments) frames += segment.length;
  FrameMatrix rows(frames, corpus_.features.cols());
  Index at = 0;
  for (const LabelledSegment& segment : segments) {
    rows.middleRows(at, segment.length) = corpus_.features.middleRows(segment.row, segment.length);
    at += segment.length;
  }
  return fit_within(principal_subspace(rows, options_.state_size, 0.99, 8, 15), segments, prior_frames);
}

}  // namespace motex
