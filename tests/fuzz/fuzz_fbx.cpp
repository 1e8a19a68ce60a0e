// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_fuzz.h"
#include "motex/motion_io/fbx.h"

// Assimp itself is a library of the system and not instrumented: what is looked for here is what gets past the check of
// the records.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return motex::fuzz_clip([&] { return motex::read_fbx_bytes({reinterpret_cast<const char*>(data), size}, "fuzz"); });
}
