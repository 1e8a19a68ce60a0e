// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "motex/core/options.h"
#include "motex/motion_texture/model.h"

namespace motex {

struct VaryOptions {
  double noise = 0.4;
  bool foot_fix = true;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"noise", "", "strength of fresh noise on top of the example's own, which has 1"}, self.noise,
          Range{1e-9, 3});
    visit(Field{"foot_fix", "", "hold planted feet"}, self.foot_fix, Range{});
    visit(Field{"seed", "", "random seed: another one, another variant"}, self.seed, Range{0, 1.8e19});
  }
};

struct VaryReport {
  double mean_distance = 0;     ///< cm from the example's frames to the variant's, norm of weighted features
  double largest_distance = 0;  ///< cm
  Index farthest_frame = 0;
  double speed_ratio = 1;  ///< mean joint speed / that of the example
};

/// One example of a texton with other fine details [MT02 6.2, Figure 9]: y = y_source + C e, e an exact sample of the
/// texton's dynamics that is 0 at both ends, driven by fresh noise alone. The two first and the two last frames are
/// those of the example. Throws InvalidInput for an instance that does not exist.
Clip vary_texton(const MotionTexture& model, int instance, const VaryOptions& options, VaryReport& report);

}  // namespace motex
