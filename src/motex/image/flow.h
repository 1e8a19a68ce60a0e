// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/planes.h"
#include "motex/image/warp_grid.h"

namespace motex {

struct FlowOptions {
  int spacing = 4;          ///< of the grid that is returned, pixels
  int num_iterations = 8;   ///< of each patch at each level
  double smoothing = 0.15;  ///< how much a patch with plenty of texture follows its neighbours, 0 … 1
};

/// Where each pixel of `from` is in `to`: from(p) ≈ to(p + u(p)), for any number of planes of one size, all of them
/// counted alike. Patches of 8 × 8 pixels around the grid points are searched by inverse compositional steps (Lucas and
/// Kanade) from coarse to fine, beginning where the coarser level, the neighbours above and to the left, or `start`
/// say, whichever fits best; each level is smoothed, patches without texture by their neighbours. Follows Kroeger et
/// al., Fast optical flow using dense inverse search (2016), without its variational part. Beyond the edge the
/// picture's edge pixels go on. Cost about 1 µs a grid point and level. Throws InvalidInput unless the sizes are equal,
/// with pixels in them.
WarpGrid optical_flow(const Planes& from, const Planes& to, const FlowOptions& options = {},
                      const WarpGrid* start = nullptr);

}  // namespace motex
