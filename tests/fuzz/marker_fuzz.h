// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "motex/core/error.h"
#include "motex/motion_io/c3d.h"
#include "motex/motion_io/trc.h"

namespace motex {

inline void expect_same_shape(const MarkerSet& a, const MarkerSet& b) {
  if (a.num_frames() == b.num_frames() && a.num_markers() == b.num_markers()) return;
  std::cerr << "write and read changed the markers\n";
  std::abort();
}

/// Whatever the bytes are, a reader returns valid markers or throws InvalidInput; what it returns can be written as TRC
/// and C3D and read again with the same frames and markers.
template <typename Read>
int fuzz_markers(Read read) {
  MarkerSet markers;
  try {
    markers = read();
  } catch (const InvalidInput&) {
    return 0;
  }
  check_markers(markers);
  if (markers.positions.size() > 40'000) return 0;
  expect_same_shape(markers, read_trc_bytes(write_trc_bytes(markers), "again.trc"));
  try {
    expect_same_shape(markers, read_c3d_bytes(write_c3d_bytes(markers), "again.c3d"));
  } catch (const ParseError&) {
    throw;
  } catch (const InvalidInput&) {
    return 0;  // more names than a C3D file holds
  }
  return 0;
}

}  // namespace motex
