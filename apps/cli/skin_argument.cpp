// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "skin_argument.h"

#include "motex/core/error.h"
#include "motex/motion_io/gltf_skin.h"

namespace motex::cli {

void declare_skin(Arguments& arguments, std::string& skin_path) {
  arguments.value("--skin", "FILE.glb", "the skin that GLB output gets: of a file with the same joints", skin_path);
}

void put_on_skin(const std::string& skin_path, Skeleton& skeleton, Session& session) {
  if (skin_path.empty()) return;
  const auto skin = read_skin(skin_path, session.job());
  try {
    skeleton.skin = lend_skin(*skin, skeleton);
  } catch (const InvalidInput& error) {
    throw InvalidInput(skin_path + ": " + error.what());
  }
}

}  // namespace motex::cli
