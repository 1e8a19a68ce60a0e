// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/figure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "motex/core/lowered.h"

namespace motex {
namespace {

// Radii as shares of the standing height.
constexpr double kHeadRadius = 0.057, kNeckRadius = 0.026, kShoulderRadius = 0.034, kWaistRadius = 0.062,
                 kHipRadius = 0.052, kUpperArmRadius = 0.029, kElbowRadius = 0.022, kWristRadius = 0.016,
                 kThighRadius = 0.050, kKneeRadius = 0.033, kAnkleRadius = 0.022, kToeRadius = 0.017,
                 kHandTipRadius = 0.013, kFingerRadius = 0.007, kPlainRadius = 0.016;

bool names_one_of(const std::string& name, std::initializer_list<const char*> words) {
  const std::string text = lowered(name);
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return text.find(w) != std::string::npos; });
}

Side side_of_letter(char c) {
  return c == 'l' || c == 'L' ? Side::kLeft : c == 'r' || c == 'R' ? Side::kRight : Side::kMiddle;
}

bool is_separator(char c) { return c == '_' || c == '.' || c == '-' || c == ' '; }

const Joint& joint_at(const Skeleton& skeleton, int idx) { return skeleton.joints[static_cast<std::size_t>(idx)]; }

int ancestor(const Skeleton& skeleton, int idx, int generations) {
  for (; generations > 0 && idx >= 0; --generations) idx = joint_at(skeleton, idx).parent_idx;
  return idx;
}

/// More than one where several bodies are shown: they are drawn as bones alone.
std::ptrdiff_t num_roots(const Skeleton& skeleton) {
  return std::count_if(skeleton.joints.begin(), skeleton.joints.end(),
                       [](const Joint& joint) { return joint.parent_idx < 0; });
}

std::vector<Side> sides_of(const Skeleton& skeleton) {
  std::vector<Side> sides;
  for (const Joint& joint : skeleton.joints) {
    Side side = side_of_name(joint.name);
    if (side == Side::kMiddle && joint.parent_idx >= 0) side = sides[static_cast<std::size_t>(joint.parent_idx)];
    sides.push_back(side);
  }
  return sides;
}

/// The joint or end site at the end of the first bone below `joint`, or −1.
int first_point_below(const Skeleton& skeleton, int joint) {
  for (int j = joint + 1; j < skeleton.num_joints(); ++j)
    if (joint_at(skeleton, j).parent_idx == joint) return j;
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e)
    if (skeleton.end_sites[e].parent_idx == joint) return skeleton.num_joints() + static_cast<int>(e);
  return -1;
}

Vector3 offset_of(const Skeleton& skeleton, int point) {
  const int joints = skeleton.num_joints();
  return point < joints ? joint_at(skeleton, point).offset
                        : skeleton.end_sites[static_cast<std::size_t>(point - joints)].offset;
}

void find_limbs(const Skeleton& skeleton, const std::vector<Side>& sides, Figure& figure) {
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    const Joint& joint = joint_at(skeleton, j);
    const Side side = sides[static_cast<std::size_t>(j)];
    if (figure.head_idx < 0 && side == Side::kMiddle && names_one_of(joint.name, {"head"})) figure.head_idx = j;
    if (side == Side::kMiddle || ancestor(skeleton, j, 3) < 0) continue;
    const std::size_t s = side == Side::kLeft ? 0 : 1;
    const bool is_hand = names_one_of(joint.name, {"hand", "wrist"}),
               is_foot = names_one_of(joint.name, {"foot", "ankle"});
    if (is_hand && figure.hands[s] < 0) figure.hands[s] = j, figure.shoulders[s] = ancestor(skeleton, j, 2);
    if (is_foot && figure.feet[s] < 0) figure.feet[s] = j, figure.hips[s] = ancestor(skeleton, j, 2);
  }
}

void find_head_centre(const Skeleton& skeleton, Figure& figure) {
  if (figure.head_idx < 0) return;
  figure.head_tip_idx = first_point_below(skeleton, figure.head_idx);
  const double length = figure.head_tip_idx < 0 ? 0 : offset_of(skeleton, figure.head_tip_idx).norm();
  if (length > 0)
    figure.head_place = std::min(0.05 * figure.height / length, 3.0);
  else
    figure.head_tip_idx = figure.head_idx;
  ++figure.num_points;
}

bool is_below(const Skeleton& skeleton, int joint, int above) {
  while (joint > above) joint = joint_at(skeleton, joint).parent_idx;
  return joint == above && above >= 0;
}

/// Thickness of the bone from joint `parent` to a point, as shares of the height at both ends.
struct Thickness {
  double at_parent = kPlainRadius, at_point = kPlainRadius;
};

Thickness bone_thickness(const Skeleton& skeleton, const Figure& figure, int parent) {
  for (std::size_t s = 0; s < 2; ++s) {
    const int hand = figure.hands[s], foot = figure.feet[s];
    if (hand >= 0) {
      if (parent == figure.shoulders[s]) return {kUpperArmRadius, kElbowRadius};
      if (parent == ancestor(skeleton, hand, 1)) return {kElbowRadius, kWristRadius};
      if (parent == hand) return {kWristRadius, kHandTipRadius};
      if (is_below(skeleton, parent, hand)) return {kFingerRadius, kFingerRadius};
    }
    if (foot >= 0) {
      if (parent == figure.hips[s]) return {kThighRadius, kKneeRadius};
      if (parent == ancestor(skeleton, foot, 1)) return {kKneeRadius, kAnkleRadius};
      if (parent == foot) return {kAnkleRadius, kToeRadius};
      if (is_below(skeleton, parent, foot)) return {kToeRadius, kToeRadius};
    }
  }
  if (figure.head_idx >= 0 && is_below(skeleton, figure.head_idx, parent)) return {kNeckRadius, kNeckRadius};
  return {};
}

bool has_trunk(const Figure& figure) {
  return figure.shoulders[0] >= 0 && figure.shoulders[1] >= 0 && figure.hips[0] >= 0 && figure.hips[1] >= 0;
}

/// Rest position of a joint.
Vector3 rest_position(const Skeleton& skeleton, int joint) {
  Vector3 sum = Vector3::Zero();
  for (; joint >= 0 && joint_at(skeleton, joint).parent_idx >= 0; joint = joint_at(skeleton, joint).parent_idx)
    sum += joint_at(skeleton, joint).offset;
  return sum;
}

/// The joint of the spine that lies nearest to the middle between hips and shoulders.
int find_waist(const Skeleton& skeleton, const Figure& figure) {
  const auto rest = [&](const std::array<int, 2>& pair) {
    return Vector3((rest_position(skeleton, pair[0]) + rest_position(skeleton, pair[1])) / 2);
  };
  const Vector3 middle = 0.6 * rest(figure.hips) + 0.4 * rest(figure.shoulders);
  int best = -1;
  double best_distance = 0;
  for (int j = ancestor(skeleton, figure.shoulders[0], 1); j >= 0; j = ancestor(skeleton, j, 1)) {
    const double distance = (rest_position(skeleton, j) - middle).norm();
    if (best < 0 || distance < best_distance) best = j, best_distance = distance;
  }
  return best;
}

/// The first joint of the way to the head that is not on the way to the shoulders, or −1.
int find_neck(const Skeleton& skeleton, const Figure& figure) {
  int neck = -1;
  for (int j = figure.head_idx; j >= 0 && !is_below(skeleton, figure.shoulders[0], j); j = ancestor(skeleton, j, 1))
    neck = j;
  return neck;
}

/// True when the bone to this point lies inside the trunk's hulls.
bool inside_trunk(const Skeleton& skeleton, const Figure& figure, int joint) {
  if (joint == find_neck(skeleton, figure)) return true;
  for (std::size_t s = 0; s < 2; ++s)
    if (is_below(skeleton, figure.shoulders[s], joint) || is_below(skeleton, figure.hips[s], joint)) return true;
  return false;
}

void add_trunk(const Skeleton& skeleton, Figure& figure) {
  const double h = figure.height;
  const int waist = find_waist(skeleton, figure);
  const auto [left_shoulder, right_shoulder] = figure.shoulders;
  const auto [left_hip, right_hip] = figure.hips;
  figure.parts.push_back(
      {{{left_hip, kHipRadius * h}, {right_hip, kHipRadius * h}, {waist, kWaistRadius * h}}, Side::kMiddle});
  BodyPart chest{
      {{left_shoulder, kShoulderRadius * h}, {right_shoulder, kShoulderRadius * h}, {waist, kWaistRadius * h}},
      Side::kMiddle};
  if (const int neck = find_neck(skeleton, figure); neck >= 0) chest.balls.push_back({neck, kNeckRadius * h});
  figure.parts.push_back(std::move(chest));
}

void add_bones(const Skeleton& skeleton, const std::vector<Side>& sides, Figure& figure) {
  const int joints = skeleton.num_joints(), points = joints + static_cast<int>(skeleton.end_sites.size());
  const bool trunk = has_trunk(figure);
  for (int p = 0; p < points; ++p) {
    const int parent = p < joints ? joint_at(skeleton, p).parent_idx
                                  : skeleton.end_sites[static_cast<std::size_t>(p - joints)].parent_idx;
    if (parent < 0 || (figure.head_idx >= 0 && is_below(skeleton, parent, figure.head_idx))) continue;
    if (trunk && p < joints && inside_trunk(skeleton, figure, p)) continue;
    const Thickness thickness = bone_thickness(skeleton, figure, parent);
    const Side side = sides[static_cast<std::size_t>(parent)];
    figure.parts.push_back(
        {{{parent, thickness.at_parent * figure.height}, {p, thickness.at_point * figure.height}}, side});
  }
}

}  // namespace

Side side_of_name(const std::string& full_name) {
  const std::string name = full_name.substr(full_name.find_last_of(':') + 1), text = lowered(name);
  if (text.find("left") != std::string::npos) return Side::kLeft;
  if (text.find("right") != std::string::npos) return Side::kRight;
  const std::size_t n = name.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool starts = i == 0 || is_separator(name[i - 1]), ends = i + 1 == n || is_separator(name[i + 1]);
    const bool camel = i == 0 && n > 1 && std::isupper(static_cast<unsigned char>(name[1])) != 0;
    if (starts && (ends || camel) && side_of_letter(name[i]) != Side::kMiddle) return side_of_letter(name[i]);
  }
  return Side::kMiddle;
}

Figure make_figure(const Skeleton& skeleton) {
  Figure figure;
  figure.height = 1.7 / metres_per_unit_or_guess(skeleton);
  figure.num_points = skeleton.num_joints() + static_cast<Index>(skeleton.end_sites.size());
  const std::vector<Side> sides = sides_of(skeleton);
  if (num_roots(skeleton) == 1) find_limbs(skeleton, sides, figure);
  find_head_centre(skeleton, figure);
  if (has_trunk(figure)) add_trunk(skeleton, figure);
  add_bones(skeleton, sides, figure);
  if (figure.head_idx >= 0) {
    const int centre = static_cast<int>(figure.num_points) - 1;
    figure.parts.push_back(
        {{{centre, kHeadRadius * figure.height}, {figure.head_idx, 0.8 * kHeadRadius * figure.height}}, Side::kMiddle});
  }
  return figure;
}

FrameMatrix figure_points(const Figure& figure, const Clip& clip) {
  FrameMatrix points = world_positions(clip);
  if (figure.head_idx < 0) return points;
  points.conservativeResize(Eigen::NoChange, 3 * figure.num_points);
  const auto head = points.middleCols<3>(3 * figure.head_idx), tip = points.middleCols<3>(3 * figure.head_tip_idx);
  points.rightCols<3>() = head + figure.head_place * (tip - head);
  return points;
}

FigureMotion figure_motion(const Clip& clip) {
  FigureMotion motion{clip.name, clip.frame_time_secs, make_figure(clip.skeleton), {}};
  motion.points = figure_points(motion.figure, clip);
  return motion;
}

Vector3 facing(const Figure& figure, const FrameMatrix& points, Index frame) {
  const auto& pair = figure.hips[0] >= 0 && figure.hips[1] >= 0 ? figure.hips : figure.shoulders;
  if (pair[0] < 0 || pair[1] < 0) return Vector3::UnitZ();
  const Vector3 left = (points.block<1, 3>(frame, 3 * pair[0]) - points.block<1, 3>(frame, 3 * pair[1])).transpose();
  Vector3 ahead = left.cross(Vector3::UnitY());
  ahead.y() = 0;
  return ahead.norm() > 1e-9 * figure.height ? ahead.normalized() : Vector3::UnitZ();
}

double floor_height(const FrameMatrix& points) {
  if (points.size() == 0) return 0;
  std::vector<double> lowest;
  for (Index t = 0; t < points.rows(); ++t) {
    double low = std::numeric_limits<double>::infinity();
    for (Index c = 1; c < points.cols(); c += 3)
      if (points(t, c) < low) low = points(t, c);
    if (std::isfinite(low)) lowest.push_back(low);
  }
  if (lowest.empty()) return 0;
  const auto at = lowest.begin() + static_cast<std::ptrdiff_t>(lowest.size() / 50);
  std::nth_element(lowest.begin(), at, lowest.end());
  return *at;
}

}  // namespace motex
