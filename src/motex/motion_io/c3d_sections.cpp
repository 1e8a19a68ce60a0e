// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/c3d_sections.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::uint8_t kMark = 0x50;

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

}  // namespace

void C3dBytes::fail(std::size_t at, const std::string& message) const {
  throw ParseError(file_, ParseError::Unit::kByte, static_cast<std::int64_t>(at), message);
}

void C3dBytes::need(std::size_t at, std::size_t count) const {
  if (at > bytes_.size() || count > bytes_.size() - at) fail(bytes_.size(), "the file ends too early");
}

std::uint8_t C3dBytes::byte(std::size_t at) const {
  need(at, 1);
  return static_cast<std::uint8_t>(bytes_[at]);
}

std::uint16_t C3dBytes::word(std::size_t at) const {
  need(at, 2);
  const unsigned a = byte(at), b = byte(at + 1);
  return static_cast<std::uint16_t>(processor == C3dProcessor::kSgi ? a << 8 | b : b << 8 | a);
}

float C3dBytes::real(std::size_t at) const {
  need(at, 4);
  const std::uint32_t first = word(at), second = word(at + 2);
  if (processor == C3dProcessor::kIntel) return std::bit_cast<float>(second << 16 | first);
  const float value = std::bit_cast<float>(first << 16 | second);
  return processor == C3dProcessor::kDec ? value / 4 : value;
}

std::string C3dBytes::text(std::size_t at, std::size_t length) const {
  need(at, length);
  std::string out(bytes_.substr(at, length));
  out.resize(std::min(out.size(), out.find('\0')));
  out.resize(out.find_last_not_of(" \t\r\n") + 1);
  return out.substr(std::min(out.find_first_not_of(" \t\r\n"), out.size()));
}

C3dHeader read_c3d_header(C3dBytes& bytes, const JobContext& job) {
  if (bytes.size() < kBlock) bytes.fail(bytes.size(), "the file ends before the end of a C3D header (512 bytes)");
  if (bytes.byte(1) != kMark) bytes.fail(1, "is no C3D file: byte 1 must be 80");
  C3dHeader header;
  header.parameters_at = (std::max<std::size_t>(bytes.byte(0), 2) - 1) * kBlock;
  const std::uint8_t processor = bytes.byte(header.parameters_at + 3);
  if (processor >= 84 && processor <= 86)
    bytes.processor = static_cast<C3dProcessor>(processor);
  else
    job.warn("the C3D file does not say in which byte order it is (processor " + std::to_string(processor) +
             "); Intel is assumed");
  header.num_points = bytes.word(2);
  header.analog_per_frame = bytes.word(4);
  header.first_frame = bytes.word(6);
  header.last_frame = bytes.word(8);
  header.scale = static_cast<double>(bytes.real(12));
  header.data_at = (std::max<std::size_t>(bytes.word(16), 1) - 1) * kBlock;
  header.frame_rate = static_cast<double>(bytes.real(20));
  return header;
}

C3dParameters::C3dParameters(const C3dBytes& bytes, const C3dHeader& header, const JobContext& job) : bytes_(bytes) {
  const std::size_t end = header.data_at > header.parameters_at ? std::min(header.data_at, bytes.size()) : bytes.size();
  std::size_t at = header.parameters_at + 4;
  while (at + 2 <= end && bytes.byte(at) != 0) {
    const std::size_t next = read_record(at, end);
    if (next == at)
      job.warn("the parameters of the C3D file are damaged at byte " + std::to_string(at) +
               "; those after it are not known");
    if (next == 0 || next == at) return;
    at = next;
  }
}

// Where the next record begins; 0 after the last, `at` for one that is damaged. A link that leads nowhere is replaced
// by the record's own length (a well-known SGI file has one in the wrong byte order).
std::size_t C3dParameters::read_record(std::size_t at, std::size_t end) {
  const auto signed_byte = [&](std::size_t place) {
    return static_cast<int>(static_cast<std::int8_t>(bytes_.byte(place)));
  };
  const auto name_length = static_cast<std::size_t>(std::abs(signed_byte(at)));  // negative: locked
  const int id = signed_byte(at + 1);
  const std::size_t link = at + 2 + name_length;
  if (link + 2 > end) return at;
  const std::string name = upper(bytes_.text(at + 2, name_length));
  const std::size_t offset = bytes_.word(link);
  const auto next_after = [&](std::size_t body_end) {  // of the record without its description
    if (offset == 0) return std::size_t{0};
    if (link + offset >= body_end && link + offset <= end) return link + offset;
    const std::size_t next = body_end + 1 + (body_end < end ? bytes_.byte(body_end) : 0);
    return next <= end ? next : at;
  };
  if (id < 0) {
    groups_[-id] = name;
    return next_after(link + 2);
  }
  if (link + 4 > end) return at;
  Parameter parameter;
  parameter.type = signed_byte(link + 2);
  const std::size_t num_sizes = bytes_.byte(link + 3);
  parameter.at = link + 4 + num_sizes;
  if (num_sizes > 7 || parameter.at > end) return at;
  parameter.count = 1;
  for (std::size_t k = 0; k < num_sizes; ++k) {
    parameter.sizes.push_back(bytes_.byte(link + 4 + k));
    parameter.count *= parameter.sizes.back();
    if (parameter.count > end) return at;
  }
  const auto element = static_cast<std::size_t>(std::abs(parameter.type));
  if (element != 1 && element != 2 && element != 4) return at;
  if (parameter.count * element > end - parameter.at) return at;
  parameters_.emplace(std::pair(id, name), parameter);
  return next_after(parameter.at + parameter.count * element);
}

const C3dParameters::Parameter* C3dParameters::find(const std::string& name) const {
  const std::size_t colon = name.find(':');
  for (const auto& [id, group] : groups_) {
    if (group != name.substr(0, colon)) continue;
    const auto found = parameters_.find({id, name.substr(colon + 1)});
    if (found != parameters_.end()) return &found->second;
  }
  return nullptr;
}

std::optional<double> C3dParameters::number(const std::string& name, std::size_t idx) const {
  const Parameter* parameter = find(name);
  if (parameter == nullptr || idx >= parameter->count) return {};
  if (parameter->type == 4) return static_cast<double>(bytes_.real(parameter->at + 4 * idx));
  if (parameter->type == 2) return bytes_.signed_word(parameter->at + 2 * idx);
  if (parameter->type == 1) return bytes_.byte(parameter->at + idx);
  return {};
}

std::optional<double> C3dParameters::unsigned_number(const std::string& name, std::size_t idx) const {
  const Parameter* parameter = find(name);
  if (parameter == nullptr || idx >= parameter->count || parameter->type != 2) return number(name, idx);
  return bytes_.word(parameter->at + 2 * idx);
}

std::vector<std::string> C3dParameters::texts(const std::string& name) const {
  std::vector<std::string> out;
  const Parameter* parameter = find(name);
  if (parameter == nullptr || parameter->type != -1) return out;
  const std::size_t length = parameter->sizes.empty() ? 1 : parameter->sizes[0];
  if (length == 0) return out;
  for (std::size_t at = 0; at + length <= parameter->count; at += length)
    out.push_back(bytes_.text(parameter->at + at, length));
  return out;
}

std::vector<std::string> C3dParameters::all_texts(const std::string& name) const {
  std::vector<std::string> out = texts(name);
  for (int k = 2; k < 300; ++k) {
    const std::vector<std::string> more = texts(name + std::to_string(k));
    if (more.empty()) break;
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

std::string C3dParameters::text(const std::string& name) const {
  const std::vector<std::string> all = texts(name);
  return all.empty() ? "" : all[0];
}

}  // namespace motex
