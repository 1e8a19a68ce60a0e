// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "motex/motion/skeleton.h"

namespace motex {

/// Which joint of one body plays the part of which joint of another.
struct JointMap {
  std::vector<int> source_of;  ///< by joint of the target: the joint of the source, or −1

  int num_matched() const;
  /// Joint of the target that takes from that joint of the source, or −1.
  int target_of(int source) const;
};

/// Side and part of the body that a name stands for in the usual rigs (CMU and other BVH, Acclaim, Mixamo, Daz, Biped,
/// Unreal, VRM), such as "left thigh" of mixamorig:LeftUpLeg, lThigh, "Bip01 L Thigh", thigh_l, J_Bip_L_UpperLeg;
/// "" where it stands for none. Names that mean one part in one rig and another in the next (shoulder, arm, leg, hip)
/// are told apart by what else the skeleton has. Of several joints of one part the uppermost has it.
std::vector<std::string> body_parts(const Skeleton& skeleton);

/// Joints of the same part of the body, the chains of spine and neck spread from end to end, then joints whose names
/// are equal but for case and prefix.
JointMap match_joints(const Skeleton& source, const Skeleton& target);

/// By names: pairs of target joint and source joint. Throws InvalidInput for a name that is no joint, and for a target
/// that is named twice.
JointMap joint_map_by_names(const Skeleton& source, const Skeleton& target,
                            std::span<const std::pair<std::string, std::string>> target_and_source);

}  // namespace motex
