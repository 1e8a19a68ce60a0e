// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/cable_moves.h"

namespace motex {
namespace {

constexpr int kSettlingSweeps = 6;
constexpr double kLevelsPerElement = 0.2;
constexpr int kFramesPerPiece = 14;
constexpr int kFramesBetweenPieces = 2;  // no term of the prior reaches over them

/// Proposals of a sweep and frame: so many for each element, and so many for each cell of the picture.
struct MoveRate {
  CableMove move;
  double per_element, per_cell;
};
constexpr std::array<MoveRate, kNumCableMoves> kRates{{{CableMove::kBirthDeath, 0, 1},
                                                       {CableMove::kExtendShrink, 3, 0},
                                                       {CableMove::kExtendShrinkBack, 3, 0},
                                                       {CableMove::kSwap, 1, 0},
                                                       {CableMove::kExchange, 0.3, 0},
                                                       {CableMove::kSplitMerge, 3, 0},
                                                       {CableMove::kBridge, 3, 0},
                                                       {CableMove::kWhole, 0, 0.5},
                                                       {CableMove::kRefit, 1, 0},
                                                       {CableMove::kBlock, 0.3, 0},
                                                       {CableMove::kLevel, 0, 0},
                                                       {CableMove::kDiffuse, 0.3, 0},
                                                       {CableMove::kPair, 0.3, 0},
                                                       {CableMove::kPairFill, 0.5, 0},
                                                       {CableMove::kPairTie, 0.3, 0}}};

/// Cuts the clip into pieces of about kFramesPerPiece frames at places that change from sweep to sweep.
std::vector<FrameRange> divide(int num_frames, Rng& rng) {
  const int num_pieces = std::max(1, (num_frames + kFramesPerPiece / 2) / kFramesPerPiece);
  std::vector<FrameRange> pieces;
  int first = 0;
  for (int k = 1; k <= num_pieces; ++k) {
    const double place = (k + rng.uniform(-0.3, 0.3)) * num_frames / num_pieces;
    const int end = k == num_pieces ? num_frames : static_cast<int>(place);
    pieces.push_back({first, end});
    first = end + kFramesBetweenPieces;
  }
  return pieces;
}

/// Before anything comes or goes, what is there is fitted: a misfit would look like another element.
bool keeps_links(CableMove move) {
  return move == CableMove::kRefit || move == CableMove::kBlock || move == CableMove::kDiffuse;
}

class Sampler {
 public:
  Sampler(const std::vector<Plane>& residuals, const std::vector<Cable>& start, const CablePrior& prior,
          const SampleCablesOptions& options, const JobContext& job)
      : options_(options),
        job_(job),
        num_frames_(static_cast<int>(residuals.size())),
        law_(prior, num_frames_),
        state_(residuals, start, law_),
        rng_(options.seed) {
    report_.background_change = Plane(residuals[0].width, residuals[0].height);
    elements_per_frame_ = std::max(1.0, static_cast<double>(state_.num_elements()) / num_frames_);
  }

  SampleCablesReport run() {
    double log_p = log_posterior(state_, law_);
    report_.log_posterior_trace.push_back(log_p);
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      job_.check_cancelled();
      log_p += run_moves(sweep);
      bool is_changed = false;
      if (options_.static_background) is_changed = move_background();
      if (sweep < options_.learn_sweeps) is_changed = learn() || is_changed;
      if (is_changed) log_p = log_posterior(state_, law_);
      report_.log_posterior_trace.push_back(log_p);
      job_.progress("sampling cables", (sweep + 1.0) / options_.sweeps);
    }
    report_.cables = state_.cables();
    report_.prior = law_.prior();
    for (int k = 0; k < kNumCableJumps; ++k) {
      const JumpCount& count = counts_[static_cast<std::size_t>(k)];
      report_.moves.push_back({name_of(static_cast<CableJump>(k)), count.proposed, count.accepted});
      report_.num_proposals += count.proposed;
    }
    report_.moves.push_back({"rebuild", rebuilds_.proposed, rebuilds_.accepted});
    return std::move(report_);
  }

 private:
  double run_moves(int sweep) {
    const std::vector<FrameRange> pieces = divide(num_frames_, rng_);
    std::vector<double> changes(pieces.size());
    std::vector<JumpCount> rebuilds(pieces.size());
    std::vector<std::array<JumpCount, kNumCableJumps>> counts(pieces.size());
    const Rng sweep_rng = rng_.fork(static_cast<std::uint64_t>(sweep));
    parallel_for(job_.jobs, static_cast<int>(pieces.size()), [&](int task) {
      const auto idx = static_cast<std::size_t>(task);
      FittedCoreProposal proposal(law_.prior());
      CableMoves moves(state_, law_, proposal, pieces[idx], sweep_rng.fork(static_cast<std::uint64_t>(task)));
      for (int frame = pieces[idx].first; frame < pieces[idx].end; ++frame) {
        job_.check_cancelled();
        go_through(frame, sweep, moves);
      }
      if (sweep >= kSettlingSweeps && sweep < kSettlingSweeps + options_.search_sweeps)
        rebuilds[idx] = search(pieces[idx], moves);
      changes[idx] = moves.log_posterior_change();
      counts[idx] = moves.counts();
    });
    double change = move_levels(sweep_rng.fork(pieces.size()));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      change += changes[i];
      add_counts(counts[i]);
      rebuilds_.proposed += rebuilds[i].proposed;
      rebuilds_.accepted += rebuilds[i].accepted;
    }
    return change;
  }

  JumpCount search(FrameRange piece, CableMoves& moves) const {
    JumpCount count;
    for (int frame = piece.first; frame < piece.end; ++frame) {
      job_.check_cancelled();
      const std::vector<int> all = state_.live(frame);
      for (const int idx : all) {
        const CoreElement& element = state_.element(frame, idx);
        if (element.live_place < 0 || !is_round(element.kind)) continue;  // oriented ones: a hundred times as dear
        if (!moves.is_suspicious(frame, idx)) continue;
        ++count.proposed;
        count.accepted += moves.rebuild_around(frame, idx) ? 1 : 0;
      }
    }
    return count;
  }

  void add_counts(const std::array<JumpCount, kNumCableJumps>& counts) {
    for (std::size_t k = 0; k < counts_.size(); ++k) {
      counts_[k].proposed += counts[k].proposed;
      counts_[k].accepted += counts[k].accepted;
    }
  }

  /// Whole cables reach over all pieces.
  double move_levels(const Rng& rng) {
    FittedCoreProposal proposal(law_.prior());
    CableMoves moves(state_, law_, proposal, {0, num_frames_}, rng);
    for (int frame = 0; frame < num_frames_; ++frame) {
      job_.check_cancelled();
      for (int k = 0; k < static_cast<int>(kLevelsPerElement * elements_per_frame_ + 0.5); ++k)
        moves.propose(CableMove::kLevel, frame);
    }
    add_counts(moves.counts());
    return moves.log_posterior_change();
  }

  void go_through(int frame, int sweep, CableMoves& moves) const {
    for (const MoveRate& rate : kRates) {
      if (sweep < kSettlingSweeps && !keeps_links(rate.move)) continue;
      const double num_cells = std::min<double>(state_.num_cells(), 4 + 2 * elements_per_frame_);
      double num = rate.per_element * elements_per_frame_ + rate.per_cell * num_cells;
      if (sweep < kSettlingSweeps) num *= 2;
      for (int k = 0; k < static_cast<int>(num + 0.5); ++k) moves.propose(rate.move, frame);
    }
  }

  /// Gibbs step: each pixel's background is normal around the mean over time of what the cores leave.
  bool move_background() {
    const double deviation = law_.prior().noise / std::sqrt(num_frames_);
    const Plane change = mean_image();
    Rng rng = rng_.fork(0);
    for (int y = 0; y < change.height; ++y) {
      float* total = report_.background_change.row(y);
      const float* mean = change.row(y);
      for (int x = 0; x < change.width; ++x) {
        const auto step = mean[x] + static_cast<float>(deviation * rng.normal());
        total[x] += step;
        for (int t = 0; t < num_frames_; ++t) state_.image(t).row(y)[x] -= step;
      }
    }
    rng_.next_u64();
    return true;
  }

  Plane mean_image() const {
    Plane mean(report_.background_change.width, report_.background_change.height);
    const float share = 1 / static_cast<float>(num_frames_);
    for (int t = 0; t < num_frames_; ++t)
      for (int y = 0; y < mean.height; ++y) {
        const float* row = state_.image(t).row(y);
        float* out = mean.row(y);
        for (int x = 0; x < mean.width; ++x) out[x] += share * row[x];
      }
    return mean;
  }

  bool learn() {
    const std::vector<Cable> cables = state_.cables();
    if (cables.empty()) return false;
    const CablePrior& now = law_.prior();
    EstimatePriorOptions options;
    options.margin = now.margin;
    options.num_frames = num_frames_;
    options.noise = noise();
    CablePrior next = estimate_prior(cables, now.width, now.height, options);
    next.kind = now.kind;
    next.sign = now.sign;
    next.min_coefficient = now.min_coefficient;
    next.min_scale = now.min_scale;
    next.max_scale = now.max_scale;
    next.max_per_frame = now.max_per_frame;
    law_ = CableLaw(next, num_frames_);
    return true;
  }

  /// 1.4826 × median |residual| over every third pixel, so that what is not explained counts little.
  double noise() const {
    std::vector<float> values;
    for (int t = 0; t < num_frames_; ++t)
      for (int y = t % 3; y < state_.image(t).height(); y += 3)
        for (int x = y % 3; x < state_.image(t).width(); x += 3) values.push_back(std::abs(state_.image(t).row(y)[x]));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return std::max(0.5, 1.4826 * static_cast<double>(*middle));
  }

  const SampleCablesOptions& options_;
  const JobContext& job_;
  int num_frames_;
  CableLaw law_;
  CableState state_;
  Rng rng_;
  double elements_per_frame_ = 1;
  std::array<JumpCount, kNumCableJumps> counts_{};
  JumpCount rebuilds_;
  SampleCablesReport report_;
};

void check_prior(const std::vector<Plane>& residuals, const CablePrior& prior) {
  if (residuals.empty()) throw InvalidInput("sampling cables: there are no pictures");
  if (prior.width != residuals[0].width || prior.height != residuals[0].height)
    throw InvalidInput("sampling cables: the prior is for pictures of another size");
  if (!(prior.noise > 0) || !(prior.log_scale.deviation > 0) || !(prior.amplitude.deviation > 0))
    throw InvalidInput("sampling cables: deviations of the prior must be above 0");
}

}  // namespace

SampleCablesReport sample_cables(const std::vector<Plane>& residuals, const std::vector<Cable>& start,
                                 const CablePrior& prior, const SampleCablesOptions& options, const JobContext& job) {
  check_options(options);
  check_prior(residuals, prior);
  return Sampler(residuals, start, prior, options, job).run();
}

double log_posterior_of(const std::vector<Plane>& residuals, const std::vector<Cable>& cables,
                        const CablePrior& prior) {
  check_prior(residuals, prior);
  const CableLaw law(prior, static_cast<int>(residuals.size()));
  return log_posterior(CableState(residuals, cables, law), law);
}

}  // namespace motex
