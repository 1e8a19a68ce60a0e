// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/joint_map.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

/// "name<parent name", one a joint.
Skeleton skeleton_of(const std::vector<std::pair<std::string, std::string>>& joints) {
  Skeleton out;
  for (const auto& [name, parent] : joints) out.joints.push_back({name, out.find(parent), Vector3(0, 1, 0), {}});
  return out;
}

const Skeleton kDaz =
    skeleton_of({{"hip", ""},           {"abdomen", "hip"},   {"chest", "abdomen"},   {"neck", "chest"},
                 {"head", "neck"},      {"lCollar", "chest"}, {"lShldr", "lCollar"},  {"lForeArm", "lShldr"},
                 {"lHand", "lForeArm"}, {"rCollar", "chest"}, {"rShldr", "rCollar"},  {"rForeArm", "rShldr"},
                 {"rHand", "rForeArm"}, {"lButtock", "hip"},  {"lThigh", "lButtock"}, {"lShin", "lThigh"},
                 {"lFoot", "lShin"},    {"rButtock", "hip"},  {"rThigh", "rButtock"}, {"rShin", "rThigh"},
                 {"rFoot", "rShin"}});

/// Source name by target name.
std::string source_name(const Skeleton& source, const Skeleton& target, const std::string& name) {
  const int s = match_joints(source, target).source_of[static_cast<std::size_t>(target.find(name))];
  return s < 0 ? "" : source.joints[static_cast<std::size_t>(s)].name;
}

/// The same body under a rig's own names: torso chain, then left names of collar … foot; right ones by the second list.
struct Rig {
  std::string pelvis;
  std::vector<std::string> spine;
  std::string neck, head;
  std::vector<std::string> left_arm, right_arm;  // collar (may be ""), upper arm, forearm, hand
  std::vector<std::string> left_leg, right_leg;  // thigh, shin, foot
};

Skeleton rig_skeleton(const Rig& rig) {
  std::vector<std::pair<std::string, std::string>> joints{{rig.pelvis, ""}};
  std::string above = rig.pelvis;
  const auto chain = [&](std::string from, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (!name.empty()) joints.emplace_back(name, from), from = name;
    return from;
  };
  const std::string chest = chain(above, rig.spine);
  chain(chest, {rig.neck, rig.head});
  chain(chest, rig.left_arm), chain(chest, rig.right_arm);
  chain(rig.pelvis, rig.left_leg), chain(rig.pelvis, rig.right_leg);
  return skeleton_of(joints);
}

const std::vector<Rig> kRigs{
    {"mixamorig:Hips",
     {"mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2"},
     "mixamorig:Neck",
     "mixamorig:Head",
     {"mixamorig:LeftShoulder", "mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand"},
     {"mixamorig:RightShoulder", "mixamorig:RightArm", "mixamorig:RightForeArm", "mixamorig:RightHand"},
     {"mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot"},
     {"mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot"}},
    {"Bip001 Pelvis_177",
     {"Bip001 Spine_178", "Bip001 Spine1_193"},
     "Bip001 Neck_194",
     "Bip001 Head_195",
     {"Bip001 L Clavicle_197", "Bip001 L UpperArm_198", "Bip001 L Forearm_199", "Bip001 L Hand_200"},
     {"Bip001 R Clavicle_203", "Bip001 R UpperArm_204", "Bip001 R Forearm_205", "Bip001 R Hand_206"},
     {"Bip001 L Thigh_207", "Bip001 L Calf_208", "Bip001 L Foot_209"},
     {"Bip001 R Thigh_210", "Bip001 R Calf_211", "Bip001 R Foot_212"}},
    {"J_Bip_C_Hips",
     {"J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest"},
     "J_Bip_C_Neck",
     "J_Bip_C_Head",
     {"J_Bip_L_Shoulder", "J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand"},
     {"J_Bip_R_Shoulder", "J_Bip_R_UpperArm", "J_Bip_R_LowerArm", "J_Bip_R_Hand"},
     {"J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg", "J_Bip_L_Foot"},
     {"J_Bip_R_UpperLeg", "J_Bip_R_LowerLeg", "J_Bip_R_Foot"}},
    {"Hips",
     {"Chest", "Chest2"},
     "Neck",
     "Head",
     {"LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist"},
     {"RightCollar", "RightShoulder", "RightElbow", "RightWrist"},
     {"LeftHip", "LeftKnee", "LeftAnkle"},
     {"RightHip", "RightKnee", "RightAnkle"}},
    {"pelvis",
     {"spine_01", "spine_02", "spine_03"},
     "neck_01",
     "head",
     {"clavicle_l", "upperarm_l", "lowerarm_l", "hand_l"},
     {"clavicle_r", "upperarm_r", "lowerarm_r", "hand_r"},
     {"thigh_l", "calf_l", "foot_l"},
     {"thigh_r", "calf_r", "foot_r"}},
    {"root",
     {"lowerback", "upperback", "thorax"},
     "lowerneck",
     "head",
     {"lclavicle", "lhumerus", "lradius", "lhand"},
     {"rclavicle", "rhumerus", "rradius", "rhand"},
     {"lfemur", "ltibia", "lfoot"},
     {"rfemur", "rtibia", "rfoot"}}};

TEST(JointMap, CommonRigs) {
  for (const Rig& rig : kRigs) {
    SCOPED_TRACE(rig.pelvis);
    const Skeleton target = rig_skeleton(rig);
    const auto expect = [&](const std::string& name, const std::string& source) {
      EXPECT_EQ(source_name(kDaz, target, name), source) << name;
    };
    expect(rig.pelvis, "hip");
    expect(rig.spine.front(), "abdomen");
    expect(rig.spine.back(), "chest");
    if (rig.spine.size() > 2) {
      expect(rig.spine[1], "");
    }
    expect(rig.neck, "neck");
    expect(rig.head, "head");
    const char* arm[] = {"Collar", "Shldr", "ForeArm", "Hand"};
    for (std::size_t k = 0; k < 4; ++k) {
      expect(rig.left_arm[k], std::string("l") + arm[k]);
      expect(rig.right_arm[k], std::string("r") + arm[k]);
    }
    const char* leg[] = {"Thigh", "Shin", "Foot"};
    for (std::size_t k = 0; k < 3; ++k) {
      expect(rig.left_leg[k], std::string("l") + leg[k]);
      expect(rig.right_leg[k], std::string("r") + leg[k]);
    }
    // And back.
    EXPECT_EQ(source_name(target, kDaz, "rShldr"), rig.right_arm[1]);
    EXPECT_EQ(source_name(target, kDaz, "lButtock"), "");
  }
}

TEST(JointMap, FingersAndWhatHasNoPart) {
  const Skeleton a =
      skeleton_of({{"Hips", ""}, {"LeftHand", "Hips"}, {"LeftHandIndex1", "LeftHand"}, {"Tail", "Hips"}});
  const Skeleton b =
      skeleton_of({{"x:hips", ""}, {"hand_l", "x:hips"}, {"index_01_l", "hand_l"}, {"x:tail", "x:hips"}});
  EXPECT_EQ(source_name(a, b, "index_01_l"), "LeftHandIndex1");
  EXPECT_EQ(source_name(a, b, "x:tail"), "Tail");
}

TEST(JointMap, ByNames) {
  const Skeleton a = skeleton_of({{"a", ""}, {"b", "a"}}), b = skeleton_of({{"x", ""}, {"y", "x"}});
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  const JointMap map = joint_map_by_names(a, b, Pairs{{"y", "a"}});
  EXPECT_EQ(map.source_of, (std::vector<int>{-1, 0}));
  EXPECT_EQ(map.target_of(0), 1);
  EXPECT_EQ(map.target_of(1), -1);
  EXPECT_THROW(joint_map_by_names(a, b, Pairs{{"z", "a"}}), InvalidInput);
  EXPECT_THROW(joint_map_by_names(a, b, Pairs{{"x", "z"}}), InvalidInput);
  EXPECT_THROW(joint_map_by_names(a, b, Pairs{{"x", "a"}, {"x", "b"}}), InvalidInput);
}

}  // namespace
}  // namespace motex
