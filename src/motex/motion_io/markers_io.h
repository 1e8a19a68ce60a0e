// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "motex/motion/markers.h"
#include "motex/motion_io/read_options.h"

namespace motex {

/// ".c3d", ".trc".
const std::vector<std::string>& readable_marker_extensions();
/// ".trc", ".c3d", ".csv", ".npz".
const std::vector<std::string>& writable_marker_extensions();

/// Whether the file is one of markers: by what it holds, else by its extension. False when it cannot be read.
bool holds_markers(const std::filesystem::path& path);
bool holds_markers(std::string_view bytes, const std::string& name);

/// Reads C3D or TRC and applies the options, as read_clip does. Throws InvalidInput, ParseError with line or byte,
/// UnsupportedFile.
MarkerSet read_markers(const std::filesystem::path& path, const ReadClipOptions& options = {},
                       const JobContext& job = {});
MarkerSet read_markers_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                             const JobContext& job = {});

/// Skip_frames, up, unit and resample, as for clips: up = z turns the points −90° about x, (x, y, z) → (x, z, −y).
void apply_read_options(const ReadClipOptions& options, MarkerSet& markers);

/// Format by extension; the file appears whole or not at all. Throws UnsupportedFile, InvalidInput, WriteError.
void write_markers(const std::filesystem::path& path, const MarkerSet& markers, const JobContext& job = {});

/// CSV: frame (from 0), time in seconds, then NAME.X, NAME.Y, NAME.Z; empty cells where a marker was not seen.
std::string write_csv_bytes(const MarkerSet& markers);
/// positions frames × markers × 3 (NaN = not seen), names, frame_time, metres_per_unit (0 = unknown).
std::string write_npz_bytes(const MarkerSet& markers);

/// Metres of "mm", "cm", "m", "in", "ft" and their long names in any case; 0 for anything else.
double metres_of_unit_name(std::string_view name);

}  // namespace motex
