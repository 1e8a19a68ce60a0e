// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/people/people_texture.h"
#include "value.h"

namespace motex::cli {

/// letter, name, window, distance, radius, exemplar, starts, lengths of each.
Value motifs_value(const MotifSet& alphabet);
/// The actions as a table for a person; "" without any.
std::string alphabet_table(const PeopleTexture& texture);

}  // namespace motex::cli
