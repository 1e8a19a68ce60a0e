// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "motex/project/people_model_file.h"
#include "round_trip.h"
#include "sealed_archive.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  motex::round_trip(motex::sealed_archive(data, size), motex::parse_people_model, motex::people_model_bytes);
  return 0;
}
