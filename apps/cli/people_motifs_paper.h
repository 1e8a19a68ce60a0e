// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/paper_motifs.h"
#include "session.h"
#include "value.h"

namespace motex::cli {

/// The paper's searches as --paper tells them: for each window the distance of the closest cell of the collision matrix
/// (found), that after a search around the cells (searched) and the exact one.
Value searches_value(const std::vector<PaperSearch>& searches);
/// The same for a person, a line each.
void say_searches(const std::vector<PaperSearch>& searches, Session& session);

}  // namespace motex::cli
