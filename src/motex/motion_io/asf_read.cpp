// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>
#include <numbers>

#include "motex/core/error.h"
#include "motex/motion_io/asf.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

constexpr std::size_t kMaxBones = 10'000;
constexpr double kMetresPerInch = 0.0254;

using Words = std::vector<std::string_view>;

class AsfReader {
 public:
  AsfReader(std::string_view bytes, const std::string& name) : scan_(bytes, name) {
    bones_.emplace_back().name = "root";
    idx_of_["root"] = 0;
  }
  AsfSkeleton read();

 private:
  void read_line(const Words& words);
  void read_unit(const Words& words);
  void read_root(const Words& words);
  void read_bone(const Words& words);
  void read_hierarchy(const Words& words);
  void finish_bone();
  void read_axis_order(std::string_view text, AsfBone& bone);
  AsfDof dof(std::string_view word);
  Vector3 three(const Words& words);
  AsfSkeleton build();
  void add_joint(int bone, int parent_joint, AsfSkeleton& out);

  TextScanner scan_;
  std::string section_;
  std::vector<AsfBone> bones_;
  std::vector<std::vector<int>> children_;
  std::vector<int> parent_;
  std::map<std::string, int, std::less<>> idx_of_;
  Vector3 direction_ = Vector3::Zero(), axis_angles_ = Vector3::Zero(), root_angles_ = Vector3::Zero();
  double length_ = 0, length_unit_ = 0;
  bool in_bone_ = false, degrees_ = true;
};

AsfSkeleton AsfReader::read() {
  if (scan_.at_end()) scan_.fail("the file is empty");
  while (!scan_.at_end()) {
    const Words words = split_words(scan_.next_line());
    if (!words.empty() && words[0][0] != '#') read_line(words);
  }
  if (in_bone_) scan_.fail("the file ends inside a bone");
  if (bones_.size() < 2) scan_.fail("the file has no :bonedata");
  return build();
}

void AsfReader::read_line(const Words& words) {
  if (words[0][0] == ':') {
    if (in_bone_) scan_.fail("a bone has no 'end'");
    section_ = std::string(words[0].substr(1));
    return;
  }
  if (section_.empty()) scan_.fail("this is not an ASF file: a line stands before the first ':section'");
  if (same_word(section_, "units")) read_unit(words);
  if (same_word(section_, "root")) read_root(words);
  if (same_word(section_, "bonedata")) read_bone(words);
  if (same_word(section_, "hierarchy")) read_hierarchy(words);
}

void AsfReader::read_unit(const Words& words) {
  if (words.size() < 2) scan_.fail("a unit has no value");
  if (same_word(words[0], "length")) length_unit_ = scan_.parse_number(words[1], "the unit of length");
  if (same_word(words[0], "angle")) {
    if (!same_word(words[1], "deg") && !same_word(words[1], "rad"))
      scan_.fail(in_quotes(words[1]) + " is no unit of angles; deg and rad are");
    degrees_ = same_word(words[1], "deg");
  }
}

void AsfReader::read_root(const Words& words) {
  if (same_word(words[0], "order"))
    for (std::size_t i = 1; i < words.size(); ++i) bones_[0].dofs.push_back(dof(words[i]));
  if (same_word(words[0], "axis") && words.size() > 1) read_axis_order(words[1], bones_[0]);
  if (same_word(words[0], "orientation")) root_angles_ = three(words);
}

void AsfReader::read_bone(const Words& words) {
  if (same_word(words[0], "begin")) {
    if (in_bone_) scan_.fail("a bone has no 'end'");
    if (bones_.size() == kMaxBones) scan_.fail("there are more than 10,000 bones");
    in_bone_ = true;
    bones_.emplace_back();
    direction_.setZero(), axis_angles_.setZero(), length_ = 0;
    return;
  }
  if (!in_bone_) scan_.fail("expected 'begin', found " + in_quotes(words[0]));
  if (same_word(words[0], "end")) return finish_bone();
  AsfBone& bone = bones_.back();
  if (same_word(words[0], "name") && words.size() > 1) bone.name = std::string(words[1]);
  if (same_word(words[0], "direction")) direction_ = three(words);
  if (same_word(words[0], "length") && words.size() > 1) length_ = scan_.parse_number(words[1], "the length");
  if (same_word(words[0], "axis")) {
    axis_angles_ = three(words);
    if (words.size() > 4) read_axis_order(words[4], bone);
  }
  if (!same_word(words[0], "dof")) return;
  for (std::size_t i = 1; i < words.size(); ++i) {
    bone.dofs.push_back(dof(words[i]));
    if (!bone.dofs.back().rotation)
      throw UnsupportedFile(scan_.file() + ":" + std::to_string(scan_.line()) + ": bone " + in_quotes(bone.name) +
                            " slides; motex reads bones that turn");
  }
}

void AsfReader::finish_bone() {
  AsfBone& bone = bones_.back();
  in_bone_ = false;
  if (bone.name.empty()) scan_.fail("the bone has no name");
  if (!idx_of_.emplace(bone.name, static_cast<int>(bones_.size()) - 1).second)
    scan_.fail("two bones are named " + in_quotes(bone.name));
  const double size = direction_.norm();
  if (size > 0) bone.end = direction_ / size * length_;
  bone.axis = quat_from_axis_order(bone.axis_order, axis_angles_ * (degrees_ ? std::numbers::pi / 180 : 1));
}

void AsfReader::read_axis_order(std::string_view text, AsfBone& bone) {
  bool used[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = text.size() == 3 ? (text[i] | 0x20) - 'x' : -1;
    if (axis < 0 || axis > 2 || used[axis]) scan_.fail(in_quotes(text) + " is no order of axes, such as XYZ");
    used[axis] = true;
    bone.axis_order[i] = axis;
  }
}

AsfDof AsfReader::dof(std::string_view word) {
  const int axis = word.size() == 2 ? (word[1] | 0x20) - 'x' : -1;
  const char kind = axis >= 0 && axis <= 2 ? static_cast<char>(word[0] | 0x20) : ' ';
  if (same_word(word, "l")) throw UnsupportedFile(scan_.file() + ": a bone stretches; motex reads bones that turn");
  if (kind != 'r' && kind != 't') scan_.fail(in_quotes(word) + " is no degree of freedom; rx … rz, tx … tz are");
  return {kind == 'r', axis};
}

Vector3 AsfReader::three(const Words& words) {
  if (words.size() < 4) scan_.fail(in_quotes(words[0]) + " needs three numbers");
  Vector3 v;
  for (int i = 0; i < 3; ++i) v[i] = scan_.parse_number(words[static_cast<std::size_t>(i) + 1], "a number");
  return v;
}

void AsfReader::read_hierarchy(const Words& words) {
  if (same_word(words[0], "begin") || same_word(words[0], "end")) return;
  children_.resize(bones_.size());
  parent_.resize(bones_.size(), -1);
  const auto find = [&](std::string_view name) {
    const auto found = idx_of_.find(name);
    if (found == idx_of_.end()) scan_.fail("there is no bone " + in_quotes(name));
    return found->second;
  };
  const int parent = find(words[0]);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const int child = find(words[i]);
    if (child == 0 || parent_[static_cast<std::size_t>(child)] >= 0)
      scan_.fail("bone " + in_quotes(words[i]) + " has two parents");
    parent_[static_cast<std::size_t>(child)] = parent;
    children_[static_cast<std::size_t>(parent)].push_back(child);
  }
}

void AsfReader::add_joint(int bone, int parent_joint, AsfSkeleton& out) {
  const AsfBone& from = bones_[static_cast<std::size_t>(bone)];
  Joint joint;
  joint.name = from.name;
  joint.parent_idx = parent_joint;
  if (parent_joint >= 0) joint.offset = out.bones[static_cast<std::size_t>(parent_joint)].end;
  if (bone == 0) joint.channels = {Channel::kXPosition, Channel::kYPosition, Channel::kZPosition};
  if (bone == 0 || !from.dofs.empty())
    for (int i = 2; i >= 0; --i)
      joint.channels.push_back(static_cast<Channel>(static_cast<int>(Channel::kXRotation) + from.axis_order[i]));
  if (children_[static_cast<std::size_t>(bone)].empty())
    out.skeleton.end_sites.push_back({out.skeleton.num_joints(), from.end});
  out.skeleton.joints.push_back(std::move(joint));
  out.bones.push_back(from);
}

AsfSkeleton AsfReader::build() {
  if (children_.empty()) scan_.fail("the file has no :hierarchy");
  bones_[0].axis = quat_from_axis_order(bones_[0].axis_order, root_angles_ * (degrees_ ? std::numbers::pi / 180 : 1));
  children_.resize(bones_.size());
  AsfSkeleton out;
  out.degrees = degrees_;
  if (length_unit_ > 0 && length_unit_ != 1) out.skeleton.metres_per_unit = kMetresPerInch / length_unit_;
  std::vector<std::pair<int, int>> open{{0, -1}};  // bone, joint above
  while (!open.empty()) {
    const auto [bone, parent] = open.back();
    open.pop_back();
    const int joint = out.skeleton.num_joints();
    add_joint(bone, parent, out);
    const auto& below = children_[static_cast<std::size_t>(bone)];
    for (auto child = below.rbegin(); child != below.rend(); ++child) open.emplace_back(*child, joint);
  }
  if (out.bones.size() != bones_.size()) scan_.fail("a bone does not hang from the root by :hierarchy");
  return out;
}

}  // namespace

Quat quat_from_axis_order(const int (&order)[3], const Vector3& angles_xyz) {
  const Vector3 angles(angles_xyz[order[2]], angles_xyz[order[1]], angles_xyz[order[0]]);
  return quat_from_euler({{order[2], order[1], order[0]}}, angles);
}

AsfSkeleton read_asf_bytes(std::string_view bytes, const std::string& name) { return AsfReader(bytes, name).read(); }

}  // namespace motex
