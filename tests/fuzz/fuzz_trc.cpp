// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "marker_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return motex::fuzz_markers([&] {
    return motex::read_trc_bytes({reinterpret_cast<const char*>(data), size}, "fuzz.trc");
  });
}
