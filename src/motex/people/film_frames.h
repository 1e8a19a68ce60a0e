// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/edit_list.h"
#include "motex/people/people_texture.h"

namespace motex {

/// What one frame of a film is made of.
struct FilmFrame {
  int frame = 0;        ///< of the people texture; in a transition, of the take that is left
  int next_frame = -1;  ///< in a transition, of the take that is entered; −1 elsewhere
  double weight = 0;    ///< of next_frame, (k + 1) / (T + 1) in transition frame k
  int shot = 0;         ///< in the list of shots
  int cut = -1;         ///< in the list of cuts, in a transition
};

/// How many frames each cut's transition really has: Cut::transition_frames, cut where a take ends, where a shot is too
/// short for the transitions at both its ends, and 0 where nothing remains.
std::vector<int> transition_lengths(const PeopleTexture& texture, const EditList& edits);

/// The film, frame by frame: EditList::num_frames() of them. A loop's last cut fills the end and the beginning.
/// [PT04] Figures 5 and 6. Throws InvalidInput (a shot that leaves its take or the texture, a cut that does not join
/// its shots, negative transition frames).
std::vector<FilmFrame> film_frames(const PeopleTexture& texture, const EditList& edits);

}  // namespace motex
