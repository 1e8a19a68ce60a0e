// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/detect_cores.h"
#include "motex/particles/link_cores.h"

namespace motex {

struct TrackElementsOptions {
  DetectOptions detect;
  LinkOptions link;
  int rounds = 3;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    DetectOptions::visit_fields(self.detect, visit);
    LinkOptions::visit_fields(self.link, visit);
    visit(Field{"rounds", "", "times that frames are searched; from the second on with the paths found so far"},
          self.rounds, Range{1, 10});
  }
};

struct TrackElementsReport {
  LinkReport link;
  DetectOptions detect;  ///< as decided over the clip
  Plane background;      ///< luma, re-estimated from what the elements leave
  double noise = 0;      ///< deviation of a pixel from background + elements, grey levels
  double detections_per_frame = 0;
  /// The cables with places as the picture alone shows them, where it shows them (to within half a pixel). Dynamics of
  /// linked cables are learned from these: smoothed places have more persistence than the elements.
  std::vector<Cable> seen;
};

/// A detection for the linking, with what the fit says of its errors.
Sight sight_of(const Blob& blob, int frame);

/// Cables of single core bases from frames: detection in each frame, linking, then detection again with the elements
/// expected where their paths lead (so that overlapping ones are told apart and gaps are filled on the image), with the
/// background and the noise re-estimated from what the elements leave. Elements with parts, whose shapes are learned,
/// cover one another for longer: they may go unseen for twice link.max_gap frames.
/// background: luma; noise: deviation of a pixel, 0 = measured. Cables in order of their first frame, then x.
/// Throws InvalidInput (no frames, sizes), Cancelled.
std::vector<Cable> track_elements(const ClipFrames& frames, const Plane& background, double noise,
                                  const TrackElementsOptions& options, const JobContext& job = {},
                                  TrackElementsReport* report = nullptr);

/// The same before the background of a clip: where that differs from frame to frame (a moving camera) each frame is
/// seen before its own, which is not estimated again.
std::vector<Cable> track_elements(const ClipFrames& frames, const ClipBackground& background,
                                  const TrackElementsOptions& options, const JobContext& job = {},
                                  TrackElementsReport* report = nullptr);

}  // namespace motex
