// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable_prior.h"

namespace motex {

struct SampleCablesOptions {
  int sweeps = 24;
  int search_sweeps = 8;
  int learn_sweeps = 0;
  bool static_background = false;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"sweeps", "", "times that every frame is gone through"}, self.sweeps, Range{0, 100000});
    visit(Field{"search_sweeps", "",
                "after so many of the first sweeps cables that begin or end where none should are rebuilt"},
          self.search_sweeps, Range{0, 100000});
    visit(Field{"learn_sweeps", "", "after so many of the first sweeps rates, dynamics and noise are fitted again"},
          self.learn_sweeps, Range{0, 100000});
    visit(Field{"static_background", "", "the background does not change in time: it is sampled too"},
          self.static_background, Range{});
    visit(Field{"seed", "", "random numbers; the same seed gives the same cables"}, self.seed, Range{0, 1.8e19});
  }
};

struct MoveCount {
  std::string name;
  std::int64_t proposed = 0, accepted = 0;
};

struct SampleCablesReport {
  std::vector<Cable> cables;  ///< the last sample; cores only
  std::vector<MoveCount> moves;
  std::vector<double> log_posterior_trace;  ///< before the first sweep and after each, under the prior of that sweep
  CablePrior prior;                         ///< as given, or learned
  Plane background_change;                  ///< to be added to the background; zero unless static_background
  std::int64_t num_proposals = 0;
};

/// Samples all cables at once from their posterior given the pictures ([TM02] section 4, its Markov chain with
/// reversible jumps): Gaussian image likelihood, dynamics, births and deaths (cable_prior.h), the moves of
/// cable_moves.h, at temperature 1.
///
/// residuals: luma minus background, one a frame, of one size. start: cores are used, coils left out; where the prior
/// makes a core impossible (too weak, wrong sign) its cable is cut.
/// Frames are divided into pieces that are sampled at the same time, other pieces in each sweep; the result depends on
/// the seed and not on the number of threads.
/// Throws InvalidInput (pictures, options), Cancelled.
SampleCablesReport sample_cables(const std::vector<Plane>& residuals, const std::vector<Cable>& start,
                                 const CablePrior& prior, const SampleCablesOptions& options,
                                 const JobContext& job = {});

/// ln posterior of given cables under the prior, nats, up to a constant of the pictures: what the trace shows.
double log_posterior_of(const std::vector<Plane>& residuals, const std::vector<Cable>& cables, const CablePrior& prior);

}  // namespace motex
