// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <string_view>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/project/textured_motion_file.h"

namespace motex {
namespace {

/// Whatever the bytes are, the reader returns a model or throws; a model that it returns is written and read again as
/// the same bytes.
void try_model(const std::string& bytes) {
  TexturedMotion model;
  try {
    model = parse_textured_motion(bytes, "fuzz");
  } catch (const Error&) {
    return;
  }
  const std::string written = textured_motion_bytes(model);
  if (textured_motion_bytes(parse_textured_motion(written, "again")) != written) {
    std::cerr << "write and read changed the model\n";
    std::abort();
  }
}

}  // namespace
}  // namespace motex

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  // The last four bytes are made the right checksum, which no mutation would find.
  if (size > 16) {
    const std::uint32_t crc = motex::archive_checksum(std::string_view(bytes).substr(0, size - 4));
    std::memcpy(bytes.data() + size - 4, &crc, 4);
  }
  motex::try_model(bytes);
  return 0;
}
