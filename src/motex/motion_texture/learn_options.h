// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "motex/core/options.h"

namespace motex {

enum class Basis { kShared, kOwn };
enum class Init { kAuto, kGreedy, kMerge };

/// How a motion texture is learned. Times are seconds, lengths centimetres of the body.
struct LearnOptions {
  Basis basis = Basis::kShared;
  Init init = Init::kAuto;
  double threshold = 0;
  double path_weight = 9;
  double min_duration = 1.0;
  double max_duration = 25.0 / 6;
  int state_size = 0;
  double prior = 0;
  double transition_prior = 1;
  int max_iterations = 40;
  bool common_dynamics = false;
  bool keep_glitches = false;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"basis", "", "one subspace for all textons (shared), or one for each as in the paper (own)"},
          self.basis, Choices{{"shared", "own"}});
    visit(Field{"init", "",
                "where learning starts: segments grown until they fit badly (greedy, the paper), or one-second "
                "pieces merged by likeness (merge); auto: merge for shared, greedy for own"},
          self.init, Choices{{"auto", "greedy", "merge"}});
    visit(Field{"threshold", "",
                "greedy: largest mean error of a texton's open-loop prediction, cm (auto: 0.45 of "
                "the distance of two random poses); merge: pieces a texton stands for on average (auto: 5.1), or "
                "without paths the log Bayes factor that a merge must gain, nats (auto: 0)"},
          self.threshold, Range{1e-6, 1e6, true});
    visit(Field{"path_weight", "",
                "how much a texton is the path of a move and not only its dynamics (shared basis); 0: dynamics alone"},
          self.path_weight, Range{0, 1000});
    visit(Field{"min_duration", "s", "shortest segment, T_min"}, self.min_duration, Range{0.1, 10});
    visit(Field{"max_duration", "s", "longest segment"}, self.max_duration, Range{0.2, 60});
    visit(Field{"state_size", "",
                "dimensions of the state (auto: 99.5 % of the variance, at most 30; own: 99 % of each "
                "texton's, 8 to 15)"},
          self.state_size, Range{2, 60, true});
    visit(Field{"prior", "frames", "weight of the whole corpus in every texton's dynamics (auto: 300; own: 30)"},
          self.prior, Range{1, 1e6, true});
    visit(Field{"transition_prior", "counts", "Dirichlet mass added to each row of the transition matrix"},
          self.transition_prior, Range{1e-3, 1e3});
    visit(Field{"max_iterations", "", "most EM iterations"}, self.max_iterations, Range{1, 1000});
    visit(Field{"common_dynamics", "", "a control: all textons share one dynamics and differ in noise alone"},
          self.common_dynamics, Range{});
    visit(Field{"keep_glitches", "", "do not leave out frames in which the body jumps"}, self.keep_glitches, Range{});
    visit(Field{"seed", "", "random seed"}, self.seed, Range{0, 1.8e19});
  }
};

}  // namespace motex
