// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "motex/particles/edit.h"

namespace motex {

/// Edits of single movetons as JSON; every list may be missing, and vx, vy, species, track of an insertion (0, 0, −1 =
/// any, the next free number):
///   {"insert": [{"frame": 10, "x": 40, "y": 5.5, "vx": 1, "vy": 3, "species": 0}],
///    "move": [{"track": 7, "dx": 20, "dy": 0}],
///    "remove": [3, 12]}
/// Throws InvalidInput naming the entry: no JSON, an unknown word, a number missing.
MovetonEdits parse_moveton_edits(std::string_view text, const std::string& name);

}  // namespace motex
