// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable.h"
#include "motex/particles/element_filter.h"
#include "motex/particles/link_sights.h"
#include "motex/particles/shared_flow.h"
#include "motex/particles/track.h"

namespace motex {

struct LinkOptions {
  int max_gap = 6;
  int min_frames = 3;
  double max_speed = 0;
  int sweeps = 4;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"max_gap", "frames", "frames in a row in which an element may go unseen"}, self.max_gap, Range{0, 30});
    visit(Field{"min_frames", "frames", "shorter paths are dropped, unless they cross the picture's edge"},
          self.min_frames, Range{1, 1000});
    visit(Field{"max_speed", "pixels/frame", "fastest shared flow; auto: 32 or a quarter of the picture"},
          self.max_speed, Range{0.1, 1000, true});
    visit(Field{"sweeps", "", "times that all links are made again with the dynamics learned so far"}, self.sweeps,
          Range{1, 20});
  }
};

struct LinkReport {
  ElementModel model;  ///< learned from the paths
  FlowEstimate flow;
  std::vector<double> confidences;  ///< of each cable: probability that none of its links is wrong
  double expected_wrong_share = 0;  ///< expected share of wrong links
  int num_links = 0;
  int num_filled = 0;   ///< places filled in gaps
  int num_dropped = 0;  ///< detections that are in no cable
};

/// Joins detections of consecutive frames to cables: the shared flow (shared_flow.h) gives the first model of how
/// elements move; link_sights() joins and learns; places are smoothed by the learned dynamics and gaps filled.
/// Nothing about speed or flow needs to be told.
/// width, height: of the picture (0 = unknown): elements that enter or leave it may be short.
/// Cables in order of first frame. Deterministic. Throws InvalidInput when a detection is not finite,
/// Cancelled.
std::vector<Cable> link_cores(const std::vector<std::vector<Base>>& frames, int width, int height,
                              const LinkOptions& options = {}, LinkReport* report = nullptr,
                              const JobContext& job = {});

/// The same for points alone, frame by frame (frames[k] = points of frame k; their `frame` is not looked at); tracks
/// are numbered from 0. Amplitudes and scales help where they differ from element to element.
std::vector<Track> link_points(const std::vector<std::vector<TrackPoint>>& frames, int width, int height,
                               const LinkOptions& options = {}, LinkReport* report = nullptr,
                               const JobContext& job = {});

/// The joining alone: paths of elements through sights (frames[t][i].frame = t), shorter ones dropped unless they cross
/// the picture's edge or an end of the clip at both of their ends. start: what is known of the elements, nullptr =
/// nothing.
std::vector<SightChain> link_chains(const std::vector<std::vector<Sight>>& frames, int width, int height,
                                    const LinkOptions& options, const ElementModel* start, LinkReport& report,
                                    const JobContext& job = {});

}  // namespace motex
