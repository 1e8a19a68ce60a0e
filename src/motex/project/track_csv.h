// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motex/particles/track.h"

namespace motex {

/// Tracks from a table with a heading: columns frame, x, y and id (or track, particle), in any order; amplitude (amp),
/// scale (size, sigma) and angle (theta) where they are there; others are passed over. Separator comma, semicolon or
/// tab. Tracks in rising order of id. Throws ParseError with the line: a column missing, no number, an id twice in a
/// frame. name: for messages.
std::vector<Track> parse_tracks_csv(std::string_view text, const std::string& name);

}  // namespace motex
