// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motex/core/matrix.h"

namespace motex {

/// Named arrays in one versioned file (docs/formats.md): the container of every motex model.
///
///   "\x89MOTEX\r\n"  u32 format version  u16+bytes kind  u32 number of entries
///   per entry: u16+bytes name, u8 type, u8 number of dimensions (≤ 2), u64 sizes, the elements
///   u32 CRC-32 of everything before it; all little-endian
class ArchiveWriter {
 public:
  /// kind: what the archive holds ("motion_texture"); version: of that kind's fields.
  ArchiveWriter(const std::string& kind, std::uint32_t version);
  void add(const std::string& name, std::string_view text);
  void add(const std::string& name, const FrameMatrix& values);
  void add(const std::string& name, const FrameMatrixF& values);
  void add(const std::string& name, std::span<const std::int64_t> values);
  void add(const std::string& name, std::span<const double> values);
  /// The complete file; the writer may go on to be used.
  std::string bytes() const;

 private:
  template <typename T>
  void add_elements(const std::string& name, char type, std::span<const std::uint64_t> sizes, const T* data);
  std::string header_, body_;
  std::uint32_t num_entries_ = 0;
};

/// CRC-32 of the bytes, as archives end with.
std::uint32_t archive_checksum(std::string_view bytes);

/// Reads what ArchiveWriter wrote, from strangers too: every size is checked against the bytes that are there before
/// anything is allocated. Throws ParseError (with the byte) when truncated, altered or foreign, UnsupportedFile when
/// the kind differs or the version is newer.
class ArchiveReader {
 public:
  /// name: for messages. The bytes are copied.
  ArchiveReader(std::string bytes, std::string name, std::string_view kind, std::uint32_t max_version);

  std::uint32_t version() const { return version_; }
  bool has(const std::string& name) const { return entries_.count(name) != 0; }
  /// Each throws InvalidInput naming the entry when it is missing, of another type, or (sizes ≥ 0) of another size.
  std::string text(const std::string& name) const;
  FrameMatrix matrix(const std::string& name, Index rows = -1, Index cols = -1) const;
  FrameMatrixF matrix_f(const std::string& name, Index rows = -1, Index cols = -1) const;
  std::vector<std::int64_t> ints(const std::string& name, Index size = -1) const;
  std::vector<double> doubles(const std::string& name, Index size = -1) const;
  /// "model.motex: " + message, for checks of the fields' meaning.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  struct Entry {
    char type;
    Index rows, cols;
    std::size_t offset;
  };
  const Entry& find(const std::string& name, char type, Index rows, Index cols) const;
  std::string bytes_, name_;
  std::uint32_t version_ = 0;
  std::map<std::string, Entry> entries_;
};

/// Version of the zlib that is linked, for `motex doctor`.
const char* zlib_release();

}  // namespace motex
