// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/model.h"

namespace motex {

enum class StretchMethod { kRevisit, kWarp, kWhite };

struct StretchOptions {
  StretchMethod method = StretchMethod::kRevisit;
  double noise = 0;
  bool foot_fix = true;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"method", "",
                "revisit: as fast as the example, which does more or less; warp: the example slowed down or sped up; "
                "white: the texton's dynamics driven by white noise, as in the paper"},
          self.method, Choices{{"revisit", "warp", "white"}});
    visit(Field{"noise", "", "strength of fresh noise (auto: 0.2 on top of replayed residuals, 1 for white noise)"},
          self.noise, Range{1e-9, 3, true});
    visit(Field{"foot_fix", "", "hold planted feet"}, self.foot_fix, Range{});
    visit(Field{"seed", "", "random seed"}, self.seed, Range{0, 1.8e19});
  }
};

/// Frames of an example that were played in output frames start … start + length − 1.
struct PlayedVisit {
  Index start = 0, length = 0;
  int instance = 0;
  Index source_start = 0, source_length = 0;  ///< counted from the example's first frame
};

struct StretchReport {
  std::vector<PlayedVisit> visits;
  Index source_length = 0;
  double speed_ratio = 1;  ///< mean joint speed / that of the example
  double gain = 1;         ///< by which movement about its mean was made larger to keep the speed
  double largest_cut = 0;  ///< cm between the frames at which the movement went on elsewhere
};

/// One example of a texton in another number of frames [MT02 6.2, Figure 10]. Its two first and two last frames are
/// those of the example, also after planted feet were held. Slowed down to 1.5 times its length a dance drags, and
/// white noise averages its swing away; so the example is played at its own pace and visits some of its frames again
/// (or leaves some out), by the way of RevisitPlanner whose mean joint speed comes nearest to the example's, bent
/// together at the cuts by the texton's dynamics (SegmentSynthesis). Warns when the speed is more than 5 % off, or a
/// cut is wide. Throws InvalidInput for an instance that does not exist or fewer than 4 frames, or more than 50 times
/// its length.
Clip stretch_texton(const MotionTexture& model, int instance, Index num_frames, const StretchOptions& options,
                    StretchReport& report, const JobContext& job = {});

/// Throws InvalidInput unless the model has that example.
void check_instance(const MotionTexture& model, int instance);

/// The example as it was learned from, where it stood.
Clip example_clip(const MotionTexture& model, int instance);

/// Mean over joints, end sites and steps of how fast they move in the world, units/s.
double mean_joint_speed(const Clip& clip);

}  // namespace motex
