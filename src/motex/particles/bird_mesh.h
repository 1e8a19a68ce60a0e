// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/particles/bird_flight.h"

namespace motex {

/// Triangles of a bird: body coordinates x forward, y up, z to its right; wingspan 1 when stretched level.
struct BirdMesh {
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// A body turned on a lathe, a tail, and two wings of two halves each, hinged at the shoulder and at the wrist.
BirdMesh bird_mesh(const WingPosture& wings);

}  // namespace motex
