// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace motex {

/// What a decoder reads from: a file or bytes in memory, so that no library opens anything by itself.
class InputBytes {
 public:
  virtual ~InputBytes() = default;
  /// Bytes read, 0 at the end, −1 when reading failed.
  virtual std::int64_t read(char* target, std::int64_t num_bytes) = 0;
  /// Whether it worked; from the beginning.
  virtual bool seek(std::int64_t position) = 0;
  virtual std::int64_t position() const = 0;
  /// −1 when unknown (a pipe).
  virtual std::int64_t size() const = 0;
  /// A second reader of the same bytes, at the beginning; null for a pipe.
  virtual std::unique_ptr<InputBytes> again() const = 0;
};

/// Throws InvalidInput when it cannot be opened.
std::unique_ptr<InputBytes> open_input(const std::filesystem::path& path);
/// The bytes must live as long as the reader.
std::unique_ptr<InputBytes> open_input(std::string_view bytes);

/// The first bytes, at most that many; the position is put back. Empty for a pipe.
std::string peek(InputBytes& input, std::size_t num_bytes);

/// Throws UnsupportedFile with the reason for what is no video at all: nothing in it, a Git-LFS pointer, a web page,
/// another text.
void refuse_text(InputBytes& input, const std::string& name);

}  // namespace motex
