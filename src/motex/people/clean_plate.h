// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/image/image.h"
#include "motex/image/mask.h"
#include "motex/image/planes.h"

namespace motex {

/// kPlain: any other smooth surface, a white studio or a painted wall. kNatural: a static scene.
enum class ScreenKind { kGreen, kBlue, kPlain, kNatural };

const char* name_of(ScreenKind kind);

/// The scene as the camera sees it when nobody is there.
struct CleanPlate {
  Image picture;  ///< opaque
  /// Deviation of one channel of a frame around the picture, grey levels: of the mean of 2 × 2 pixels, times 2, so that
  /// noise that neighbours share counts in full. One value for each 2 × 2 pixels (sides halved, rounded up), 1.2 … 12.
  Plane noise;
  ScreenKind kind = ScreenKind::kPlain;
  Rgba colour;                 ///< mean of the screen
  double seen_share = 0;       ///< of the pixels: those that were seen empty; the rest is filled in from around
  bool coarse_colour = false;  ///< VideoInfo::coarse_colour of the footage; nothing here sets it
  float chroma_shift = 0;      ///< measure_chroma_shift(); heeded where colours are coarse
  double steady_share = 1;     ///< of the pixels: those that showed one thing in at least 40 % of the frames
};

/// What the background is taken for.
enum class BackgroundChoice { kAuto, kScreen, kNatural };

struct CleanPlateOptions {
  BackgroundChoice screen = BackgroundChoice::kAuto;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(
        Field{"screen", "",
              "screen: one smooth surface of any colour, light uneven; natural: a static scene, seen empty everywhere "
              "at some time; auto: from the frames"},
        self.screen, Choices{{"auto", "screen", "natural"}});
  }
};

/// How many frames of that size a plate is best estimated from: 48, fewer where they would take more than 192 MiB.
int num_plate_frames(int width, int height);

/// The clean plate of a fixed camera from frames spread over the footage, in which someone moves.
///
/// Screen: the commonest colour, above all near the border, is found in RGB; its light is a quadratic surface in x and
/// y, fitted to all frames with outliers left out. Near that surface each pixel's own colour is the mean of the largest
/// cluster of its samples. Where a pixel never was empty the deviation from the surface is carried over from around.
/// Things that stand still on or beside the screen and touch nothing that moves belong to the plate.
/// Natural: the largest cluster of each pixel's samples alone.
///
/// garbage: pixels that are left out (may be null). Throws InvalidInput without frames, when sizes differ, when a
/// natural scene is given fewer than 8 frames, when the camera moves (no scene is steady): what to do is said.
CleanPlate estimate_clean_plate(std::span<const Image> frames, const CleanPlateOptions& options = {},
                                const Mask* garbage = nullptr, const JobContext& job = {});

/// A picture of the empty scene as clean plate; the noise is measured from the frames (without any: 3 grey levels).
/// Throws InvalidInput when sizes differ.
CleanPlate clean_plate_of(const Image& picture, std::span<const Image> frames, const JobContext& job = {});

}  // namespace motex
