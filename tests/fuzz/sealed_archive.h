// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "motex/core/archive.h"

namespace motex {

/// The bytes, the last four of them made the right checksum, which no mutation would find.
inline std::string sealed_archive(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (size > 16) {
    const std::uint32_t crc = archive_checksum(std::string_view(bytes).substr(0, size - 4));
    std::memcpy(bytes.data() + size - 4, &crc, 4);
  }
  return bytes;
}

}  // namespace motex
