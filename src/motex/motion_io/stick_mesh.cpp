// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/stick_mesh.h"

#include <algorithm>

namespace motex {
namespace {

constexpr double kShoulder = 0.15;                   // share of its length at which a stick is thickest
constexpr double kThickness = 0.06;                  // half of it there, as a share of the length
constexpr double kShortest = 1e-5, kDiamond = 0.05;  // metres

void add_stick(const Vector3& from, const Vector3& to, int joint, StickMesh& mesh) {
  const Vector3 along = to - from;
  const double length = along.norm();
  if (!(length > kShortest)) return;
  const Vector3 side = along.unitOrthogonal() * (kThickness * length);
  const Vector3 other = along.cross(side) / length;
  const Vector3 middle = from + kShoulder * along;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3& p :
       {from, Vector3(middle + side), Vector3(middle + other), Vector3(middle - side), Vector3(middle - other), to}) {
    mesh.positions.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    mesh.joints.push_back(static_cast<std::uint16_t>(joint));
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t a = first + 1 + i, b = first + 1 + (i + 1) % 4;
    for (const std::uint32_t corner : {first, b, a, a, b, first + 5}) mesh.triangles.push_back(corner);
  }
}

}  // namespace

std::vector<Vector3> rest_positions(const Skeleton& skeleton) {
  std::vector<Vector3> rest;
  for (const Joint& joint : skeleton.joints)
    rest.push_back(joint.parent_idx < 0 ? joint.offset
                                        : Vector3(rest[static_cast<std::size_t>(joint.parent_idx)] + joint.offset));
  return rest;
}

StickMesh make_stick_mesh(const Skeleton& skeleton, double scale) {
  StickMesh mesh;
  const std::vector<Vector3> rest = rest_positions(skeleton);
  const auto stick = [&](int from, const Vector3& offset) {
    const Vector3& start = rest[static_cast<std::size_t>(from)];
    add_stick(start * scale, (start + offset) * scale, from, mesh);
  };
  for (const Joint& joint : skeleton.joints)
    if (joint.parent_idx >= 0) stick(joint.parent_idx, joint.offset);
  for (const EndSite& site : skeleton.end_sites) stick(site.parent_idx, site.offset);
  if (mesh.positions.empty()) add_stick(rest[0] * scale, rest[0] * scale + Vector3(0, kDiamond, 0), 0, mesh);
  return mesh;
}

}  // namespace motex
