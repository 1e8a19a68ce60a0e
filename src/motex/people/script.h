// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motex/people/motif.h"

namespace motex {

/// One word of a script.
struct Direction {
  enum class Kind { kMotif, kIdle, kAny };
  Kind kind = Kind::kMotif;
  int motif = -1;   ///< of kMotif, index in the alphabet
  int times = 1;    ///< performances; of kIdle 1
  double secs = 0;  ///< "3s"; 0 = as many times as said
};

/// A script: actions by name or letter, with commas between (letters alone may follow one another: "A B A"):
///
///   stand, high kick ×2, bow        ×2, x2, *2, (no blank needed after ×)
///   stand 3s, A, * 10s              so many seconds; * or any: free play
///
/// idle, stand, rest and pause are where nothing happens, unless a motif has that name. Upper and lower case are one.
/// Throws InvalidInput: an empty script, and a word that is no motif, naming the alphabet and the nearest one.
std::vector<Direction> parse_script(std::string_view script, const MotifSet& alphabet);

/// The index of a motif by its name or letter. Throws InvalidInput as parse_script() does.
int motif_named(std::string_view name, const MotifSet& alphabet);

/// "A (high kick), B, idle": what can be asked for.
std::string alphabet_text(const MotifSet& alphabet);

}  // namespace motex
