// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/archive.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "motex/core/error.h"

namespace motex {
namespace {

static_assert(std::endian::native == std::endian::little, "archives are written in native little-endian order");

constexpr char kMagic[] = "\x89MOTEX\r\n";
constexpr std::size_t kMagicSize = sizeof kMagic - 1;
constexpr std::uint64_t kMostOfEmpty = 1U << 20;
constexpr char kText = 't', kDouble = 'd', kFloat = 'f', kInt = 'i';

std::size_t element_size(char type) { return type == kText ? 1 : type == kFloat ? 4 : 8; }

template <typename T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_name(std::string& out, const std::string& name) {
  if (name.size() > 65535) throw InvalidInput("archive: a name is longer than 65535 bytes");
  put(out, static_cast<std::uint16_t>(name.size()));
  out += name;
}

/// memcpy() must not be given the null pointer that an empty array has.
template <typename T>
void copy_elements(const std::string& bytes, std::size_t offset, T* out, std::size_t count) {
  if (count > 0) std::memcpy(out, bytes.data() + offset, count * sizeof(T));
}

/// Takes values off the front; every step is checked.
struct Cursor {
  const std::string& bytes;
  const std::string& name;
  std::size_t at;
  std::size_t end;

  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(at), message);
  }
  void need(std::uint64_t count) const {
    if (count > end - at) fail("the file ends too early; it is truncated or altered");
  }
  template <typename T>
  T take() {
    need(sizeof(T));
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
    return value;
  }
  std::string take_name() {
    const auto size = take<std::uint16_t>();
    need(size);
    std::string text = bytes.substr(at, size);
    at += size;
    return text;
  }
};

}  // namespace

std::uint32_t archive_checksum(std::string_view bytes) {
  uLong crc = crc32_z(0, nullptr, 0);
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

ArchiveWriter::ArchiveWriter(const std::string& kind, std::uint32_t version) {
  header_.assign(kMagic, kMagicSize);
  put(header_, version);
  put_name(header_, kind);
}

template <typename T>
void ArchiveWriter::add_elements(const std::string& name, char type, std::span<const std::uint64_t> sizes,
                                 const T* data) {
  put_name(body_, name);
  put(body_, type);
  put(body_, static_cast<std::uint8_t>(sizes.size()));
  std::uint64_t count = 1;
  for (const auto size : sizes) {
    put(body_, size);
    count *= size;
  }
  body_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
  ++num_entries_;
}

void ArchiveWriter::add(const std::string& name, std::string_view text) {
  const std::uint64_t sizes[] = {text.size()};
  add_elements(name, kText, sizes, text.data());
}

void ArchiveWriter::add(const std::string& name, const FrameMatrix& values) {
  const std::uint64_t sizes[] = {static_cast<std::uint64_t>(values.rows()), static_cast<std::uint64_t>(values.cols())};
  add_elements(name, kDouble, sizes, values.data());
}

void ArchiveWriter::add(const std::string& name, const FrameMatrixF& values) {
  const std::uint64_t sizes[] = {static_cast<std::uint64_t>(values.rows()), static_cast<std::uint64_t>(values.cols())};
  add_elements(name, kFloat, sizes, values.data());
}

void ArchiveWriter::add(const std::string& name, std::span<const std::int64_t> values) {
  const std::uint64_t sizes[] = {values.size()};
  add_elements(name, kInt, sizes, values.data());
}

void ArchiveWriter::add(const std::string& name, std::span<const double> values) {
  const std::uint64_t sizes[] = {values.size()};
  add_elements(name, kDouble, sizes, values.data());
}

std::string ArchiveWriter::bytes() const {
  std::string out = header_;
  put(out, num_entries_);
  out += body_;
  put(out, archive_checksum(out));
  return out;
}

ArchiveReader::ArchiveReader(std::string bytes, std::string name, std::string_view kind, std::uint32_t max_version)
    : bytes_(std::move(bytes)), name_(std::move(name)) {
  if (bytes_.compare(0, kMagicSize, kMagic, kMagicSize) != 0)
    throw UnsupportedFile(name_ + ": is not a motex model (it does not begin like one)");
  Cursor cursor{bytes_, name_, kMagicSize, bytes_.size()};
  version_ = cursor.take<std::uint32_t>();
  const std::string found = cursor.take_name();
  if (found != kind) throw UnsupportedFile(name_ + ": holds a '" + found + "', not a '" + std::string(kind) + "'");
  if (version_ > max_version)
    throw UnsupportedFile(name_ + ": was written by a newer motex (model version " + std::to_string(version_) +
                          ", this one reads up to " + std::to_string(max_version) + ")");
  cursor.need(8);
  std::uint32_t stored;
  std::memcpy(&stored, bytes_.data() + bytes_.size() - 4, 4);
  cursor.end = bytes_.size() - 4;
  if (stored != archive_checksum(std::string_view(bytes_).substr(0, cursor.end)))
    cursor.fail("the checksum does not match; the file is truncated or altered");
  const auto num_entries = cursor.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < num_entries; ++i) {
    const std::string entry_name = cursor.take_name();
    Entry entry{cursor.take<char>(), 1, 1, 0};
    if (std::strchr("tdfi", entry.type) == nullptr || entry.type == '\0') cursor.fail("unknown type of array");
    const auto num_dims = cursor.take<std::uint8_t>();
    if (num_dims < 1 || num_dims > 2) cursor.fail("an array must have one or two dimensions");
    std::uint64_t sizes[2] = {1, 1};
    for (int d = 0; d < num_dims; ++d) sizes[d] = cursor.take<std::uint64_t>();
    const std::uint64_t most = (cursor.end - cursor.at) / element_size(entry.type);
    // An array without elements keeps its other size, such as 0 × 13; that one is bounded by itself.
    const bool is_empty = sizes[0] == 0 || sizes[1] == 0;
    if (is_empty ? std::max(sizes[0], sizes[1]) > kMostOfEmpty : sizes[0] > most / sizes[1])
      cursor.fail("an array is larger than the file");
    cursor.need(sizes[0] * sizes[1] * element_size(entry.type));
    entry.rows = static_cast<Index>(sizes[0]);
    entry.cols = static_cast<Index>(sizes[1]);
    entry.offset = cursor.at;
    cursor.at += sizes[0] * sizes[1] * element_size(entry.type);
    if (!entries_.emplace(entry_name, entry).second) cursor.fail("the array '" + entry_name + "' stands twice");
  }
  if (cursor.at != cursor.end) cursor.fail("bytes are left over after the last array");
}

void ArchiveReader::fail(const std::string& message) const { throw InvalidInput(name_ + ": " + message); }

const ArchiveReader::Entry& ArchiveReader::find(const std::string& name, char type, Index rows, Index cols) const {
  const auto it = entries_.find(name);
  if (it == entries_.end()) fail("the array '" + name + "' is missing");
  const Entry& entry = it->second;
  if (entry.type != type) fail("the array '" + name + "' has another type than expected");
  if ((rows >= 0 && entry.rows != rows) || (cols >= 0 && entry.cols != cols))
    fail("the array '" + name + "' is " + std::to_string(entry.rows) + " × " + std::to_string(entry.cols) + ", not " +
         (rows >= 0 ? std::to_string(rows) : "n") + " × " + (cols >= 0 ? std::to_string(cols) : "m"));
  return entry;
}

std::string ArchiveReader::text(const std::string& name) const {
  const Entry& entry = find(name, kText, -1, 1);
  return bytes_.substr(entry.offset, static_cast<std::size_t>(entry.rows));
}

FrameMatrix ArchiveReader::matrix(const std::string& name, Index rows, Index cols) const {
  const Entry& entry = find(name, kDouble, rows, cols);
  FrameMatrix out(entry.rows, entry.cols);
  copy_elements(bytes_, entry.offset, out.data(), static_cast<std::size_t>(out.size()));
  if (!out.allFinite()) fail("the array '" + name + "' holds a number that is not finite");
  return out;
}

FrameMatrixF ArchiveReader::matrix_f(const std::string& name, Index rows, Index cols) const {
  const Entry& entry = find(name, kFloat, rows, cols);
  FrameMatrixF out(entry.rows, entry.cols);
  copy_elements(bytes_, entry.offset, out.data(), static_cast<std::size_t>(out.size()));
  if (!out.allFinite()) fail("the array '" + name + "' holds a number that is not finite");
  return out;
}

std::vector<std::int64_t> ArchiveReader::ints(const std::string& name, Index size) const {
  const Entry& entry = find(name, kInt, size, 1);
  std::vector<std::int64_t> out(static_cast<std::size_t>(entry.rows));
  copy_elements(bytes_, entry.offset, out.data(), out.size());
  return out;
}

std::vector<double> ArchiveReader::doubles(const std::string& name, Index size) const {
  const FrameMatrix values = matrix(name, size, 1);
  return {values.data(), values.data() + values.size()};
}

const char* zlib_release() { return zlibVersion(); }

}  // namespace motex
