// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion_texture/choreograph.h"
#include "motex/motion_texture/choreography_bridge.h"

namespace motex {

/// A pose to be met.
struct Station {
  PlanPoses poses;
  Index frame = 0;  ///< of the output
  std::string name;
};

/// Start and end included.
std::vector<Station> stations_of(const MotionTexture& model, const ChoreographyRequest& request);

/// Where the body stands in its clip at a row.
RootPlace place_at(const MotionTexture& model, Index row);

}  // namespace motex
