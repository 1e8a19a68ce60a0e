// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/people/motifs.h"
#include "motex/people/people_texture.h"
#include "value.h"

namespace motex::cli {

/// letter, name, window, distance, radius, count, exemplar, starts, lengths, distances of each.
Value motifs_value(const MotifSet& alphabet);
/// window, distance, count, starts, reason of each.
Value candidates_value(const std::vector<MotifCandidate>& candidates);
/// The motifs as a table for a person; "" without any. frames_per_sec: 0 = lengths in frames only.
std::string alphabet_table(const MotifSet& alphabet, double frames_per_sec);
std::string alphabet_table(const PeopleTexture& texture);
/// The table, what is idle, and why the candidates are no motifs.
std::string alphabet_text(const MotifSet& alphabet, const std::vector<MotifCandidate>& candidates,
                          double frames_per_sec);

}  // namespace motex::cli
