// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motex/motion/markers.h"
#include "motex/motion_io/read_options.h"

namespace motex {

/// Markers of a C3D file (c3d.org): Intel, DEC and SGI byte order, 16-bit integers (place = number · POINT:SCALE) and
/// floats. Missing: a negative residual, a number that is not finite or beyond 1e9, or all three coordinates 0.
/// Names are POINT:LABELS, LABELS2 …; points that POINT:ANGLES, FORCES, MOMENTS, POWERS or SCALARS list are no places
/// and are left out; so are analog data. With options.up = auto the axes that POINT:X_SCREEN and Y_SCREEN point out
/// become x (right) and y (up). POINT:UNITS gives the unit, POINT:RATE the rate; options.fps overrides it.
/// The number of frames is the first of TRIAL:ACTUAL_START_FIELD … ACTUAL_END_FIELD, POINT:LONG_FRAMES, POINT:FRAMES
/// and the header's that the file has room for. Memory ≤ 3 × the file. Of the options up and fps are used here.
/// Throws ParseError with the byte; for a file that is cut off too.
MarkerSet read_c3d_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                         const JobContext& job = {});

/// Intel floats, y up (Y_SCREEN = +Y); missing places have residual −1. Places are single precision: within 1e-7 of
/// their size. Throws InvalidInput as check_markers, without frames, and beyond 65,535 markers.
std::string write_c3d_bytes(const MarkerSet& markers);
void write_c3d(const std::filesystem::path& path, const MarkerSet& markers);

}  // namespace motex
