// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion/rotation.h"

namespace motex {

/// A joint in the posture in which its skin was bound or left, in the world; metres.
struct SkinJoint {
  std::string name;
  Vector3 position = Vector3::Zero();
  Quat rotation = Quat::Identity();
};

/// The skinned meshes that a GLB came in with: to be written again, not to be looked into. Made by motion_io alone
/// (gltf_skin.h), which has checked every size and index in it.
struct Skin {
  std::vector<SkinJoint> joints;  ///< those that move vertices, by their names in the skeleton
  std::string glb;                ///< a file of its own: these joints, meshes, materials and pictures
};

}  // namespace motex
