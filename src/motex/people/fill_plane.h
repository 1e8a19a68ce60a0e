// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/mask.h"
#include "motex/image/planes.h"

namespace motex {

/// Values outside `known` become smooth continuations of those inside: means of known neighbours on ever coarser grids
/// (pull), then interpolated back (push). Without any known value all become 0. [Gortler et al. 1996, section 3.4]
void fill_unknown(Plane& plane, const Mask& known);

}  // namespace motex
