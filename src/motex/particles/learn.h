// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable_sampler.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// What is followed from frame to frame.
enum class TrackingKind {
  kAuto,   ///< cores, or carried bases where looks_like_water()
  kCores,  ///< elements that can be told apart
  kCarry   ///< bases carried forward: water
};

struct LearnTexturedMotionOptions {
  std::uint64_t seed = 1;
  int rounds = 1;
  int sweeps = 12;
  BackgroundKind background = BackgroundKind::kAuto;
  bool coils = true;
  TrackingKind tracking = TrackingKind::kAuto;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"seed", "", "random numbers; the same seed gives the same model"}, self.seed, Range{0, 1.8e19});
    visit(Field{"rounds", "",
                "times that cables are sampled and everything else is fitted to them, where elements have no parts "
                "(wings)"},
          self.rounds, Range{0, 50});
    visit(Field{"sweeps", "", "times that the sampler goes through every frame in a round"}, self.sweeps,
          Range{1, 10000});
    visit(Field{"background", "",
                "what bases are added to: median over time, low (20 % quantile, for fire), smooth (the frame blurred, "
                "for a moving camera), flat (one level, as in the paper); auto: median or smooth"},
          self.background, Choices{{"auto", "median", "low", "smooth", "flat"}});
    visit(Field{"coils", "", "the weaker bases around each core too"}, self.coils, Range{});
    visit(
        Field{"tracking", "",
              "cores: elements that can be told apart; carry: bases carried forward in time, for falling water; auto: "
              "by how the light of the clip goes up and down"},
        self.tracking, Choices{{"auto", "cores", "carry"}});
  }
};

/// What one round came to.
struct LearnRound {
  double psnr = 0;           ///< of background + bases against the clip, dB (luma)
  double noise = 0;          ///< grey levels
  double log_posterior = 0;  ///< nats; of sampled rounds
  int num_cables = 0;
};

struct LearnTexturedMotionReport {
  double background_psnr = 0;      ///< of the background alone
  std::vector<LearnRound> rounds;  ///< 0: linked detections
  std::vector<MoveCount> moves;    ///< reversible jumps, over all rounds
  std::vector<double> log_posterior_trace;
  double bases_per_frame = 0;
  double expected_wrong_links = 0;  ///< share of the links from frame to frame, as linking believes; 0 for water
};

struct LearnedTexturedMotion {
  TexturedMotion model;
  LearnTexturedMotionReport report;
};

/// Learns a model Θ from a clip ([TM02] section 4): background, cores, cables; then rounds of sampling whole cables,
/// regressing their dynamics and fitting the background again; coils and templates; birth and death maps.
/// Memory: a few planes a frame. Throws InvalidInput (fewer than 3 frames, frames smaller than 8 pixels, nothing that
/// moves), Cancelled.
LearnedTexturedMotion learn_textured_motion(const ClipFrames& clip, const LearnTexturedMotionOptions& options = {},
                                            const JobContext& job = {});

}  // namespace motex
