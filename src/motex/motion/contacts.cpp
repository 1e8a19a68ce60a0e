// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "motex/core/error.h"
#include "motex/core/quantile.h"

namespace motex {
namespace {

/// Joints from `joint` up to the root.
std::vector<int> chain_to_root(const Skeleton& skeleton, int joint) {
  std::vector<int> chain;
  for (int j = joint; j >= 0; j = skeleton.joints[static_cast<std::size_t>(j)].parent_idx) chain.push_back(j);
  return chain;
}

struct Tip {
  int joint;      // that carries it
  double height;  // 5th percentile
};

/// End sites and childless joints, lowest first.
std::vector<Tip> find_tips(const Skeleton& skeleton, const std::vector<FrameMatrix>& positions) {
  std::vector<bool> has_tip_below(skeleton.joints.size(), false);
  for (const Joint& joint : skeleton.joints)
    if (joint.parent_idx >= 0) has_tip_below[static_cast<std::size_t>(joint.parent_idx)] = true;
  for (const EndSite& site : skeleton.end_sites) has_tip_below[static_cast<std::size_t>(site.parent_idx)] = true;
  const auto low = [&](Index point) {
    std::vector<double> heights;
    for (const FrameMatrix& p : positions)
      for (Index t = 0; t < p.rows(); ++t) heights.push_back(p(t, 3 * point + 1));
    return quantile(std::move(heights), 0.05);
  };
  std::vector<Tip> tips;
  for (int j = 0; j < skeleton.num_joints(); ++j)
    if (!has_tip_below[static_cast<std::size_t>(j)]) tips.push_back({j, low(j)});
  for (std::size_t e = 0; e < skeleton.end_sites.size(); ++e)
    tips.push_back({skeleton.end_sites[e].parent_idx, low(skeleton.num_joints() + static_cast<Index>(e))});
  std::stable_sort(tips.begin(), tips.end(), [](const Tip& a, const Tip& b) { return a.height < b.height; });
  return tips;
}

/// chain: joints from the foot upwards; the leg's hip may be any of them. Bone lengths are those of the clip.
std::optional<Leg> leg_on_chain(const Clip& clip, const std::vector<int>& chain) {
  std::optional<Leg> leg;
  double best = 0;
  for (std::size_t i = 0; i + 2 < chain.size(); ++i) {
    const double shank = clip.translation(0, chain[i]).norm(), thigh = clip.translation(0, chain[i + 1]).norm();
    if (std::min(shank, thigh) <= best) continue;
    best = std::min(shank, thigh);
    leg = Leg{};
    leg->ankle_idx = chain[i], leg->knee_idx = chain[i + 1], leg->hip_idx = chain[i + 2];
  }
  if (!leg) return leg;
  const Skeleton& skeleton = clip.skeleton;
  for (int j = 0; j < skeleton.num_joints(); ++j)
    if (skeleton.joints[static_cast<std::size_t>(j)].parent_idx == leg->ankle_idx &&
        clip.translation(0, j).norm() > leg->toe_offset.norm())
      leg->toe_offset = clip.translation(0, j);
  for (const EndSite& site : skeleton.end_sites)
    if (site.parent_idx == leg->ankle_idx && site.offset.norm() > leg->toe_offset.norm()) leg->toe_offset = site.offset;
  return leg;
}

std::vector<Leg> named_legs(const Clip& clip, std::span<const std::string> names) {
  std::vector<Leg> legs;
  for (const std::string& name : names) {
    const int joint = clip.skeleton.find(name);
    if (joint < 0) throw InvalidInput("there is no joint '" + name + "' to be a foot");
    const auto leg = leg_on_chain(clip, chain_to_root(clip.skeleton, joint));
    if (!leg) throw InvalidInput("'" + name + "' cannot be a foot: it needs two bones above it");
    const auto same = [&](const Leg& other) { return other.ankle_idx == leg->ankle_idx; };
    if (std::none_of(legs.begin(), legs.end(), same)) legs.push_back(*leg);
  }
  return legs;
}

/// The lowest limb and the lowest other one that leaves the body above its own hip.
std::vector<Leg> lowest_legs(const Clip& clip, const std::vector<Tip>& tips) {
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const std::vector<int> first = chain_to_root(clip.skeleton, tips[i].joint);
    for (std::size_t k = i + 1; k < tips.size(); ++k) {
      const std::vector<int> second = chain_to_root(clip.skeleton, tips[k].joint);
      const auto limb = [](const std::vector<int>& chain, const std::vector<int>& other) {
        std::vector<int> own;
        for (const int j : chain)
          if (std::find(other.begin(), other.end(), j) == other.end()) own.push_back(j);
        return own;
      };
      const auto a = leg_on_chain(clip, limb(first, second)), b = leg_on_chain(clip, limb(second, first));
      if (a && b) return {*a, *b};
    }
  }
  return {};
}

int find_pelvis(const Skeleton& skeleton, const std::vector<Leg>& legs) {
  std::vector<int> common = chain_to_root(skeleton, legs.front().hip_idx);
  for (const Leg& leg : legs) {
    const std::vector<int> chain = chain_to_root(skeleton, leg.hip_idx);
    std::erase_if(common,
                  [&](int j) { return j == leg.hip_idx || std::find(chain.begin(), chain.end(), j) == chain.end(); });
  }
  for (const int j : common)
    if (has_position_channels(skeleton.joints[static_cast<std::size_t>(j)])) return j;
  return common.empty() ? 0 : common.back();
}

/// Heights and horizontal speeds of one point over all clips; the last frame of a clip has no speed.
struct PointTrack {
  std::vector<double> heights, speeds;
};

Vector3 toe_position(const Pose& pose, const Leg& leg) {
  return pose.positions.col(leg.ankle_idx) + pose.rotation(leg.ankle_idx) * leg.toe_offset;
}

PointTrack track_point(std::span<const Clip> clips, const Leg& leg, int point) {
  PointTrack track;
  Pose pose;
  for (const Clip& clip : clips) {
    Vector3 last = Vector3::Zero();
    for (Index t = 0; t < clip.num_frames(); ++t) {
      forward_kinematics(clip, t, pose);
      const Vector3 p = point == kToe ? toe_position(pose, leg) : Vector3(pose.positions.col(leg.ankle_idx));
      track.heights.push_back(p.y());
      track.speeds.push_back(std::hypot(p.x() - last.x(), p.z() - last.z()) / clip.frame_time_secs);
      if (t == 0) track.speeds.back() = -1;
      last = p;
    }
  }
  return track;
}

/// Mean axis about which the knee bends, seen from the hip joint.
Vector3 learn_knee_axis(std::span<const Clip> clips, const Leg& leg) {
  Vector3 sum = Vector3::Zero();
  Pose pose;
  for (const Clip& clip : clips)
    for (Index t = 0; t < clip.num_frames(); ++t) {
      forward_kinematics(clip, t, pose);
      const Vector3 thigh = pose.positions.col(leg.knee_idx) - pose.positions.col(leg.hip_idx);
      const Vector3 shank = pose.positions.col(leg.ankle_idx) - pose.positions.col(leg.knee_idx);
      sum += pose.rotation(leg.hip_idx).conjugate() * thigh.cross(shank);
    }
  return sum.norm() > 1e-12 ? Vector3(sum.normalized()) : Vector3(Vector3::UnitX());
}

/// Floor and begin height of one point; adds the speeds of low frames.
void learn_heights(const PointTrack& track, double cm_per_unit, double& floor, double& height,
                   std::vector<double>& low_speeds) {
  floor = quantile(track.heights, 0.02);
  height = std::max(2.5 / cm_per_unit, 1.5 * (quantile(track.heights, 0.5) - floor));
  for (std::size_t i = 0; i < track.heights.size(); ++i)
    if (track.speeds[i] >= 0 && track.heights[i] < floor + height) low_speeds.push_back(track.speeds[i]);
}

}  // namespace

FootModel learn_foot_model(std::span<const Clip> clips, std::span<const std::string> names, const JobContext& job) {
  if (clips.empty() || clips.front().num_frames() == 0) throw InvalidInput("feet are learned from at least one frame");
  const Skeleton& skeleton = clips.front().skeleton;
  FootModel model;
  model.cm_per_unit = 100 * metres_per_unit_or_guess(skeleton);
  if (names.empty()) {
    std::vector<FrameMatrix> positions;
    for (const Clip& clip : clips) positions.push_back(world_positions(clip));
    model.legs = lowest_legs(clips.front(), find_tips(skeleton, positions));
  } else {
    model.legs = named_legs(clips.front(), names);
  }
  if (model.legs.empty()) {
    job.warn("No two legs were found in the skeleton: feet will not be held; name them with --feet.");
    return model;
  }
  model.pelvis_idx = find_pelvis(skeleton, model.legs);
  std::vector<double> low_speeds;
  for (Leg& leg : model.legs) {
    job.check_cancelled();
    leg.knee_axis = learn_knee_axis(clips, leg);
    learn_heights(track_point(clips, leg, kAnkle), model.cm_per_unit, leg.ankle_floor, leg.ankle_height, low_speeds);
    if (leg.has_toe())
      learn_heights(track_point(clips, leg, kToe), model.cm_per_unit, leg.toe_floor, leg.toe_height, low_speeds);
  }
  const double usual = low_speeds.empty() ? 0 : quantile(std::move(low_speeds), 0.25) * model.cm_per_unit;
  model.begin_speed = std::clamp(3 * usual, 10.0, 30.0) / model.cm_per_unit;
  model.end_speed = 1.5 * model.begin_speed;
  model.height_margin = 1.5 / model.cm_per_unit;
  return model;
}

ContactDetector::ContactDetector(double begin_height, double end_height, double begin_speed, double end_speed,
                                 int min_frames)
    : begin_height_(begin_height),
      end_height_(end_height),
      begin_speed_(begin_speed),
      end_speed_(end_speed),
      min_frames_(std::max(1, min_frames)) {}

int ContactDetector::push(double height, double speed) {
  const bool holds =
      run_ == 0 ? height < begin_height_ && speed < begin_speed_ : height < end_height_ && speed < end_speed_;
  run_ = holds ? std::min(run_ + 1, min_frames_ + 1) : 0;
  if (run_ < min_frames_) return 0;
  return run_ == min_frames_ ? min_frames_ : 1;
}

ContactDetector make_contact_detector(const FootModel& model, const Leg& leg, int point, double frame_time_secs) {
  const double begin = point == kToe ? leg.toe_floor + leg.toe_height : leg.ankle_floor + leg.ankle_height;
  // A foot without a toe never has contact there.
  const double low = point == kToe && !leg.has_toe() ? -HUGE_VAL : begin;
  return {low, low + model.height_margin, model.begin_speed, model.end_speed,
          static_cast<int>(std::lround(model.min_contact_secs / frame_time_secs))};
}

ContactMatrix detect_contacts(const Clip& clip, const FootModel& model) {
  const Index frames = clip.num_frames();
  ContactMatrix contacts = ContactMatrix::Zero(frames, 2 * static_cast<Index>(model.legs.size()));
  if (frames < 2) return contacts;
  FrameMatrix points(frames, 3 * contacts.cols());
  Pose pose;
  for (Index t = 0; t < frames; ++t) {
    forward_kinematics(clip, t, pose);
    for (std::size_t l = 0; l < model.legs.size(); ++l) {
      points.block<1, 3>(t, 6 * static_cast<Index>(l)) = pose.positions.col(model.legs[l].ankle_idx).transpose();
      points.block<1, 3>(t, 6 * static_cast<Index>(l) + 3) = toe_position(pose, model.legs[l]).transpose();
    }
  }
  for (Index c = 0; c < contacts.cols(); ++c) {
    const Leg& leg = model.legs[static_cast<std::size_t>(c / 2)];
    ContactDetector detector = make_contact_detector(model, leg, static_cast<int>(c % 2), clip.frame_time_secs);
    for (Index t = 0; t < frames; ++t) {
      const Index a = std::max<Index>(t - 1, 0), b = std::min(t + 1, frames - 1);
      const double speed =
          std::hypot(points(b, 3 * c) - points(a, 3 * c), points(b, 3 * c + 2) - points(a, 3 * c + 2)) /
          (static_cast<double>(b - a) * clip.frame_time_secs);
      const int planted = detector.push(points(t, 3 * c + 1), speed);
      for (int back = 0; back < planted; ++back) contacts(t - back, c) = 1;
    }
  }
  return contacts;
}

}  // namespace motex
