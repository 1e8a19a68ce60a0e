// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/paper_motifs.h"
#include "motex/people/people_texture.h"
#include "motex/people/signals.h"
#include "motex/plot/drawing.h"
#include "motex/project/load_people.h"

namespace motex {

/// [PT04] Figure 2: how often windows fell together, a panel an iteration that was kept and a row a search; rows and
/// columns are first frames of windows, a cell the most collisions of its frames. Throws InvalidInput without searches.
Drawing draw_collisions(const std::vector<PaperSearch>& searches);

/// [PT04] Figure 3: the aspect ratio of the box over a motif's window in its exemplar and in the occurrence closest to
/// it, one panel a motif, at most `most`. Throws InvalidInput without motifs.
Drawing draw_motif_matches(const PeopleTexture& texture, int most = 6);
/// The same of any signal.
Drawing draw_motif_matches(const MotifSet& alphabet, const Signal& signal, int most = 6);

/// [PT04] Figure 4: frames of up to `rows` occurrences of each of at most `most` motifs, `columns` a row at equal parts
/// of the action, cut to what the actor takes up in it. Throws InvalidInput without motifs.
Drawing draw_filmstrips(const PeopleTexture& texture, FramePictures& pictures, int most = 4, int rows = 2,
                        int columns = 8);

/// The action alphabet: letter, name, how often, length, and the frame in the middle of the exemplar of every motif.
Drawing draw_alphabet(const PeopleTexture& texture, FramePictures& pictures);

/// Alphabet, Figure 3 and Figure 4, one below the other; with the paper's searches Figure 2 comes first.
Drawing draw_motif_page(const PeopleTexture& texture, FramePictures& pictures,
                        const std::vector<PaperSearch>& searches = {});
/// The same of a series, which has no pictures: Figure 2 and Figure 3. Without motifs only Figure 2; throws
/// InvalidInput when there is neither.
Drawing draw_series_page(const MotifSet& alphabet, const Signal& signal, const std::vector<PaperSearch>& searches = {});

}  // namespace motex
