// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/expectations.h"

namespace motex {

/// Of elements with parts, drops paths that are none: of what reaches into the picture while the core stays outside,
/// and short ones that begin and end beside longer ones, inside the picture.
void drop_paths_of_parts(std::vector<SightChain>& chains, const BlobFrames& blobs, const ElementModel& model, int width,
                         int height);

}  // namespace motex
