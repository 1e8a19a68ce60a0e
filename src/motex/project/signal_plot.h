// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/people/people_texture.h"
#include "motex/people/signals.h"
#include "motex/plot/drawing.h"

namespace motex {

/// Rows: frames. Columns: frame (of the people texture), source, source_frame, person, mirrored (0, 1), seen (1; 0
/// where nobody is seen), then the signals, empty where they have no value.
std::string signals_csv(const PeopleTexture& texture, const PeopleSignals& signals);

/// One panel below the other, time in seconds of the people texture; dashed lines where takes begin; above them where
/// the motifs of the alphabet are, if there are any. names: which signals, all when empty. Throws InvalidInput for a
/// name that does not exist.
Drawing draw_signals(const PeopleTexture& texture, const PeopleSignals& signals,
                     const std::vector<std::string>& names = {});

}  // namespace motex
