// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/markov/transition_matrix.h"
#include "motex/particles/base.h"

namespace motex {

/// A number and how it varies.
struct Spread {
  double mean = 0;
  double deviation = 0;
};

/// One coil base of a template, relative to the core (in units of its scale, turned by its angle).
struct TemplateCoil {
  BaseKind kind = BaseKind::kGaussian;
  double presence = 1;                ///< probability that a moveton has it
  Spread u, v;                        ///< offset along and across the core's axis, in core scales
  Spread log_scale;                   ///< ln(scale / core scale)
  Spread angle;                       ///< minus the core's, radians
  std::array<Spread, 3> coefficient;  ///< of each plane, divided by the core's luma coefficient
};

/// One shape that a species takes (a position of the wings): core at the origin and its coils.
struct TemplatePose {
  BaseKind core_kind = BaseKind::kGaussian;
  std::vector<TemplateCoil> coils;
  double share = 1;  ///< of the species' frames
};

/// Deformable template φ_ℓ(β) of [TM02] eq. 4: a species of movetons.
struct MovetonTemplate {
  std::vector<TemplatePose> poses;    ///< ≥ 1
  TransitionMatrix pose_transitions;  ///< frame to frame, as many states as poses
  Spread log_scale;                   ///< ln pixels, of the core, over cables
  Spread amplitude;                   ///< peak of the core, grey levels (luma), over cables
  Spread angle;                       ///< radians; round cores: 0
  std::array<Spread, 3> colour;       ///< coefficient of each plane / luma coefficient
  double share = 1;                   ///< of all cables
};

}  // namespace motex
