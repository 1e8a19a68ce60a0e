// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/image/planes.h"
#include "motex/particles/cable.h"
#include "motex/particles/expectations.h"

namespace motex {

/// A path that was given its beginning in a burst.
struct BurstStart {
  std::size_t chain = 0;
  int burst = 0;
  int first_seen = 0;  ///< frame from which on it is seen
};

/// Elements born together (bursts.h) are one light at first. Each path of a burst that is first seen later gets one
/// more sight at its front, where the burst was, in the first frame behind it; how it looks there is taken from the
/// first sights. Its blob is added behind those found in that frame.
std::vector<BurstStart> start_in_bursts(std::vector<SightChain>& chains, BlobFrames& blobs, const ElementModel& model);

/// Short paths among those of a burst that end beside one of these: pieces of what could not be told apart there.
void drop_pieces_of_bursts(std::vector<SightChain>& chains, const BlobFrames& blobs, std::vector<BurstStart>& starts);

/// In the frames where elements of a burst are not seen yet they share the light that the others leave (left: of each
/// frame) in proportion to their amplitudes. cables: of the chains that starts speaks of.
void share_light(const std::vector<BurstStart>& starts, const std::vector<Plane>& left, std::vector<Cable>& cables);

}  // namespace motex
