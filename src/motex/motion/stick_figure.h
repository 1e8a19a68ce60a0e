// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/motion/clip.h"

namespace motex {

/// A walk whose truth is known, for tests of everything that handles bodies.
struct StickFigureOptions {
  Index num_frames = 600;
  double frame_rate = 60;   ///< Hz
  double speed = 100;       ///< cm/s along the path
  double step_length = 50;  ///< cm from one foot's print to the other's; at most 60
  double turn_rate = 0;     ///< rad/s; the path is an arc
  double stance = 0.6;      ///< share of the gait cycle in which a foot is planted
  double noise = 0;         ///< rad: deviation of slow random movement of spine, head and arms; the feet stay exact
  std::uint64_t seed = 1;   ///< of the noise
};

struct StickFigure {
  Clip clip;
  std::vector<std::uint8_t> planted;  ///< frames × 2 (left, right): 1 where the foot stands exactly still and flat
  bool is_planted(Index frame, int foot) const { return planted[static_cast<std::size_t>(2 * frame + foot)] != 0; }
};

/// 17 joints (Hips, Spine, Head, LeftArm … RightToeBase), centimetres, Y up, facing +Z, soles at y = 0 in the walk.
Skeleton stick_figure_skeleton();

/// The figure walks along its arc from (0, ·, 0) towards +Z: prints lie on both sides of the path, feet between prints
/// follow a quintic ease with a lifted, pitched foot, legs are solved exactly from hip and ankle.
/// Throws InvalidInput when the steps are longer than the legs.
StickFigure walk_stick_figure(const StickFigureOptions& options = {});

}  // namespace motex
