// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motex/motion_texture/model.h"

/// Changes to the distribution of a model. A file holds the model as it was learned and a list of edits; what dances,
/// plans and recognises sees the model with the edits applied.
namespace motex {

/// The learned model as its edits make it:
///
///   drop, keep  dropped textons keep number and dynamics, but lose their instances; runs are cut there, and the jumps
///               that close dead ends are found anew among what is left
///   merge       the first texton gets the instances, statistics and transitions of the others, all added up, and is
///               fitted anew with the learner's prior (own basis: subspace too)
///   weight      count n_ij times factor; rows are normalised by their sums, so p_ij = f n_ij / (n_i + (f − 1) n_ij)
///   name        a name beside the number
///
/// Edits act in their order; a weight acts on what its two textons are at that moment. Throws InvalidInput for an edit
/// that cannot be: a texton that is not there, nothing left to dance, a forbidden only way out.
MotionTexture apply_edits(MotionTexture learned);

/// What an edit did to the endless dance.
struct EditReport {
  std::vector<int> lost;    ///< textons it played before and plays no more, those of the edit itself apart
  std::vector<int> gained;  ///< and the other way round
};
/// Adds an edit to the list of a learned model. Throws InvalidInput, and changes nothing, where apply_edits() would.
EditReport add_edit(MotionTexture& learned, ModelEdit edit);

/// Takes edit k (−1: the last) off the list and returns it. Throws InvalidInput, and changes nothing, when there is
/// none or a later edit does not work without it.
ModelEdit undo_edit(MotionTexture& learned, int k = -1);

/// Throws InvalidInput unless the texton exists and is neither dropped nor merged, saying which.
void check_playable(const MotionTexture& model, int texton);
/// The texton of that name or number; none when there is none.
std::optional<int> find_texton(const MotionTexture& model, std::string_view name_or_number);
/// "3", or "3 (turn)" with a name.
std::string texton_label(const MotionTexture& model, int texton);

/// Textons that the endless dance plays: the largest connected part of the transitions, rising.
std::vector<int> danced_textons(const MotionTexture& model);

/// One line: "name 3 turn", "drop 4 5", "keep 1 2 3", "merge 2 9", "weight 3 7 10", "weight any 7 0". Files hold these.
std::string edit_text(const ModelEdit& edit);
/// The inverse. Throws InvalidInput.
ModelEdit parse_edit(const std::string& line);

}  // namespace motex
