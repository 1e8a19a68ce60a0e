// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/clip_frames.h"

namespace motex {

struct GrowCoilsOptions {
  int max_coils = 5;
  double min_share = 0.01;
  double min_contrast = 5;
  double reach = 3;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"max_coils", "", "most coil bases around a core"}, self.max_coils, Range{0, 20});
    visit(Field{"min_share", "", "a coil has at least this share of the energy of its core"}, self.min_share,
          Range{0, 1});
    visit(Field{"min_contrast", "", "a coil's coefficient is at least this many deviations of the noise"},
          self.min_contrast, Range{0, 100});
    visit(Field{"reach", "core scales", "coils lie this near their core, farther only where other coils lead there"},
          self.reach, Range{0.5, 6});
  }
};

/// How well cores and coils stand for the clip. PSNR of the luma over all frames, dB.
struct GrowCoilsReport {
  double background_psnr = 0;
  double cores_psnr = 0;         ///< background and cores, coefficients fitted jointly
  double psnr = 0;               ///< cores and coils
  double bases_per_moveton = 0;  ///< core and coils, mean over elements and frames
  double isolated_share = 0;     ///< of elements and frames: nothing else within reach
  double noise = 0;              ///< deviation of a pixel from background and cores (median), grey levels
};

/// [TM02] section 4, after the cores: weaker bases are found "quickly following the learned trajectory". One coil after
/// another is sought around each core in what background, cores and coils leave: the strongest frame of the cable
/// begins, and from there it is carried along the cable in both directions, relative to the core, and fitted again in
/// each frame; where another place is clearly better (a wing has turned) it jumps there. A cable gets a coil in all its
/// frames or not at all. A pixel belongs to the core that is nearest in core scales: nobody takes another's light.
/// In the end coefficients of all bases of a frame are solved for together, per plane.
///
/// background: as many planes as the clip. cables: cores given (place, scale, angle, any coefficient); coils and all
/// coefficients are replaced. Throws InvalidInput (sizes), Cancelled. Cost: 0.2 ms an element, frame and coil.
GrowCoilsReport grow_coils(const ClipFrames& clip, const Planes& background, std::vector<Cable>& cables,
                           const GrowCoilsOptions& options = {}, const JobContext& job = {});

/// The same where the background differs from frame to frame (a moving camera): residuals = luma minus background of
/// each frame; `background` is that of one of them and tells its colours.
GrowCoilsReport grow_coils(const ClipFrames& clip, const Planes& background, const std::vector<Plane>& residuals,
                           std::vector<Cable>& cables, const GrowCoilsOptions& options, const JobContext& job);

/// For each cable and frame whether nothing else lies within reach: |distance| > reach · (scale + other scale).
std::vector<std::vector<char>> isolated_frames(const std::vector<Cable>& cables, double reach);

class MovetonLight;
/// The search itself: coils besides those that the cables have, up to max_coils of each; which: one a cable, 0 = none.
void add_coils(MovetonLight& light, std::vector<Cable>& cables, const std::vector<char>& which,
               const GrowCoilsOptions& options, double noise, const JobContext& job);
/// Fills in bases_per_moveton and isolated_share.
void count_bases(const std::vector<Cable>& cables, double reach, GrowCoilsReport& report);

}  // namespace motex
