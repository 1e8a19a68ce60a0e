// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/particles/clip_codec.h"

// Whatever the bytes are, the reader gives a clip or throws; a clip that it gives is written and read again as the same
// cables.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  // The last four bytes are made the right checksum, which no mutation would find.
  if (size > 8) {
    const std::uint32_t checksum = motex::archive_checksum(std::string_view(bytes).substr(0, size - 4));
    std::memcpy(bytes.data() + size - 4, &checksum, 4);
  }
  motex::QuantisedClip clip;
  try {
    clip = motex::read_clip_bytes(bytes, "fuzz");
  } catch (const motex::InvalidInput&) {
    return 0;
  }
  if (clip.background[0].values.size() > 1'000'000) return 0;
  const motex::QuantisedClip again = motex::read_clip_bytes(motex::write_clip_bytes(clip, clip.background), "again");
  motex::sort_for_coding(clip);
  if (again.cables != clip.cables) std::abort();
  return 0;
}
