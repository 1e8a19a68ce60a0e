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
};

/// Frames first … last of a people texture, played in order.
struct Shot {
  int first = 0;
  int last = 0;
  int motif = -1;  ///< index in the alphabet that was asked for, −1 = none (idle or on the way)
};

/// A film: shot 0, cut 0, shot 1, …; a loop has one more cut, from the last shot to the first.
struct EditList {
  std::vector<Shot> shots;
  std::vector<Cut> cuts;
  bool loop = false;

  int num_frames() const {
    int sum = 0;
    for (const Shot& shot : shots) sum += shot.last - shot.first + 1;
    return sum;
  }
};

}  // namespace motex
