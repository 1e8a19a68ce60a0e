// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"

namespace motex {

/// How the machine that wrote a C3D file stored its numbers.
enum class C3dProcessor : std::uint8_t { kIntel = 84, kDec = 85, kSgi = 86 };

/// Numbers of a C3D file at byte offsets, in the order of its processor. DEC (VAX) floats have swapped 16-bit words and
/// an exponent that is 2 higher. Reading beyond the end throws ParseError with the byte.
class C3dBytes {
 public:
  C3dBytes(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  std::uint8_t byte(std::size_t at) const;
  std::uint16_t word(std::size_t at) const;
  std::int16_t signed_word(std::size_t at) const { return static_cast<std::int16_t>(word(at)); }
  float real(std::size_t at) const;
  /// Trailing blanks and zeros are left out.
  std::string text(std::size_t at, std::size_t length) const;
  std::size_t size() const { return bytes_.size(); }
  [[noreturn]] void fail(std::size_t at, const std::string& message) const;

  C3dProcessor processor = C3dProcessor::kIntel;

 private:
  void need(std::size_t at, std::size_t count) const;
  std::string_view bytes_;
  std::string file_;
};

/// The first 512 bytes.
struct C3dHeader {
  std::size_t parameters_at = 512, data_at = 0;  ///< bytes
  int num_points = 0;
  int analog_per_frame = 0;  ///< numbers after the points of a frame
  int first_frame = 0, last_frame = 0;
  double scale = 0;  ///< length unit of one step of an integer; negative: the data are floats
  double frame_rate = 0;
};

/// Finds the processor (in the parameter section) and reads the header by it. Throws ParseError.
C3dHeader read_c3d_header(C3dBytes& bytes, const JobContext& job);

/// The named parameters, as "POINT:LABELS". A damaged section gives those before the damage and a warning with the
/// byte.
class C3dParameters {
 public:
  C3dParameters(const C3dBytes& bytes, const C3dHeader& header, const JobContext& job);

  std::optional<double> number(const std::string& name, std::size_t idx = 0) const;
  /// A 16-bit integer without sign.
  std::optional<double> unsigned_number(const std::string& name, std::size_t idx = 0) const;
  /// One text a row of a character array; empty when there is none of that name.
  std::vector<std::string> texts(const std::string& name) const;
  /// NAME, NAME2, NAME3 … in one list: a C3D array has 255 elements at most.
  std::vector<std::string> all_texts(const std::string& name) const;
  std::string text(const std::string& name) const;

 private:
  struct Parameter {
    int type = 0;  ///< −1 characters, 1 bytes, 2 integers, 4 floats
    std::vector<std::size_t> sizes;
    std::size_t at = 0, count = 0;
  };
  std::size_t read_record(std::size_t at, std::size_t end);
  const Parameter* find(const std::string& name) const;

  const C3dBytes& bytes_;
  std::map<int, std::string> groups_;
  std::map<std::pair<int, std::string>, Parameter> parameters_;
};

}  // namespace motex
