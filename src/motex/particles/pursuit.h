// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/base.h"
#include "motex/particles/filter_bank.h"

namespace motex {

struct PursueOptions {
  int num_bases = 800;
  Dictionary dictionary = Dictionary::kExtended;
  int refine_steps = 4;
  int refine_rounds = 1;
  double min_coefficient = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"num_bases", "", "bases to find"}, self.num_bases, Range{1, 100000});
    visit(Field{"dictionary", "", "paper: LoG, Gcos, Gsin; extended: Gaussians too"}, self.dictionary,
          Choices{{"paper", "extended"}});
    visit(Field{"refine_steps", "", "steps that fit place, scale and angle of each base continuously; 0: on the grid"},
          self.refine_steps, Range{0, 50});
    visit(Field{"refine_rounds", "", "times that all bases are fitted again against what the others leave"},
          self.refine_rounds, Range{0, 20});
    visit(Field{"min_coefficient", "grey levels", "a base whose coefficient is smaller ends the search"},
          self.min_coefficient, Range{0, 1e6});
  }
};

/// Matching pursuit: bases b_j and coefficients α_j such that target ≈ Σ α_j b_j ([TM02] eq. 3), greedily: each base is
/// the one with the largest |⟨residual, b⟩|, refined continuously, and taken off.
///
/// Responses are kept per tile of 8 × 8 pixels of a pyramid level; a base that is taken off makes the tiles near it
/// stale, and a stale tile is computed again (one matrix product) only when it leads. So a base costs what its own
/// surroundings cost, 0.3 ms on average, whatever the size of the image.
///
/// target: image minus background, 1 or 3 planes; geometry is found on the luma, coefficients per plane.
/// counts: rising; the result has one map per count, of at most that many bases: all are fitted again (refine_rounds)
/// and get jointly least-squares coefficients before the search goes on. num_bases of the options is not used.
/// Throws InvalidInput (planes, counts), NumericalFailure (target not finite), Cancelled.
std::vector<BaseMap> pursue_stages(const Planes& target, const std::vector<int>& counts, const PursueOptions& options,
                                   const JobContext& job = {});
/// The map for options.num_bases.
BaseMap pursue(const Planes& target, const PursueOptions& options, const JobContext& job = {});

}  // namespace motex
