// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/expectations.h"

namespace motex {

/// Of elements with parts, drops paths that are none: of what reaches into the picture while the core stays outside,
/// short ones that begin and end beside longer ones, inside the picture, and, of elements that are fitted with their
/// turns, those that stay within a longer one's
/// core: two fits of one element, of which the longer gets both amplitudes.
void drop_paths_of_parts(std::vector<SightChain>& chains, BlobFrames& blobs, const ElementModel& model, int width,
                         int height, bool are_turned);

}  // namespace motex
