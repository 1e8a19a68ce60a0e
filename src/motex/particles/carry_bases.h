// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/flow_field.h"
#include "motex/particles/pursuit.h"

namespace motex {

struct CarryOptions {
  int num_bases = 300;
  Dictionary dictionary = Dictionary::kExtended;
  int refine_steps = 3;
  double keep_share = 0.3;
  double min_coefficient = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"num_bases", "", "bases in each frame"}, self.num_bases, Range{1, 100000});
    visit(Field{"dictionary", "", "paper: LoG, Gcos, Gsin; extended: Gaussians too"}, self.dictionary,
          Choices{{"paper", "extended"}});
    visit(Field{"refine_steps", "", "steps that fit a base to its new place"}, self.refine_steps, Range{1, 50});
    visit(Field{"keep_share", "", "a base is given up when less than that share of its coefficient is left"},
          self.keep_share, Range{0, 1});
    visit(Field{"min_coefficient", "grey levels", "weaker bases are given up, and not looked for"},
          self.min_coefficient, Range{0, 1e6});
  }
};

/// Bases carried forward in time, for motion without separate elements (water), where bases found in each frame anew
/// live 1.2 frames: those of the last frame are moved along (their own velocity, or the field's, or not at all:
/// whichever answers best), fitted again to what the others leave, and given up where little is left of them; only
/// what then remains is pursued. Coefficients are joint least squares in every frame.
///
/// Each base that lives is a cable without coils, species −1. It begins in the middle frame and works towards both ends
/// at once, on two threads. background: planes of the clip's size, 1 or 3.
/// Cost about that of matching pursuit in every frame. Throws InvalidInput, Cancelled.
std::vector<Cable> carry_bases(const ClipFrames& clip, const Planes& background, const CarryOptions& options,
                               const JobContext& job = {});
/// The same along a flow field that is known.
std::vector<Cable> carry_bases(const ClipFrames& clip, const Planes& background, const FlowField& flow,
                               const CarryOptions& options, const JobContext& job = {});

struct CarryReport {
  double mean_life = 0;  ///< frames, of all cables
  double bases_per_frame = 0;
  double psnr = 0;             ///< mean over frames, dB, luma
  double background_psnr = 0;  ///< the same of the background alone
};
CarryReport measure_cables(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
                           int jobs = 0);

/// Core and coil bases of all cables in that frame.
BaseMap bases_in_frame(const std::vector<Cable>& cables, std::int64_t frame, int width, int height, int num_planes);

}  // namespace motex
