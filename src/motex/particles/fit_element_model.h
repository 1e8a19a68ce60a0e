// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/element_filter.h"

namespace motex {

/// Where elements come into a picture and leave it: within a step of its edges.
struct PictureEdges {
  double width = 0, height = 0;

  bool is_entering(const ElementModel& model, double x, double y) const;
  bool is_leaving(const ElementModel& model, double x, double y) const;
};

/// Velocities, persistence, deviations (maximum likelihood by the filter, searched one by one) and levels (moments)
/// from paths of three sights and more; births, clutter, deaths and the share seen from counts over num_frames
/// frames. What too few paths say stays as it was.
ElementModel fit_element_model(const std::vector<std::vector<Sight>>& paths, const PictureEdges& edges, int num_frames,
                               const ElementModel& before);

}  // namespace motex
