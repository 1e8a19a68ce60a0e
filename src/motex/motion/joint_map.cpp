// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/joint_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>

#include "motex/core/error.h"

namespace motex {
namespace {

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool all_digits(const std::string& word) { return std::all_of(word.begin(), word.end(), is_digit); }

/// Without "mixamorig:" and the like.
std::string_view without_prefix(std::string_view name) {
  const std::size_t cut = name.find_last_of(":|");
  return cut == name.npos ? name : name.substr(cut + 1);
}

/// "Bip01 LUpperArm_7" → bip01, l, upper, arm, 7.
std::vector<std::string> split_words(std::string_view name) {
  std::vector<std::string> words{""};
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool letter = is_upper(c) || is_lower(c);
    if (!letter && !is_digit(c)) {
      words.emplace_back();
      continue;
    }
    const bool after_lower = i > 0 && !is_upper(name[i - 1]);
    const bool before_lower = i + 1 < name.size() && is_lower(name[i + 1]) && i > 0 && is_upper(name[i - 1]);
    if (is_upper(c) && (after_lower || before_lower)) words.emplace_back();
    words.back() += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  std::erase(words, "");
  return words;
}

/// Words that only say which program made the rig.
bool says_nothing(const std::string& word) {
  static constexpr std::array kWords{"j", "c", "b", "bn", "jnt", "def", "org", "rig", "bind", "valvebiped", "joint"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end() || word.starts_with("mixamorig") ||
         word.starts_with("character") || (word.starts_with("bip") && (word.size() == 3 || all_digits(word.substr(3))));
}

struct Part {
  std::string_view stem;
  std::string_view part;
};
// "?": the part depends on what else there is.
constexpr Part kSided[] = {
    {"collar", "collar"},
    {"clavicle", "collar"},
    {"shoulder", "shoulder?"},
    {"arm", "arm"},
    {"upperarm", "arm"},
    {"uparm", "arm"},
    {"shldr", "arm"},
    {"shldrbend", "arm"},
    {"humerus", "arm"},
    {"forearm", "forearm"},
    {"lowerarm", "forearm"},
    {"lowarm", "forearm"},
    {"elbow", "forearm"},
    {"forearmbend", "forearm"},
    {"radius", "forearm"},
    {"hand", "hand"},
    {"wrist", "hand"},
    {"upleg", "thigh"},
    {"upperleg", "thigh"},
    {"thigh", "thigh"},
    {"thighbend", "thigh"},
    {"femur", "thigh"},
    {"hip", "hip?"},
    {"leg", "leg?"},
    {"lowerleg", "shin"},
    {"lowleg", "shin"},
    {"shin", "shin"},
    {"calf", "shin"},
    {"knee", "shin"},
    {"tibia", "shin"},
    {"foot", "foot"},
    {"ankle", "foot"},
    {"toe", "toe"},
    {"toes", "toe"},
    {"toebase", "toe"},
    {"toe0", "toe"},
    {"ball", "toe"},
    {"forefoot", "toe"},
    {"buttock", "buttock"},
    {"hipjoint", "buttock"},
    {"eye", "eye"},
    {"upperarmtwist", ""},
    {"forearmtwist", ""},
    {"thighbone", "thigh"},
    {"upperlegbone", "thigh"},
    {"metatarsals", "ball?"},
};
constexpr Part kMiddle[] = {{"hips", "pelvis"}, {"hip", "pelvis"}, {"pelvis", "pelvis"}, {"head", "head"}};
constexpr std::string_view kSpineStems[] = {"spine",  "abdomen",    "chest", "lowerback", "upperback",
                                            "thorax", "upperchest", "torso", "waist"};

/// "handindex1", "index01", "mid2", "thumbproximal" → "index 1" …
std::string finger_of(std::string stem) {
  for (const std::string_view word : {"inhand", "hand"})
    if (stem.starts_with(word)) stem.erase(0, word.size());
  static constexpr std::pair<std::string_view, std::string_view> kFingers[] = {
      {"thumb", "thumb"}, {"index", "index"}, {"middle", "middle"}, {"mid", "middle"},
      {"ring", "ring"},   {"pinky", "pinky"}, {"little", "pinky"}};
  for (const auto& [word, finger] : kFingers) {
    if (!stem.starts_with(word)) continue;
    std::string rest = stem.substr(word.size());
    if (rest == "proximal") rest = "1";
    if (rest == "intermediate") rest = "2";
    if (rest == "distal") rest = "3";
    while (rest.size() > 1 && rest[0] == '0') rest.erase(0, 1);
    if (rest.size() == 1 && is_digit(rest[0])) return std::string(finger) + " " + rest;
  }
  return "";
}

std::string sided_part(const std::string& stem) {
  for (const Part& p : kSided)
    if (p.stem == stem) return std::string(p.part);
  return finger_of(stem);
}

std::string middle_part(const std::string& stem) {
  for (const Part& p : kMiddle)
    if (p.stem == stem) return std::string(p.part);
  if (stem.starts_with("neck") || stem == "lowerneck" || stem == "upperneck") return "neck";
  for (const std::string_view s : kSpineStems)
    if (stem.starts_with(s)) return "spine";
  return "";
}

/// The part, with "left " or "right " before it where it has a side; ambiguous ones end with "?".
std::string part_of_name(const std::string& name) {
  std::string side, stem;
  for (const std::string& word : split_words(without_prefix(name))) {
    if (word == "l" || word == "left")
      side = "left ";
    else if (word == "r" || word == "right")
      side = "right ";
    else if (!says_nothing(word) && !(all_digits(word) && word.size() > 2))  // "_176" is an exporter's count
      stem += word;
  }
  if (side.empty())
    for (const auto& [word, of] : {std::pair{"left", "left "}, {"right", "right "}, {"l", "left "}, {"r", "right "}})
      if (stem.starts_with(word) && middle_part(stem).empty() && !sided_part(stem.substr(std::strlen(word))).empty()) {
        side = of;
        stem.erase(0, std::strlen(word));
        break;
      }
  const std::string part = side.empty() ? middle_part(stem) : sided_part(stem);
  return part.empty() ? "" : side + part;
}

/// Names that mean different parts in different rigs.
void settle_ambiguous(std::vector<std::string>& parts) {
  for (const std::string side : {"left ", "right "}) {
    const auto has = [&](const char* part) {
      return std::find(parts.begin(), parts.end(), side + part) != parts.end();
    };
    const auto rename = [&](const char* from, const char* to) {
      for (std::string& part : parts)
        if (part == side + from) part = side + to;
    };
    // Mixamo: Shoulder, Arm. Others: Collar, Shoulder, Elbow; or Shoulder, Elbow.
    const bool shoulder_is_collar = has("arm");
    rename("shoulder?", shoulder_is_collar ? "collar" : "arm");
    // Mixamo: UpLeg, Leg. Others: Hip, Knee; or Leg alone.
    rename("hip?", has("thigh") ? "buttock" : "thigh");
    rename("leg?", has("thigh") ? "shin" : "thigh");
    rename("ball?", "");
  }
}

/// Joint of a part, or −1.
int find_part(const std::vector<std::string>& parts, const std::string& part) {
  const auto found = std::find(parts.begin(), parts.end(), part);
  return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
}

bool is_above(const Skeleton& skeleton, int above, int joint) {
  for (int j = joint; j >= 0; j = skeleton.joints[at(j)].parent_idx)
    if (j == above) return true;
  return false;
}

/// The lowest joint above all of those that exist (≥ 0); −1 when none does.
int lowest_above(const Skeleton& skeleton, const std::vector<int>& below) {
  int joint = -1;
  for (const int b : below)
    if (b >= 0) joint = joint < 0 ? skeleton.joints[at(b)].parent_idx : joint;
  const auto above_all = [&](int j) {
    return std::all_of(below.begin(), below.end(),
                       [&](int b) { return b < 0 || (b != j && is_above(skeleton, j, b)); });
  };
  while (joint >= 0 && !above_all(joint)) joint = skeleton.joints[at(joint)].parent_idx;
  return joint;
}

/// Where the legs meet the body, whatever it is called.
void settle_pelvis(const Skeleton& skeleton, std::vector<std::string>& parts) {
  const int left = find_part(parts, "left thigh"), right = find_part(parts, "right thigh");
  std::vector<int> below{left, right};
  for (const char* upper : {"neck", "head", "left arm", "right arm"}) below.push_back(find_part(parts, upper));
  int pelvis = left >= 0 && right >= 0 ? lowest_above(skeleton, below) : find_part(parts, "pelvis");
  if (pelvis < 0) pelvis = find_part(parts, "pelvis");
  for (std::string& part : parts)
    if (part == "pelvis") part.clear();
  if (pelvis >= 0) parts[at(pelvis)] = "pelvis";
}

/// From the pelvis, left out, up to where the arms and the neck begin; without the neck.
std::vector<int> spine_chain(const Skeleton& skeleton, const std::vector<std::string>& parts) {
  const int pelvis = find_part(parts, "pelvis");
  std::vector<int> below;
  for (const char* upper : {"neck", "head", "left collar", "right collar", "left arm", "right arm"})
    below.push_back(find_part(parts, upper));
  std::vector<int> chain;
  for (int j = lowest_above(skeleton, below); j >= 0 && j != pelvis; j = skeleton.joints[at(j)].parent_idx)
    chain.insert(chain.begin(), j);
  if (pelvis < 0 || (!chain.empty() && skeleton.joints[at(chain[0])].parent_idx != pelvis)) return {};
  const auto neck = std::find_if(chain.begin(), chain.end(), [&](int j) { return parts[at(j)] == "neck"; });
  chain.erase(neck, chain.end());
  return chain;
}

std::vector<int> joints_of_part(const std::vector<std::string>& parts, const std::string& part) {
  std::vector<int> out;
  for (int j = 0; j < static_cast<int>(parts.size()); ++j)
    if (parts[at(j)] == part) out.push_back(j);
  return out;
}

/// First to first, last to last, the others in proportion; a single joint goes with the last.
void match_chains(const std::vector<int>& source, const std::vector<int>& target, JointMap& map) {
  if (source.empty() || target.empty()) return;
  const std::size_t count = std::min(source.size(), target.size());
  const auto pick = [&](const std::vector<int>& chain, std::size_t k) {
    if (count == 1) return chain.back();
    const double place = static_cast<double>(k * (chain.size() - 1)) / static_cast<double>(count - 1);
    return chain[static_cast<std::size_t>(std::lround(place))];
  };
  for (std::size_t k = 0; k < count; ++k) map.source_of[at(pick(target, k))] = pick(source, k);
}

std::string plain_name(const std::string& name) {
  std::string out;
  for (const std::string& word : split_words(without_prefix(name))) out += word;
  return out;
}

}  // namespace

int JointMap::num_matched() const {
  return static_cast<int>(std::count_if(source_of.begin(), source_of.end(), [](int s) { return s >= 0; }));
}

int JointMap::target_of(int source) const {
  const auto found = std::find(source_of.begin(), source_of.end(), source);
  return source < 0 || found == source_of.end() ? -1 : static_cast<int>(found - source_of.begin());
}

std::vector<std::string> body_parts(const Skeleton& skeleton) {
  std::vector<std::string> parts;
  for (const Joint& joint : skeleton.joints) parts.push_back(part_of_name(joint.name));
  settle_ambiguous(parts);
  settle_pelvis(skeleton, parts);
  std::map<std::string, int> seen;
  for (std::string& part : parts)
    if (!part.empty() && part != "spine" && part != "neck" && seen[part]++ > 0) part.clear();
  return parts;
}

JointMap match_joints(const Skeleton& source, const Skeleton& target) {
  const std::vector<std::string> source_parts = body_parts(source), target_parts = body_parts(target);
  JointMap map;
  map.source_of.assign(target.joints.size(), -1);
  std::map<std::string, int> of_part, of_name;
  for (int s = 0; s < source.num_joints(); ++s) {
    of_part.emplace(source_parts[at(s)], s);
    of_name.emplace(plain_name(source.joints[at(s)].name), s);
  }
  for (int t = 0; t < target.num_joints(); ++t) {
    const std::string& part = target_parts[at(t)];
    if (part.empty() || part == "spine" || part == "neck") continue;
    if (const auto found = of_part.find(part); found != of_part.end()) map.source_of[at(t)] = found->second;
  }
  match_chains(spine_chain(source, source_parts), spine_chain(target, target_parts), map);
  match_chains(joints_of_part(source_parts, "neck"), joints_of_part(target_parts, "neck"), map);
  for (int t = 0; t < target.num_joints(); ++t) {
    if (map.source_of[at(t)] >= 0) continue;
    const auto found = of_name.find(plain_name(target.joints[at(t)].name));
    const bool free = found != of_name.end() && !found->first.empty() && map.target_of(found->second) < 0;
    if (free && source_parts[at(found->second)].empty() && target_parts[at(t)].empty())
      map.source_of[at(t)] = found->second;
  }
  return map;
}

JointMap joint_map_by_names(const Skeleton& source, const Skeleton& target,
                            std::span<const std::pair<std::string, std::string>> target_and_source) {
  JointMap map;
  map.source_of.assign(target.joints.size(), -1);
  for (const auto& [target_name, source_name] : target_and_source) {
    const int t = target.find(target_name), s = source.find(source_name);
    if (t < 0) throw InvalidInput("the skeleton to go to has no joint '" + target_name + "'");
    if (s < 0) throw InvalidInput("the clip's skeleton has no joint '" + source_name + "'");
    if (map.source_of[at(t)] >= 0) throw InvalidInput("joint '" + target_name + "' is mapped twice");
    map.source_of[at(t)] = s;
  }
  return map;
}

}  // namespace motex
