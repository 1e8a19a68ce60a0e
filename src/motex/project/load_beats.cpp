// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/load_beats.h"

#include <charconv>
#include <cmath>
#include <string>

#include "motex/audio/beat_tracking.h"
#include "motex/core/error.h"
#include "motex/core/extension.h"
#include "motex/core/files.h"

namespace motex {
namespace {

bool is_wav(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".wav" || extension == ".wave";
}

/// The number that a line begins with, up to a comma, semicolon, blank or its end.
bool first_number(std::string_view line, double& value) {
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  return end == line.data() + line.size() || std::string_view(",; \t").find(*end) != std::string_view::npos;
}

}  // namespace

std::vector<double> parse_beats(std::string_view text, const std::string& name) {
  std::vector<double> beats;
  std::int64_t number = 0;
  bool is_first = true;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(text.size(), length + 1));
    ++number;
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    double value = 0;
    const bool is_number = first_number(line, value);
    if (!is_number && !is_first)
      throw ParseError(name, ParseError::Unit::kLine, number,
                       "'" + std::string(line.substr(0, 40)) + "' does not begin with a time in seconds");
    is_first = false;
    if (!is_number) continue;
    if (value < 0 || (!beats.empty() && value <= beats.back()))
      throw ParseError(name, ParseError::Unit::kLine, number, "beats are rising times in seconds from 0 on");
    beats.push_back(value);
  }
  if (beats.empty()) throw InvalidInput(name + ": there is no beat in it");
  return beats;
}

std::vector<double> load_beats(const std::filesystem::path& path, const JobContext& job) {
  if (!is_wav(path)) return parse_beats(read_file(path), path.string());
  const Sound sound = read_wav(path);
  job.check_cancelled();
  try {
    const BeatTrack track = track_beats(sound);
    job.warn(path.filename().string() + ": " + std::to_string(track.beat_secs.size()) + " beats found, " +
             std::to_string(std::lround(track.tempo_bpm)) + " a minute");
    return track.beat_secs;
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.string() + ": " + error.what());
  }
}

}  // namespace motex
