// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include "motex/core/error.h"
#include "motex/motion_io/fbx.h"

namespace motex {
namespace {

constexpr std::string_view kBinaryMark = "Kaydara FBX Binary";
constexpr std::size_t kHeaderSize = 27, kMaxDepth = 64;
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
constexpr std::uint64_t kMostDeflate = 1032;  // no deflate stream grows by more

class BinaryChecker {
 public:
  BinaryChecker(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    wide_ = read(23, 4) >= 7500;
  }

  void check() {
    std::vector<std::uint64_t> ends;  // of the records that are open
    std::uint64_t at = kHeaderSize;
    const std::uint64_t word = wide_ ? 8 : 4, head = 3 * word + 1;
    while (at + head <= bytes_.size()) {
      while (!ends.empty() && at >= ends.back()) {
        if (at > ends.back()) fail(at, "a record reaches beyond the one that it lies in");
        ends.pop_back();
      }
      const std::uint64_t end = read(at, word);
      if (end == 0) {  // closes a list of records; at the top, the file's footer follows
        if (ends.empty()) return;
        at += head;
        if (at > ends.back()) fail(at, "a list of records reaches beyond its record");
        continue;
      }
      const std::uint64_t num_properties = read(at + word, word), list_size = read(at + 2 * word, word);
      const std::uint64_t properties = at + head + read(at + 3 * word, 1);
      const std::uint64_t limit = ends.empty() ? bytes_.size() : ends.back();
      if (end > limit || end <= at || properties > end || list_size > end - properties)
        fail(at, "a record reaches beyond the end of the file or of the record that it lies in");
      check_properties(properties, properties + list_size, num_properties);
      at = properties + list_size;
      if (at == end) continue;
      if (ends.size() == kMaxDepth) fail(at, "records lie in one another more than 64 deep");
      ends.push_back(end);
    }
  }

 private:
  [[noreturn]] void fail(std::uint64_t at, const std::string& message) const {
    throw ParseError(name_, ParseError::Unit::kByte, static_cast<std::int64_t>(at), message);
  }

  std::uint64_t read(std::uint64_t at, std::uint64_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at) fail(bytes_.size(), "the file ends too early");
    std::uint64_t value = 0;
    for (std::uint64_t k = count; k-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes_[at + k]);
    return value;
  }

  void check_properties(std::uint64_t at, std::uint64_t end, std::uint64_t count) const {
    for (; count > 0; --count) {
      if (at >= end) fail(at, "a record has fewer properties than it states");
      at = after_property(at, end);
    }
  }

  std::uint64_t after_property(std::uint64_t at, std::uint64_t end) const {
    const char type = bytes_[at++];
    std::uint64_t size = 0;
    switch (type) {
      case 'C':
      case 'B':
        size = 1;
        break;
      case 'Y':
        size = 2;
        break;
      case 'I':
      case 'F':
        size = 4;
        break;
      case 'D':
      case 'L':
        size = 8;
        break;
      case 'S':
      case 'R':
        size = 4 + read(at, 4);
        break;
      case 'b':
      case 'c':
        size = array_size(at, 1);
        break;
      case 'i':
      case 'f':
        size = array_size(at, 4);
        break;
      case 'd':
      case 'l':
        size = array_size(at, 8);
        break;
      default:
        fail(at - 1, "a property is of no known type");
    }
    if (at > end || size > end - at) fail(at, "a property reaches beyond its record");
    return at + size;
  }

  std::uint64_t array_size(std::uint64_t at, std::uint64_t element) const {
    const std::uint64_t count = read(at, 4), encoding = read(at + 4, 4), stored = read(at + 8, 4);
    const bool deflated = encoding == 1;
    if (encoding > 1 || count * element > (deflated ? kMostDeflate * stored + kMostDeflate : stored))
      fail(at, "an array states more numbers than its bytes can hold");
    return 12 + stored;
  }

  std::string_view bytes_;
  const std::string& name_;
  bool wide_ = false;
};

void check_text(std::string_view text, const std::string& name) {
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') quoted = !quoted;
    if (quoted) continue;
    if (text[at] == ';') at = std::min(text.find('\n', at), text.size());
    if (at < text.size() && text[at] == '}' && depth > 0) --depth;
    if (at < text.size() && text[at] == '{' && ++depth > kMaxDepth)
      throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(at),
                       "records lie in one another more than 64 deep");
  }
}

}  // namespace

void check_fbx_records(std::string_view bytes, const std::string& name) {
  if (bytes.size() > kLargestFile) throw InvalidInput(name + ": FBX files beyond 1 GiB are not read");
  if (bytes.substr(0, kBinaryMark.size()) != kBinaryMark) return check_text(bytes, name);
  if (bytes.size() < kHeaderSize)
    throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(bytes.size()), "the file ends too early");
  BinaryChecker(bytes, name).check();
}

}  // namespace motex
