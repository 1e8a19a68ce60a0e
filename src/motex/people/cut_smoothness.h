// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/people_texture.h"

namespace motex {

/// Second differences of area, centroid and aspect, each relative to its 95th percentile inside real footage: 1 = as
/// sudden as the most sudden twentieth of what the actor did.
struct CutSmoothness {
  double area = 0, centroid = 0, aspect = 0;
  double largest() const;
};

/// 95th percentiles of |x(t − 1) − 2 x(t) + x(t + 1)| inside takes: area in px², centroid in px (of the two
/// coordinates' length), aspect. All > 0.
struct SecondDifferenceScales {
  double area = 1, centroid = 1, aspect = 1;
};
SecondDifferenceScales second_difference_scales(const PeopleTexture& texture);

/// Of silhouettes that follow one another in a film: the largest anywhere. 0 for fewer than three.
CutSmoothness film_smoothness(const std::vector<Silhouette>& silhouettes, const SecondDifferenceScales& scales);

/// Of a hard cut after which frame `to` follows frame `from`, the larger of the second differences at both. The
/// centroid is carried over the cut (as films are drawn), so of it only the change of velocity counts. Infinite where a
/// neighbour lies outside its take or nobody is there.
CutSmoothness cut_smoothness(const PeopleTexture& texture, const SecondDifferenceScales& scales, int from, int to);

/// Of a transition of that many frames (Cut): the largest second difference anywhere in it and at its ends, when area,
/// centroid and aspect go from one take to the other as the colours do, the second take moved so that the centroids
/// meet at the cut. So it counts, too, how suddenly the footage itself moves there. Shorter where a take ends; 0
/// frames: cut_smoothness(). Throws InvalidInput for a frame in no take.
CutSmoothness transition_smoothness(const PeopleTexture& texture, const SecondDifferenceScales& scales, int from,
                                    int to, int transition_frames);

/// The take that holds the frame. Throws InvalidInput where none does.
const Take& take_of(const PeopleTexture& texture, int frame);

/// Take of a frame: index in texture.takes by frame. Throws InvalidInput unless takes cover all frames without gaps.
std::vector<int> take_of_frames(const PeopleTexture& texture);

}  // namespace motex
