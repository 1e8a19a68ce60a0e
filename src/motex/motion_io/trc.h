// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motex/motion/markers.h"
#include "motex/motion_io/read_options.h"

namespace motex {

/// Marker table of Motion Analysis and OpenSim: two lines of keys and values (DataRate, Units, …), a line of marker
/// names over three columns each, a line X1 Y1 Z1 …, then a row a frame: number, time, coordinates. Cells stand between
/// tabs; a file whose first line has none may use commas or semicolons, or blanks if no cell is empty. Missing: empty
/// cells or NaN for all three coordinates; cells that a row lacks at its end. The rows that are there count, not
/// NumFrames; the rate is DataRate, else that of the time column; options.fps overrides it. Of the options only fps is
/// used here. Memory ≤ 64 × the file + 64 MB. Throws ParseError with the line.
MarkerSet read_trc_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                         const JobContext& job = {});

/// Tab-separated, with as many digits as identify each number; read again it gives the same places. Lengths are in mm,
/// cm or m: other known units are written in mm; where the unit is unknown, numbers stay and Units says mm. Tabs and
/// line ends in names become '_'. Throws InvalidInput as check_markers and without frames.
std::string write_trc_bytes(const MarkerSet& markers);
void write_trc(const std::filesystem::path& path, const MarkerSet& markers);

}  // namespace motex
