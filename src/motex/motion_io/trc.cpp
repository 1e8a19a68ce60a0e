// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/trc.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "motex/core/csv.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/trimmed.h"
#include "motex/motion_io/markers_io.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostMarkers = 100'000;
constexpr std::string_view kBlanks = " \t\r\"";  // around a cell

/// Lines with their numbers, cells with the empty ones between.
class TableScanner {
 public:
  TableScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
  }

  /// The next line, false at the end. A CRLF is one line end.
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
    ++line_;
    return true;
  }
  std::string_view need(const char* what) {
    std::string_view line;
    if (!next(line)) fail(std::string("the file ends where ") + what + " should stand");
    return line;
  }
  std::vector<std::string_view> cells(std::string_view line) const {
    if (separator == ' ') return split_words(line);
    std::vector<std::string_view> out;
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      out.push_back(trimmed(line.substr(at, end - at), kBlanks));
      at = end + 1;
    }
    while (!out.empty() && out.back().empty()) out.pop_back();
    return out;
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(file_, ParseError::Unit::kLine, line_, message);
  }

  char separator = '\t';

 private:
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::int64_t line_ = 0;
};

struct Header {
  double data_rate = 0;
  double num_frames = -1, num_markers = -1;
  std::string units;
};

class TrcReader {
 public:
  TrcReader(std::string_view bytes, const std::string& name, const ReadClipOptions& options, const JobContext& job)
      : table_(bytes, name), numbers_("", name), options_(options), job_(job) {
    markers_.name = clip_name(name);
    name_ = name;
    most_bytes_ = 64e6 + 64 * static_cast<double>(bytes.size());
  }

  MarkerSet read() {
    read_header();
    read_names();
    read_rows();
    markers_.metres_per_unit = metres_of_unit_name(header_.units);
    if (markers_.metres_per_unit == 0) job_.warn(name_ + ": the unit of length is not known; name it with --unit");
    markers_.frame_time_secs = 1 / frame_rate();
    return std::move(markers_);
  }

 private:
  double number(std::string_view cell) {
    double value = 0;
    const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc() && stop == cell.data() + cell.size() && std::abs(value) <= 1e12) return value;
    try {
      return numbers_.parse_number(cell, "a number");  // decimal commas and the rest
    } catch (const ParseError&) {
      table_.fail(in_quotes(cell) + " stands where a number should be");
    }
  }

  void read_header() {
    const std::string_view first = table_.need("PathFileType");
    const std::string_view start = trimmed(first, kBlanks);
    if (!same_word(start.substr(0, 12), "PathFileType")) table_.fail("a TRC file begins with PathFileType");
    const std::size_t at = first.find_first_of("\t,; ");
    if (first.find('\t') == first.npos && at != first.npos) table_.separator = first[at];
    const auto keys = table_.cells(table_.need("the names of the values"));
    const auto values = table_.cells(table_.need("the values"));
    for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
      if (same_word(keys[i], "DataRate")) header_.data_rate = number(values[i]);
      if (same_word(keys[i], "NumFrames")) header_.num_frames = number(values[i]);
      if (same_word(keys[i], "NumMarkers")) header_.num_markers = number(values[i]);
      if (same_word(keys[i], "Units")) header_.units = values[i];
    }
  }

  void read_names() {
    const auto cells = table_.cells(table_.need("the names of the markers"));
    if (cells.size() < 3) table_.fail("no marker is named");
    const bool close = table_.separator == ' ';
    for (std::size_t i = 2; i < cells.size(); i += close ? 1 : 3) markers_.names.emplace_back(cells[i]);
    if (markers_.names.size() > kMostMarkers) table_.fail("more than 100,000 markers cannot be meant");
    const auto named = static_cast<double>(markers_.names.size());
    if (header_.num_markers >= 0 && header_.num_markers != named)
      job_.warn(name_ + ": NumMarkers says " + std::to_string(static_cast<std::int64_t>(header_.num_markers)) + ", " +
                std::to_string(markers_.names.size()) + " are named and used");
    markers_.names = distinct_marker_names(std::move(markers_.names));
    table_.need("X1 Y1 Z1");
  }

  void read_rows() {
    std::string_view line;
    double first_time = 0, last_time = 0;
    for (std::int64_t rows = 0; table_.next(line); ++rows) {
      if (rows % 1024 == 0) job_.check_cancelled();
      const auto cells = table_.cells(line);
      if (cells.empty()) continue;
      read_row(cells);
      last_time = cells.size() > 1 && !cells[1].empty() ? number(cells[1]) : 0;
      if (num_rows_++ == 0) first_time = last_time;
    }
    if (num_rows_ == 0) table_.fail("the file holds no frame");
    if (num_rows_ > 1) time_step_ = (last_time - first_time) / static_cast<double>(num_rows_ - 1);
    if (header_.num_frames >= 0 && header_.num_frames != static_cast<double>(num_rows_))
      job_.warn(name_ + ": NumFrames says " + std::to_string(static_cast<std::int64_t>(header_.num_frames)) +
                ", the file holds " + std::to_string(num_rows_) + ", which are used");
    markers_.positions = Eigen::Map<const FrameMatrix>(values_.data(), num_rows_, 3 * markers_.num_markers());
  }

  void read_row(const std::vector<std::string_view>& cells) {
    const std::size_t num_values = 3 * markers_.names.size();
    if (cells.size() > 2 + num_values)
      table_.fail("the row has " + std::to_string(cells.size() - 2) + " coordinates, " + std::to_string(num_values) +
                  " are named");
    // Short rows of many names would take memory without limit.
    if (static_cast<double>(values_.size()) * sizeof(double) > most_bytes_)
      table_.fail("the file asks for more memory by cells that are not there than it can mean");
    for (std::size_t m = 0; m < markers_.names.size(); ++m) {
      int num_missing = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = 2 + 3 * m + k;
        const bool missing = i >= cells.size() || cells[i].empty() || same_word(cells[i], "nan");
        values_.push_back(missing ? kNaN : number(cells[i]));
        num_missing += missing ? 1 : 0;
      }
      if (num_missing == 1 || num_missing == 2)
        table_.fail("marker " + in_quotes(markers_.names[m]) + " has " + std::to_string(3 - num_missing) +
                    " of its 3 coordinates");
    }
  }

  double frame_rate() const {
    if (options_.fps > 0) return options_.fps;
    for (const double rate : {header_.data_rate, time_step_ > 0 ? 1 / time_step_ : 0})
      if (rate >= 1e-3 && rate <= 1e5) return rate;
    table_.fail("the file states no frame rate; name it with --fps");
  }

  TableScanner table_;
  TextScanner numbers_;
  std::string name_;
  const ReadClipOptions& options_;
  const JobContext& job_;
  Header header_;
  MarkerSet markers_;
  std::vector<double> values_;
  Index num_rows_ = 0;
  double time_step_ = 0, most_bytes_ = 0;
};

struct TrcUnit {
  const char* name;
  double factor;  ///< of the numbers
};

TrcUnit unit_of(const MarkerSet& markers) {
  const double metres = markers.metres_per_unit;
  for (const auto& [name, size] : {std::pair{"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}})
    if (std::abs(metres / size - 1) < 1e-9) return {name, 1};
  return {"mm", metres > 0 ? metres / 0.001 : 1};
}

}  // namespace

MarkerSet read_trc_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                         const JobContext& job) {
  return TrcReader(bytes, name, options, job).read();
}

std::string write_trc_bytes(const MarkerSet& markers) {
  check_markers(markers);
  if (markers.num_frames() == 0) throw InvalidInput(markers.name + ": markers without frames cannot be written as TRC");
  const TrcUnit unit = unit_of(markers);
  const std::string frames = std::to_string(markers.num_frames());
  std::string rate;
  append_number(rate, markers.frame_rate());
  std::string text = "PathFileType\t4\t(X/Y/Z)\t" + markers.name + ".trc\n";
  text += "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n";
  text += rate + "\t" + rate + "\t" + frames + "\t" + std::to_string(markers.num_markers()) + "\t" + unit.name + "\t" +
          rate + "\t1\t" + frames + "\nFrame#\tTime";
  std::string axes = "\t";
  for (int m = 0; m < markers.num_markers(); ++m) {
    std::string name = markers.names[static_cast<std::size_t>(m)];
    for (char& c : name)
      if (static_cast<unsigned char>(c) < ' ') c = '_';
    text += (m == 0 ? "\t" : "\t\t\t") + name;
    for (const char axis : {'X', 'Y', 'Z'}) axes += std::string("\t") + axis + std::to_string(m + 1);
  }
  text += "\n" + axes + "\n\n";
  for (Index t = 0; t < markers.num_frames(); ++t) {
    append_number(text += std::to_string(t + 1) + "\t", static_cast<double>(t) * markers.frame_time_secs);
    for (Index c = 0; c < markers.positions.cols(); ++c) {
      text += '\t';
      const double value = markers.positions(t, c) * unit.factor;
      if (!std::isnan(value)) append_number(text, value);
    }
    text += '\n';
  }
  return text;
}

void write_trc(const std::filesystem::path& path, const MarkerSet& markers) {
  write_file(path, write_trc_bytes(markers));
}

}  // namespace motex
