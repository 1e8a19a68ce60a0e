// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_fuzz.h"
#include "motex/motion_io/gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return motex::fuzz_clip([&] { return motex::read_gltf_bytes({reinterpret_cast<const char*>(data), size}, "fuzz"); });
}
