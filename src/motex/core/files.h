// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace motex {

/// The whole file. Throws InvalidInput when it cannot be read, is a folder, or is larger than max_bytes.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = std::uint64_t{4} << 30);

/// A file that appears whole or not at all: written under a temporary name beside the target, renamed by commit().
/// Destroyed without commit(), the temporary is removed and an old target is untouched.
/// A target that exists and is no regular file (a pipe, /dev/stdout) is written directly.
class AtomicFile {
 public:
  /// Throws InvalidInput when the folder is missing or not writable.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Throws WriteError when the disk is full or fails.
  void write(std::string_view bytes);
  /// Goes on writing at that place, from the beginning of the file; false where that is impossible (a pipe).
  bool seek(std::uint64_t position);
  /// Flushes to disk and renames. Throws WriteError; then the old target is untouched.
  void commit();

 private:
  [[noreturn]] void fail(const char* doing);
  std::filesystem::path path_, temporary_;
  std::FILE* file_ = nullptr;
};

/// AtomicFile in one call.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace motex
