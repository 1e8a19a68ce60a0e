// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/motif.h"

namespace motex {

/// From frame `from` (the last of one shot) to frame `to` (the first of the next). With T transition frames both takes
/// play on while one is morphed into the other: transition frame k = 0 … T − 1 joins from − ⌈T/2⌉ + 1 + k and
/// to − ⌈T/2⌉ + k with weights 1 − w and w, w = (k + 1) / (T + 1); the film is as long as without. T is cut where a
/// take or a shot ends. [PT04] section 3.2, Figure 6
struct Cut {
  int from = 0;
  int to = 0;
  int transition_frames = 0;  ///< 0 = a hard cut
  double difference = 0;      ///< of the silhouettes' pictures, two consecutive frames: root mean square grey levels
  double smoothness = 0;  ///< largest second difference against its 95th percentile in the footage (cut_smoothness.h)
};

/// The cuts between frames of a people texture that can be made (find_cuts).
struct CutSet {
  std::vector<Cut> cuts;          ///< rising by from, then to
  double natural_difference = 0;  ///< of a frame and the next in the footage, 95th percentile, same unit as difference
};

/// Frames first … last of a people texture, played in order.
struct Shot {
  int first = 0;
  int last = 0;
  int motif = -1;  ///< index in the alphabet that was asked for, −1 = none (idle or on the way)
};

/// A motif that is performed in a film, or a stretch of standing.
struct Performance {
  int motif = -1;  ///< index in the alphabet; −1 = idle
  int start = 0;   ///< frame of the film
  int length = 0;
};

/// A film: shot 0, cut 0, shot 1, …; a loop has one more cut, from the last shot to the first.
struct EditList {
  std::vector<Shot> shots;
  std::vector<Cut> cuts;
  bool loop = false;
  std::vector<Performance> performances;  ///< rising; what was asked for

  int num_frames() const {
    int sum = 0;
    for (const Shot& shot : shots) sum += shot.last - shot.first + 1;
    return sum;
  }
};

}  // namespace motex
