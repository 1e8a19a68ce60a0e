// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/features.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Index kRootChannels = 6;
constexpr double kVelocitySecs = 4.0 / 60;  // a step counts as far as it leads in this time
constexpr double kMostTurn = 1.5 * kPi;
constexpr double kStillUnits = 1e-3;  // cm: translations and
constexpr double kStillAngle = 1e-6;  // radians: rotations that vary less are held

double wrap_angle(double angle) { return angle - 2 * kPi * std::round(angle / (2 * kPi)); }

/// ψ of q = R_y(ψ) · exp(t_x, 0, t_z); false where the body is so far upside down that it has none.
bool heading_of(const Quat& q, double& heading) {
  if (q.w() * q.w() + q.y() * q.y() < 1e-6) return false;
  heading = 2 * std::atan2(q.y(), q.w());
  return true;
}

Quat heading_rotation(double heading) { return {std::cos(heading / 2), 0, std::sin(heading / 2), 0}; }

double spread(const Clip& clip, int joint) {
  const auto t = clip.translations.middleCols<3>(3 * joint);
  return (t.colwise().maxCoeff() - t.colwise().minCoeff()).norm();
}

/// The first joint, root first, whose translation varies in any clip; joint 0 when none does.
int find_travelling_joint(std::span<const Clip> clips, double still) {
  for (int j = 0; j < clips[0].skeleton.num_joints(); ++j)
    for (const Clip& clip : clips)
      if (clip.num_frames() > 0 && spread(clip, j) > still) return j;
  return 0;
}

/// World pose of the joint above the travelling one, held at its mean.
struct Above {
  Vector3 position = Vector3::Zero();
  Quat rotation = Quat::Identity();
};
Above above_travelling_joint(const FeatureSpace& space) {
  std::vector<int> chain;
  const auto& joints = space.skeleton.joints;
  for (int j = joints[static_cast<std::size_t>(space.travelling_joint)].parent_idx; j >= 0;
       j = joints[static_cast<std::size_t>(j)].parent_idx)
    chain.push_back(j);
  Above above;
  for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
    above.position += above.rotation * Vector3(space.held.row(*it).transpose());
    const auto q = space.references.row(*it);
    above.rotation = above.rotation * Quat(q[0], q[1], q[2], q[3]);
  }
  return above;
}

Quat reference(const FeatureSpace& space, int joint) {
  const auto q = space.references.row(joint);
  return {q[0], q[1], q[2], q[3]};
}

bool is_above(const Skeleton& skeleton, int upper, int lower) {
  for (int j = lower; j >= 0; j = skeleton.joints[static_cast<std::size_t>(j)].parent_idx)
    if (j == upper) return true;
  return false;
}

/// Mean rotations of all clips; returns the largest angle from it for each joint.
Vector find_references(std::span<const Clip> clips, FeatureSpace& space) {
  const int joints = space.skeleton.num_joints();
  space.references.resize(joints, 4);
  Vector largest = Vector::Zero(joints);
  for (int j = 0; j < joints; ++j) {
    FrameMatrix moment = FrameMatrix::Zero(4, 4);
    for (const Clip& clip : clips) {
      const auto q = clip.rotations.middleCols<4>(4 * j);
      moment += q.transpose() * q;
    }
    // mean_rotation() wants quaternions; those whose second moment is `moment` serve: rows of its Cholesky factor.
    const Eigen::Matrix4d lower =
        Eigen::Matrix4d(moment + FrameMatrix::Identity(4, 4) * 1e-12 * moment.trace()).llt().matrixL();
    const Quat mean = mean_rotation(FrameMatrix(lower.transpose()));
    space.references.row(j) << mean.w(), mean.x(), mean.y(), mean.z();
    for (const Clip& clip : clips)
      for (Index t = 0; t < clip.num_frames(); ++t)
        largest[j] = std::max(largest[j], angle_between(mean, clip.rotation(t, j)));
  }
  return largest;
}

void find_held_translations(std::span<const Clip> clips, FeatureSpace& space, double still, const JobContext& job) {
  const int joints = space.skeleton.num_joints();
  space.held.setZero(joints, 3);
  Index total = 0;
  std::string moving;
  for (const Clip& clip : clips) total += clip.num_frames();
  for (int j = 0; j < joints; ++j) {
    for (const Clip& clip : clips) space.held.row(j) += clip.translations.middleCols<3>(3 * j).colwise().sum();
    space.held.row(j) /= static_cast<double>(total);
    const bool moves = std::any_of(clips.begin(), clips.end(), [&](const Clip& c) { return spread(c, j) > still; });
    if (moves && j != space.travelling_joint)
      moving += (moving.empty() ? "'" : ", '") + space.skeleton.joints[static_cast<std::size_t>(j)].name + "'";
  }
  if (!moving.empty()) job.warn("translations of " + moving + " move in their parents; they are held at their mean");
}

/// √(mean of ⅔ · distance²) over the points below a joint in the mean pose, cm per radian, at least 1.
double lever(const FeatureSpace& space, int joint, const std::vector<Vector3>& points, const std::vector<int>& owner,
             const std::vector<Vector3>& positions) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_above(space.skeleton, joint, owner[i])) continue;
    const double distance = (points[i] - positions[static_cast<std::size_t>(joint)]).norm() * space.cm_per_unit;
    if (distance == 0) continue;
    sum += 2.0 / 3 * distance * distance;
    ++count;
  }
  return count > 0 ? std::max(1.0, std::sqrt(sum / count)) : 1.0;
}

void find_weights(FeatureSpace& space) {
  const auto& joints = space.skeleton.joints;
  std::vector<Vector3> positions(joints.size());
  std::vector<Quat> rotations(joints.size());
  std::vector<Vector3> points;
  std::vector<int> owner;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const int p = joints[j].parent_idx;
    const Vector3 held = space.held.row(static_cast<Index>(j)).transpose();
    const Quat up = p < 0 ? Quat::Identity() : rotations[static_cast<std::size_t>(p)];
    positions[j] = (p < 0 ? Vector3::Zero() : positions[static_cast<std::size_t>(p)]) + up * held;
    rotations[j] = up * reference(space, static_cast<int>(j));
    points.push_back(positions[j]);
    owner.push_back(static_cast<int>(j));
  }
  for (const EndSite& site : space.skeleton.end_sites) {
    const auto p = static_cast<std::size_t>(site.parent_idx);
    points.emplace_back(positions[p] + rotations[p] * site.offset);
    owner.push_back(site.parent_idx);
  }
  const auto lever_of = [&](int j) { return lever(space, j, points, owner, positions); };
  const double root = lever_of(space.travelling_joint), frames = kVelocitySecs / space.frame_time_secs;
  const double cm = space.cm_per_unit;
  space.weights.resize(kRootChannels + 3 * static_cast<Index>(space.joints.size()));
  space.weights.head<kRootChannels>() << cm * frames, cm * frames, cm, root * frames, root, root;
  for (std::size_t i = 0; i < space.joints.size(); ++i)
    space.weights.segment<3>(kRootChannels + 3 * static_cast<Index>(i)).setConstant(lever_of(space.joints[i]));
}

/// World position and rotation of the travelling joint.
void travelling_pose(const FeatureSpace& space, const Above& above, const Clip& clip, Index t, Vector3& position,
                     Quat& q) {
  position = above.position + above.rotation * clip.translation(t, space.travelling_joint);
  q = above.rotation * clip.rotation(t, space.travelling_joint);
}

/// Takes the step and the turn of a frame.
void move_on(const FeatureSpace& space, const double* features, RootPlace& place) {
  const double* w = space.weights.data();
  const double vx = features[0] / w[0], vz = features[1] / w[1];
  const double c = std::cos(place.heading), s = std::sin(place.heading);
  place.x += c * vx + s * vz;
  place.z += -s * vx + c * vz;
  place.heading += features[3] / w[3];
}

double mean_height(std::span<const Clip> clips, const FeatureSpace& space) {
  const Above above = above_travelling_joint(space);
  Vector3 position;
  Quat q;
  double sum = 0;
  Index count = 0;
  for (const Clip& clip : clips)
    for (Index t = 0; t < clip.num_frames(); ++t, ++count) {
      travelling_pose(space, above, clip, t, position, q);
      sum += position.y();
    }
  return sum / static_cast<double>(count);
}

}  // namespace

FeatureSpace make_feature_space(std::span<const Clip> clips, const JobContext& job) {
  if (clips.empty()) throw InvalidInput("no clip to learn from");
  for (const Clip& clip : clips) {
    check_clip(clip);
    const std::string difference = skeleton_difference(clips[0].skeleton, clip.skeleton);
    if (!difference.empty()) throw InvalidInput(clips[0].name + " and " + clip.name + ": " + difference);
    if (clip.num_frames() < 2)
      throw InvalidInput(clip.name + ": has " + std::to_string(clip.num_frames()) + " frames; motion needs at least 2");
    if (std::abs(clip.frame_time_secs / clips[0].frame_time_secs - 1) > 1e-4)
      throw InvalidInput(clips[0].name + " and " + clip.name + ": have different frame rates; resample one of them");
  }
  FeatureSpace space;
  space.skeleton = clips[0].skeleton;
  space.frame_time_secs = clips[0].frame_time_secs;
  space.cm_per_unit = 100 * metres_per_unit_or_guess(space.skeleton);
  const double still = kStillUnits / space.cm_per_unit;
  space.travelling_joint = find_travelling_joint(clips, still);
  const Vector largest = find_references(clips, space);
  find_held_translations(clips, space, still, job);
  std::string ancestors;
  for (int j = 0; j < space.skeleton.num_joints(); ++j) {
    if (j == space.travelling_joint || largest[j] < kStillAngle) continue;
    const std::string& name = space.skeleton.joints[static_cast<std::size_t>(j)].name;
    if (is_above(space.skeleton, j, space.travelling_joint)) {
      ancestors += (ancestors.empty() ? "'" : ", '") + name + "'";
      continue;
    }
    space.joints.push_back(j);
    if (largest[j] > 0.9 * kPi)
      job.warn("joint '" + name + "' turns " + std::to_string(static_cast<int>(largest[j] * 180 / kPi)) +
               "° away from its mean; near 180° its motion may be learned badly");
  }
  if (!ancestors.empty()) job.warn("rotations of " + ancestors + " above the travelling joint are held at their mean");
  find_weights(space);
  space.reference_height = mean_height(clips, space);
  return space;
}

FrameMatrix encode(const FeatureSpace& space, const Clip& clip, const JobContext& job) {
  const std::string difference = skeleton_difference(space.skeleton, clip.skeleton);
  if (!difference.empty()) throw InvalidInput(clip.name + ": the skeleton is not the model's: " + difference);
  if (std::abs(clip.frame_time_secs / space.frame_time_secs - 1) > 1e-3)
    throw InvalidInput(clip.name + ": has " + std::to_string(clip.frame_rate()) + " frames a second, the model " +
                       std::to_string(1 / space.frame_time_secs) + "; use --resample or --fps");
  const Index frames = clip.num_frames();
  if (frames < 2)
    throw InvalidInput(clip.name + ": has " + std::to_string(frames) + " frames; motion needs at least 2");
  FrameMatrix y(frames, space.size());
  const Above above = above_travelling_joint(space);
  Vector3 before = Vector3::Zero(), position;
  double heading_before = 0, heading = 0;
  bool upside_down = false;
  Quat q;
  for (Index t = 0; t < frames; ++t) {
    travelling_pose(space, above, clip, t, position, q);
    if (!heading_of(q, heading)) upside_down = true;
    const Vector3 tilt = log_map(heading_rotation(heading).conjugate() * q);
    const Vector3 step = heading_rotation(-heading_before) * (position - before);
    y.row(t).head<kRootChannels>() << step.x(), step.z(), position.y() - space.reference_height,
        wrap_angle(heading - heading_before), tilt.x(), tilt.z();
    before = position;
    heading_before = heading;
    for (std::size_t i = 0; i < space.joints.size(); ++i) {
      const int j = space.joints[i];
      const Index col = kRootChannels + 3 * static_cast<Index>(i);
      const Quat relative = reference(space, j).conjugate() * clip.rotation(t, j);
      Vector3 v = log_map(relative);
      if (t > 0) {
        const Vector3 continued = log_map_near(relative, y.row(t - 1).segment<3>(col).transpose());
        if (continued.norm() < kMostTurn) v = continued;  // a joint that seems to wind up had a bad frame
      }
      y.row(t).segment<3>(col) = v.transpose();
    }
  }
  for (const Index c : {0, 1, 3}) y(0, c) = y(1, c);
  if (upside_down) job.warn(clip.name + ": the body is upside down in some frames; the last heading is kept there");
  y.array().rowwise() *= space.weights.transpose().array();
  return y;
}

RootPlace root_place(const FeatureSpace& space, const Clip& clip, Index frame) {
  Vector3 position;
  Quat q;
  travelling_pose(space, above_travelling_joint(space), clip, frame, position, q);
  RootPlace place{position.x(), position.z(), 0};
  heading_of(q, place.heading);
  return place;
}

void decode_frame(const FeatureSpace& space, const double* features, bool first, RootPlace& place, Clip& out,
                  Index frame) {
  const double* w = space.weights.data();
  if (!first) move_on(space, features, place);
  const Quat world = heading_rotation(place.heading) * exp_map(Vector3(features[4] / w[4], 0, features[5] / w[5]));
  const Vector3 position(place.x, space.reference_height + features[2] / w[2], place.z);
  const int root = space.travelling_joint;
  if (space.skeleton.joints[static_cast<std::size_t>(root)].parent_idx < 0) {
    out.set_translation(frame, root, position);
    out.set_rotation(frame, root, world);
  } else {
    const Above above = above_travelling_joint(space);
    out.set_translation(frame, root, above.rotation.conjugate() * (position - above.position));
    out.set_rotation(frame, root, above.rotation.conjugate() * world);
  }
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const Index col = kRootChannels + 3 * static_cast<Index>(i);
    const Vector3 v(features[col] / w[col], features[col + 1] / w[col], features[col + 2] / w[col]);
    out.set_rotation(frame, space.joints[i], reference(space, space.joints[i]) * exp_map(v));
  }
}

Clip make_held_clip(const FeatureSpace& space, Index num_frames) {
  Clip out = make_clip(space.skeleton, num_frames, space.frame_time_secs);
  for (int j = 0; j < space.skeleton.num_joints(); ++j) {
    out.translations.middleCols<3>(3 * j).rowwise() = space.held.row(j);
    out.rotations.middleCols<4>(4 * j).rowwise() = space.references.row(j);
  }
  return out;
}

Clip decode(const FeatureSpace& space, const FrameMatrix& features, RootPlace start) {
  if (features.cols() != space.size()) throw InvalidInput("decode: the features have another size than the space");
  Clip out = make_held_clip(space, features.rows());
  for (Index t = 0; t < features.rows(); ++t) decode_frame(space, &features(t, 0), t == 0, start, out, t);
  return out;
}

RootPath root_path(const FeatureSpace& space, const FrameMatrix& features, RootPlace place) {
  const Index frames = features.rows();
  RootPath path{Vector(frames), Vector(frames), Vector(frames)};
  for (Index t = 0; t < frames; ++t) {
    if (t > 0) move_on(space, &features(t, 0), place);
    path.x[t] = place.x, path.z[t] = place.z, path.heading[t] = place.heading;
  }
  return path;
}

void set_root_path(const FeatureSpace& space, const RootPath& path, FrameMatrix& features) {
  for (Index t = 1; t < path.num_frames(); ++t) {
    const Vector3 way(path.x[t] - path.x[t - 1], 0, path.z[t] - path.z[t - 1]);
    const Vector3 step = heading_rotation(-path.heading[t - 1]) * way;
    features(t, 0) = step.x() * space.weights[0];
    features(t, 1) = step.z() * space.weights[1];
    features(t, 3) = (path.heading[t] - path.heading[t - 1]) * space.weights[3];
  }
}

}  // namespace motex
