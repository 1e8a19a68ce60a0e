// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/core/lowered.h"
#include "motex/motion_io/gltf_buffers.h"
#include "motex/motion_io/gltf_container.h"
#include "motex/motion_io/gltf_skin.h"

namespace motex {
namespace {

using Json = nlohmann::json;
constexpr double kSame = 0.03;  // of the mean length of bones

/// Without prefix, in lower case.
std::string plain_name(const std::string& name) { return lowered(name.substr(name.find_last_of(":|") + 1)); }

/// Joint of the skeleton by joint of the skin.
std::vector<int> find_joints(const Skin& skin, const Skeleton& skeleton) {
  std::map<std::string, int> of_name;
  for (int j = 0; j < skeleton.num_joints(); ++j)
    of_name.emplace(plain_name(skeleton.joints[static_cast<std::size_t>(j)].name), j);
  std::vector<int> joints;
  for (const SkinJoint& joint : skin.joints) {
    const auto found = of_name.find(plain_name(joint.name));
    const int exact = skeleton.find(joint.name);
    if (exact < 0 && found == of_name.end())
      throw InvalidInput("the skin's joint '" + joint.name + "' is not in the skeleton");
    joints.push_back(exact >= 0 ? exact : found->second);
  }
  return joints;
}

/// A bone of the skin: parent and child, indices into Skin::joints.
struct Bone {
  std::size_t parent, child;
};
std::vector<Bone> bones_of(const std::vector<int>& joints, const Skeleton& skeleton) {
  std::vector<Bone> bones;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const int parent = skeleton.joints[static_cast<std::size_t>(joints[k])].parent_idx;
    const auto found = std::find(joints.begin(), joints.end(), parent);
    if (parent >= 0 && found != joints.end()) bones.push_back({static_cast<std::size_t>(found - joints.begin()), k});
  }
  return bones;
}

/// How the skin's bones compare with the skeleton's.
struct Likeness {
  double scale = 1;          ///< skeleton's units for a metre of the skin
  bool same_frames = true;   ///< bones are the same seen from their joints
  bool same_posture = true;  ///< at rest they are the same in the world
};

Likeness compare(const Skin& skin, const Skeleton& skeleton, const std::vector<int>& joints) {
  const std::vector<Bone> bones = bones_of(joints, skeleton);
  double of_skin = 0, of_skeleton = 0;
  const auto offset = [&](const Bone& b) { return skeleton.joints[static_cast<std::size_t>(joints[b.child])].offset; };
  const auto bone = [&](const Bone& b) {
    return Vector3(skin.joints[b.child].position - skin.joints[b.parent].position);
  };
  for (const Bone& b : bones) of_skin += bone(b).norm(), of_skeleton += offset(b).norm();
  Likeness out;
  if (!(of_skin > 0) || !(of_skeleton > 0)) return out;
  out.scale = of_skeleton / of_skin;
  const double near = kSame * of_skeleton / static_cast<double>(bones.size());
  for (const Bone& b : bones) {
    const Vector3 turned = skin.joints[b.parent].rotation.conjugate() * bone(b);
    out.same_frames = out.same_frames && (out.scale * turned - offset(b)).norm() <= near + kSame * offset(b).norm();
    out.same_posture = out.same_posture && (out.scale * bone(b) - offset(b)).norm() <= near + kSame * offset(b).norm();
  }
  return out;
}

}  // namespace

bool skin_fits(const Skeleton& skeleton) {
  if (!skeleton.skin || skeleton.skin->joints.empty()) return false;
  const auto& joints = skeleton.skin->joints;
  return std::all_of(joints.begin(), joints.end(), [&](const SkinJoint& j) { return skeleton.find(j.name) >= 0; });
}

std::shared_ptr<const Skin> lend_skin(const Skin& skin, const Skeleton& skeleton) {
  const std::vector<int> joints = find_joints(skin, skeleton);
  const Likeness like = compare(skin, skeleton, joints);
  if (!like.same_frames && !like.same_posture)
    throw InvalidInput(
        "the skin was made for other bones than this skeleton has; bring the motion to the skin's "
        "skeleton first (motex motion retarget)");
  GlbBuilder out;
  out.import(skin.glb, "skin");
  Json root = Json::parse(split_glb(skin.glb, "skin").json);
  auto lent = std::make_shared<Skin>();
  const auto name_of = [&](std::size_t k) { return skeleton.joints[static_cast<std::size_t>(joints[k])].name; };
  for (std::size_t k = 0; k < joints.size(); ++k) {
    SkinJoint joint = skin.joints[k];
    joint.name = name_of(k);
    if (!like.same_frames) joint.rotation = Quat::Identity();
    const Eigen::Vector4d q = joint.rotation.coeffs();
    root["nodes"][k]["name"] = joint.name;
    root["nodes"][k]["rotation"] = {q[0], q[1], q[2], q[3]};
    lent->joints.push_back(joint);
  }
  for (const Json& from : root["skins"]) {
    if (like.same_frames) break;
    char* data = out.data(from.at("inverseBindMatrices"));
    for (const Json& idx : from.at("joints")) {
      Eigen::Matrix4f matrix;
      std::memcpy(matrix.data(), data, sizeof matrix);
      const Eigen::Matrix3f turn = skin.joints.at(idx.get<std::size_t>()).rotation.toRotationMatrix().cast<float>();
      matrix.topRows<3>() = (turn * matrix.topRows<3>()).eval();
      std::memcpy(data, matrix.data(), sizeof matrix);
      data += sizeof matrix;
    }
  }
  root.erase("bufferViews"), root.erase("accessors"), root.erase("buffers");
  lent->glb = out.file(root.dump(-1, ' ', false, Json::error_handler_t::replace), "skin");
  return lent;
}

}  // namespace motex
