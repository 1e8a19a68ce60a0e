// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/track_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "motex/core/csv.h"
#include "motex/core/error.h"
#include "motex/core/lowered.h"
#include "motex/core/trimmed.h"
#include "motex/image/planes.h"

namespace motex {
namespace {

enum Column { kFrame, kId, kX, kY, kAmplitude, kScale, kAngle, kNumColumns };
constexpr int kNumNeeded = 4;
const std::array<std::vector<std::string_view>, kNumColumns> kNames{{{"frame", "t"},
                                                                     {"track", "id", "particle", "track_id"},
                                                                     {"x"},
                                                                     {"y"},
                                                                     {"amplitude", "amp"},
                                                                     {"scale", "size", "sigma"},
                                                                     {"angle", "theta"}}};

constexpr int kPlaces = 4;
constexpr std::string_view kBlanks = " \t\r\"";  // around a cell

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::vector<Track> read() {
    read_heading(true);
    std::map<std::int64_t, Track> tracks;
    for (std::vector<std::string> words; next_row(words);) tracks[whole(words, kId)].points.push_back(point_of(words));
    return sorted(tracks);
  }

  std::vector<TrackPoint> read_points() {
    read_heading(false);
    std::vector<TrackPoint> points;
    for (std::vector<std::string> words; next_row(words);) points.push_back(point_of(words));
    return points;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(name_, ParseError::Unit::kLine, line_, message);
  }

  bool next_line(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    return true;
  }

  bool next_row(std::vector<std::string>& words) {
    std::string_view line;
    while (next_line(line))
      if (!trimmed(line, kBlanks).empty() && line[0] != '#') {
        csv_cells(line, separator_, words);
        return true;
      }
    return false;
  }

  TrackPoint point_of(const std::vector<std::string>& words) const {
    TrackPoint point;
    point.frame = whole(words, kFrame);
    point.x = number(words, kX);
    point.y = number(words, kY);
    if (places_[kAmplitude] >= 0) point.amplitude = number(words, kAmplitude);
    if (places_[kScale] >= 0) point.scale = number(words, kScale);
    if (places_[kAngle] >= 0) point.angle = number(words, kAngle);
    return point;
  }

  void read_heading(bool needs_track) {
    std::string_view line;
    while (next_line(line) && trimmed(line, kBlanks).empty()) {
    }
    for (const char separator : {',', ';', '\t'})
      if (line.find(separator) != std::string_view::npos) {
        separator_ = separator;
        break;
      }
    std::vector<std::string> heading;
    csv_cells(line.substr(line.starts_with("\xEF\xBB\xBF") ? 3 : 0), separator_, heading);
    for (std::string& word : heading) word = lowered(word);
    for (std::size_t column = 0; column < kNumColumns; ++column) {
      places_[column] = -1;
      for (const std::string_view known : kNames[column])
        if (const auto found = std::find(heading.begin(), heading.end(), known);
            found != heading.end() && places_[column] < 0)
          places_[column] = static_cast<int>(found - heading.begin());
      if (column < kNumNeeded && places_[column] < 0 && (needs_track || column != kId))
        fail("the heading has no column '" + std::string(kNames[column][0]) + "'; frame, " +
             (needs_track ? "track (or id), " : "") + "x, y are needed");
    }
  }

  double number(const std::vector<std::string>& words, Column column) const {
    const auto place = static_cast<std::size_t>(places_[column]);
    if (place >= words.size()) fail("the line has too few columns");
    const std::string& word = words[place];
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value) || std::abs(value) > 1e15)
      fail("'" + word.substr(0, 40) + "' is not a number");
    return value;
  }

  std::int64_t whole(const std::vector<std::string>& words, Column column) const {
    const double value = number(words, column);
    if (value != std::floor(value)) fail(std::string(kNames[column][0]) + " must be a whole number");
    return static_cast<std::int64_t>(value);
  }

  std::vector<Track> sorted(std::map<std::int64_t, Track>& by_id) const {
    std::vector<Track> tracks;
    for (auto& [id, track] : by_id) {
      track.id = id;
      std::sort(track.points.begin(), track.points.end(),
                [](const TrackPoint& a, const TrackPoint& b) { return a.frame < b.frame; });
      for (std::size_t k = 1; k < track.points.size(); ++k)
        if (track.points[k].frame == track.points[k - 1].frame)
          fail("track " + std::to_string(id) + " stands twice in frame " + std::to_string(track.points[k].frame));
      tracks.push_back(std::move(track));
    }
    return tracks;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t line_ = 0;
  char separator_ = ',';
  std::array<int, kNumColumns> places_{};
};

}  // namespace

std::vector<Track> parse_tracks_csv(std::string_view text, const std::string& name) {
  return TableReader(text, name).read();
}

std::vector<TrackPoint> parse_points_csv(std::string_view text, const std::string& name) {
  return TableReader(text, name).read_points();
}

void TrackCsv::append(std::int64_t track, const TrackPoint& point, std::string& text) {
  if (!is_inside(point.x, point.y, width_, height_)) return;
  ++num_rows_;
  for (const std::int64_t whole : {track, point.frame}) text += std::to_string(whole) + ',';
  const std::array<double, 5> numbers{point.x, point.y, point.scale, point.angle, point.amplitude};
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    append_rounded(text, numbers[k], kPlaces);
    text += k + 1 < numbers.size() ? ',' : '\n';
  }
}

std::string tracks_csv(const std::vector<Track>& tracks, int width, int height) {
  std::string text = TrackCsv::heading();
  TrackCsv table(width, height);
  for (const Track& track : tracks)
    for (const TrackPoint& point : track.points) table.append(track.id, point, text);
  return text;
}

}  // namespace motex
