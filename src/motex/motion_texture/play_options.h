// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "motex/core/options.h"

namespace motex {

enum class NoiseSource { kReplay, kWhite };

/// How examples are played, whoever chose them.
struct PlayOptions {
  double noise = 0;
  NoiseSource noise_source = NoiseSource::kReplay;
  double nearness = 1;
  bool foot_fix = true;
  bool floor_fix = true;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"noise", "",
                "strength of fresh noise against the texton's own (auto: 0.2 on top of replayed residuals, 1 for "
                "white noise and unconstrained textons)"},
          self.noise, Range{1e-9, 3, true});
    visit(Field{"noise_source", "",
                "replay: the residuals of the example, plus fresh noise; white: noise alone, as in the paper"},
          self.noise_source, Choices{{"replay", "white"}});
    visit(Field{"nearness", "", "how far an example's first poses may lie from those before, relative to the usual"},
          self.nearness, Range{0.01, 100});
    visit(Field{"foot_fix", "", "hold planted feet"}, self.foot_fix, Range{});
    visit(Field{"floor_fix", "", "keep the body above the floor"}, self.floor_fix, Range{});
    visit(Field{"seed", "", "random seed"}, self.seed, Range{0, 1.8e19});
  }
};

}  // namespace motex
