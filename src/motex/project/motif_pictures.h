// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/matrix.h"
#include "motex/people/people_texture.h"
#include "motex/plot/drawing.h"
#include "motex/project/load_people.h"

namespace motex {

/// [PT04] Figure 2: how often windows fell together, at some iterations; rows and columns are starts.
struct CollisionPicture {
  int iteration = 0;
  Matrix counts;
};
Drawing draw_collisions(const std::vector<CollisionPicture>& pictures);

/// [PT04] Figure 3: the aspect ratio of the box over a motif's window in its exemplar and in the occurrence closest to
/// it, one panel a motif, at most `most`. Throws InvalidInput without motifs.
Drawing draw_motif_matches(const PeopleTexture& texture, int most = 6);

/// [PT04] Figure 4: frames of up to `rows` occurrences of each of at most `most` motifs, `columns` a row at equal parts
/// of the action, cut to what the actor takes up in it. Throws InvalidInput without motifs.
Drawing draw_filmstrips(const PeopleTexture& texture, FramePictures& pictures, int most = 4, int rows = 2,
                        int columns = 8);

/// The action alphabet: letter, name, how often, length, and the frame in the middle of the exemplar of every motif.
Drawing draw_alphabet(const PeopleTexture& texture, FramePictures& pictures);

/// Alphabet, Figure 3 and Figure 4, one below the other.
Drawing draw_motif_page(const PeopleTexture& texture, FramePictures& pictures);

}  // namespace motex
