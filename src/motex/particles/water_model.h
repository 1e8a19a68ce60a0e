// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/particles/flow_field.h"
#include "motex/particles/star.h"

namespace motex {

/// What a model of falling water has besides its cables (carried bases): how it flows from place to place, and the
/// light that the bases leave.
struct WaterModel {
  FlowField flow;
  StarModel light;
};

}  // namespace motex
