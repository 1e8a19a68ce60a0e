// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/coils.h"
#include "motex/particles/moveton_patch.h"

namespace motex {

struct RegroupCoilsOptions {
  int max_coils = 5;
  double min_share = 0.01;
  double reach = 3;
  int sweeps = 2;
};

/// The coils that a shape is made of on average: the mean picture of the movetons (their coils relative to a core of
/// coefficient 1, luma) as few bases, by pursuit and refitting. Strongest first, down to min_share of the core's
/// energy.
std::vector<RelativeBase> coils_of_mean(const std::vector<std::vector<RelativeBase>>& movetons, BaseKind core_kind,
                                        int num_planes, const RegroupCoilsOptions& options);

/// Step 3 of [TM02]'s loop, the other half: once species and states are known (learn_templates), each moveton is
/// explained again by the bases of its own shape. Coils begin where the mean shape of the moveton's species and state
/// has them and are fitted to the frame in turn, on a leash, so that the same coil stands for the same part (a left
/// wing) in all movetons; coefficients of a frame are solved for together. A cable has as many coils as the richest of
/// its states; in a state with fewer the others have coefficient 0. What then is left of a cable that had more coils is
/// given to coils of its own (add_coils), up to max_coils. Where a shape's movetons have no coils in common, cables
/// keep those that they have.
///
/// cables: with coils, species and poses; coils and coefficients are replaced. residuals: see grow_coils.
GrowCoilsReport regroup_coils(const ClipFrames& clip, const Planes& background, const std::vector<Plane>& residuals,
                              std::vector<Cable>& cables, const RegroupCoilsOptions& options = {},
                              const JobContext& job = {});

}  // namespace motex
