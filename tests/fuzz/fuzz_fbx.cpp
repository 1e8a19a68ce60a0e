// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "motex/core/error.h"
#include "motex/motion_io/fbx.h"

// The check of the records is ours. Assimp behind it is a library of the system with faults of its own.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    motex::check_fbx_records({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const motex::Error&) {  // wanted
  }
  return 0;
}
