// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/markers_io.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "motex/core/csv.h"
#include "motex/core/extension.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/motion/up_axis.h"
#include "motex/motion_io/c3d.h"
#include "motex/motion_io/npz.h"
#include "motex/motion_io/text_scanner.h"
#include "motex/motion_io/trc.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

enum class Kind { kNone, kC3d, kTrc };

constexpr int kPlaces = 9;  // of a CSV

// A C3D begins with two bytes alone: the block of its parameters and 80. The third is the low byte of a count.
Kind kind_of(std::string_view start, const std::string& name) {
  const std::size_t text = start.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  if (same_word(start.substr(text, 12), "PathFileType")) return Kind::kTrc;
  const std::string extension = extension_of(name);
  const bool marked = start.size() > 2 && start[1] == 0x50 && start[0] > 0 && start[0] < 64;
  const bool other_text = start.size() > 2 && start[0] >= ' ';
  if (extension == ".c3d") return other_text ? Kind::kNone : Kind::kC3d;
  if (extension == ".trc") return marked ? Kind::kC3d : Kind::kTrc;
  return marked && !other_text ? Kind::kC3d : Kind::kNone;
}

MarkerSet finished(MarkerSet markers, const ReadClipOptions& options, const JobContext& job) {
  apply_read_options(options, markers);
  if (options.up == UpAxis::kAuto && looks_z_up(markers))
    job.warn(markers.name + ": the points stretch along z; if the body should stand, read it with --up z");
  check_markers(markers);
  return markers;
}

}  // namespace

const std::vector<std::string>& readable_marker_extensions() {
  static const std::vector<std::string> extensions{".c3d", ".trc"};
  return extensions;
}

const std::vector<std::string>& writable_marker_extensions() {
  static const std::vector<std::string> extensions{".trc", ".c3d", ".csv", ".npz"};
  return extensions;
}

bool holds_markers(std::string_view bytes, const std::string& name) { return kind_of(bytes, name) != Kind::kNone; }

bool holds_markers(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  char start[64];
  file.read(start, sizeof start);
  if (file.gcount() == 0 && !fs::is_regular_file(path)) return false;
  return holds_markers({start, static_cast<std::size_t>(file.gcount())}, path.string());
}

MarkerSet read_markers_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                             const JobContext& job) {
  check_options(options);
  const Kind kind = kind_of(bytes, name);
  if (kind == Kind::kNone) throw UnsupportedFile(name + ": holds no markers; motex reads them from .c3d and .trc");
  return finished(
      kind == Kind::kC3d ? read_c3d_bytes(bytes, name, options, job) : read_trc_bytes(bytes, name, options, job),
      options, job);
}

MarkerSet read_markers(const fs::path& path, const ReadClipOptions& options, const JobContext& job) {
  return read_markers_bytes(read_file(path), path.string(), options, job);
}

void apply_read_options(const ReadClipOptions& options, MarkerSet& markers) {
  check_options(options);
  if (options.skip_frames > 0) {
    if (options.skip_frames >= markers.num_frames())
      throw InvalidInput(markers.name + ": skip_frames = " + std::to_string(options.skip_frames) +
                         " leaves none of its " + std::to_string(markers.num_frames()) + " frames");
    markers = slice(markers, options.skip_frames, markers.num_frames() - options.skip_frames);
  }
  if (options.up == UpAxis::kZ) turn_z_up_to_y_up(markers);
  if (options.unit != LengthUnit::kAuto) markers.metres_per_unit = metres_per_unit(options.unit);
  if (options.resample > 0 && std::abs(options.resample * markers.frame_time_secs - 1) > 1e-9)
    markers = resample(markers, 1 / options.resample);
}

void write_markers(const fs::path& path, const MarkerSet& markers, const JobContext& job) {
  const std::string extension = extension_of(path);
  job.check_cancelled();
  if (extension == ".trc")
    write_trc(path, markers);
  else if (extension == ".c3d")
    write_c3d(path, markers);
  else if (extension == ".csv")
    write_file(path, write_csv_bytes(markers));
  else if (extension == ".npz")
    write_file(path, write_npz_bytes(markers));
  else
    throw UnsupportedFile(path.string() + ": markers are written as .trc, .c3d, .csv or .npz; choose by the extension");
}

std::string write_csv_bytes(const MarkerSet& markers) {
  check_markers(markers);
  std::string text = "frame,time";
  for (const std::string& name : markers.names)
    for (const char* axis : {".X", ".Y", ".Z"}) text += "," + csv_cell(name + axis);
  text += '\n';
  for (Index t = 0; t < markers.num_frames(); ++t) {
    append_rounded(text += std::to_string(t) + ",", static_cast<double>(t) * markers.frame_time_secs, kPlaces);
    for (Index c = 0; c < markers.positions.cols(); ++c) {
      text += ',';
      if (!std::isnan(markers.positions(t, c))) append_rounded(text, markers.positions(t, c), kPlaces);
    }
    text += '\n';
  }
  return text;
}

std::string write_npz_bytes(const MarkerSet& markers) {
  check_markers(markers);
  NpzWriter npz;
  const Index shape[] = {markers.num_frames(), markers.num_markers(), 3};
  npz.add("positions", std::span(markers.positions.data(), static_cast<std::size_t>(markers.positions.size())), shape);
  npz.add("names", std::span<const std::string>(markers.names));
  npz.add("frame_time", markers.frame_time_secs);
  npz.add("metres_per_unit", markers.metres_per_unit);
  return npz.bytes();
}

double metres_of_unit_name(std::string_view name) {
  static constexpr std::pair<const char*, double> kUnits[] = {
      {"mm", 0.001},   {"millimeters", 0.001}, {"millimetres", 0.001}, {"millimeter", 0.001},
      {"cm", 0.01},    {"centimeters", 0.01},  {"centimetres", 0.01},  {"centimeter", 0.01},
      {"m", 1},        {"meters", 1},          {"metres", 1},          {"meter", 1},
      {"in", 0.0254},  {"inch", 0.0254},       {"inches", 0.0254},     {"ft", 0.3048},
      {"feet", 0.3048}};
  for (const auto& [unit, metres] : kUnits)
    if (same_word(name, unit)) return metres;
  return 0;
}

}  // namespace motex
