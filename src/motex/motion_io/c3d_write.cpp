// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/motion_io/c3d.h"

namespace motex {
namespace {

constexpr std::size_t kBlock = 512, kLongestLabel = 64, kLabelsAtOnce = 255;
constexpr Index kMostMarkers = 65535;
constexpr double kMostFrames = 65535;

void put_word(std::string& out, std::uint32_t value) {
  out += static_cast<char>(value & 0xFF);
  out += static_cast<char>(value >> 8 & 0xFF);
}
void put_real(std::string& out, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  put_word(out, bits & 0xFFFF);
  put_word(out, bits >> 16);
}
std::string word(std::uint32_t value) {
  std::string out;
  put_word(out, value);
  return out;
}
std::string real(double value) {
  std::string out;
  put_real(out, value);
  return out;
}

void pad_to_block(std::string& out) { out.resize((out.size() + kBlock - 1) / kBlock * kBlock, '\0'); }

/// The parameter section, record by record.
class ParameterWriter {
 public:
  void group(int id, const std::string& name) { record(-id, name, std::string(1, '\0')); }
  void parameter(int id, const std::string& name, int type, const std::vector<std::size_t>& sizes,
                 const std::string& data) {
    std::string body{static_cast<char>(type), static_cast<char>(sizes.size())};
    for (const std::size_t size : sizes) body += static_cast<char>(size);
    record(id, name, body + data + std::string(1, '\0'));
  }
  void text(int id, const std::string& name, const std::string& value) {
    parameter(id, name, -1, {value.size()}, value);
  }
  std::string section() const {
    std::string out("\x01\x50\0\x54", 4);
    out += records_;
    out += std::string(2, '\0');
    pad_to_block(out);
    out[2] = static_cast<char>(out.size() / kBlock);
    return out;
  }

 private:
  void record(int id, const std::string& name, const std::string& body) {
    records_ += static_cast<char>(name.size());
    records_ += static_cast<char>(id);
    records_ += name;
    put_word(records_, static_cast<std::uint32_t>(2 + body.size()));
    records_ += body;
  }
  std::string records_;
};

const char* unit_name(double metres) {
  for (const auto& [name, size] : {std::pair{"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}})
    if (std::abs(metres / size - 1) < 1e-9) return name;
  return "";
}

void add_labels(ParameterWriter& writer, const std::vector<std::string>& names) {
  std::size_t longest = 4;
  for (const std::string& name : names) longest = std::max(longest, std::min(name.size(), kLongestLabel));
  for (std::size_t first = 0, part = 1; first < names.size(); first += kLabelsAtOnce, ++part) {
    const std::size_t count = std::min(kLabelsAtOnce, names.size() - first);
    std::string labels;
    for (std::size_t i = first; i < first + count; ++i) {
      std::string label = names[i].substr(0, longest);
      label.resize(longest, ' ');
      labels += label;
    }
    writer.parameter(1, part == 1 ? "LABELS" : "LABELS" + std::to_string(part), -1, {longest, count}, labels);
  }
}

std::string parameter_section(const MarkerSet& markers, std::size_t data_block) {
  const auto frames = static_cast<std::uint32_t>(markers.num_frames());
  ParameterWriter writer;
  writer.group(1, "POINT");
  writer.parameter(1, "USED", 2, {}, word(static_cast<std::uint32_t>(markers.num_markers())));
  writer.parameter(1, "SCALE", 4, {}, real(-0.1));
  writer.parameter(1, "RATE", 4, {}, real(markers.frame_rate()));
  writer.parameter(1, "DATA_START", 2, {}, word(static_cast<std::uint32_t>(data_block)));
  writer.parameter(1, "FRAMES", 2, {}, word(std::min<std::uint32_t>(frames, 65535)));
  writer.text(1, "UNITS", unit_name(markers.metres_per_unit));
  writer.text(1, "X_SCREEN", "+X");
  writer.text(1, "Y_SCREEN", "+Y");
  add_labels(writer, markers.names);
  writer.group(2, "TRIAL");
  writer.parameter(2, "ACTUAL_START_FIELD", 2, {2}, word(1) + word(0));
  writer.parameter(2, "ACTUAL_END_FIELD", 2, {2}, word(frames & 0xFFFF) + word(frames >> 16));
  return writer.section();
}

std::string header_block(const MarkerSet& markers, std::size_t data_block) {
  std::string out("\x02\x50", 2);
  put_word(out, static_cast<std::uint32_t>(markers.num_markers()));
  put_word(out, 0);
  put_word(out, 1);
  put_word(out, static_cast<std::uint32_t>(std::min(static_cast<double>(markers.num_frames()), kMostFrames)));
  put_word(out, 0);
  put_real(out, -0.1);
  put_word(out, static_cast<std::uint32_t>(data_block));
  put_word(out, 0);
  put_real(out, markers.frame_rate());
  pad_to_block(out);
  return out;
}

}  // namespace

std::string write_c3d_bytes(const MarkerSet& markers) {
  check_markers(markers);
  if (markers.num_frames() == 0) throw InvalidInput(markers.name + ": markers without frames cannot be written as C3D");
  if (markers.num_markers() > kMostMarkers) throw InvalidInput("a C3D file holds 65535 markers at most");
  const std::size_t data_block = 2 + parameter_section(markers, 0).size() / kBlock;
  if (data_block > 256) throw InvalidInput("the names of the markers do not fit a C3D file; TRC takes them");
  std::string out = header_block(markers, data_block) + parameter_section(markers, data_block);
  out.reserve(out.size() + static_cast<std::size_t>(markers.positions.size()) * 16 / 3 + kBlock);
  for (Index t = 0; t < markers.num_frames(); ++t)
    for (int m = 0; m < markers.num_markers(); ++m) {
      const bool seen = markers.seen(t, m);
      for (int k = 0; k < 3; ++k) put_real(out, seen ? markers.positions(t, 3 * m + k) : 0);
      put_real(out, seen ? 0 : -1);
    }
  pad_to_block(out);
  return out;
}

void write_c3d(const std::filesystem::path& path, const MarkerSet& markers) {
  write_file(path, write_c3d_bytes(markers));
}

}  // namespace motex
