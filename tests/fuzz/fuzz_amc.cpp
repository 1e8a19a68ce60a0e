// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_fuzz.h"
#include "motex/motion_io/asf_amc.h"

// The skeleton, byte 0x1E, the motion.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view both(reinterpret_cast<const char*>(data), size);
  const std::size_t split = std::min(both.find('\x1E'), size);
  const motex::NamedText asf{both.substr(0, split), "fuzz.asf"};
  const motex::NamedText amc{both.substr(std::min(split + 1, size)), "fuzz.amc"};
  return motex::fuzz_clip([&] { return motex::read_amc_bytes(asf, amc); });
}
