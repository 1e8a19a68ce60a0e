// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "motex/core/error.h"
#include "motex/motion_io/bvh.h"
#include "motex/motion_io/gltf.h"

namespace motex {

/// Whatever the bytes are, a reader returns a valid clip or throws InvalidInput; a clip that it returns can be written
/// as BVH and read again with the same frames and joints, and as GLB.
template <typename Read>
int fuzz_clip(Read read) {
  Clip clip;
  try {
    clip = read();
  } catch (const InvalidInput&) {
    return 0;
  }
  check_clip(clip);
  if (clip.rotations.size() > 40'000) return 0;
  const Clip again = read_bvh_bytes(write_bvh_bytes(clip), "again");
  if (again.num_frames() != clip.num_frames() || again.skeleton.num_joints() != clip.skeleton.num_joints()) {
    std::cerr << "write and read changed the clip\n";
    std::abort();
  }
  try {
    write_glb_bytes(clip);
  } catch (const InvalidInput&) {
    return 0;  // a frame time below single precision
  }
  return 0;
}

}  // namespace motex
