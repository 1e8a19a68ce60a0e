// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/adapt_clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"

namespace motex {
namespace {

constexpr const char* kRootBone = "root_motion";

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

std::vector<std::string> joint_names(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

std::vector<std::string_view> parts_between_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::string_view part = text.substr(start, comma - start);
    if (!part.empty()) parts.push_back(part);
    start = comma + 1;
  }
  return parts;
}

/// Flags of the names that fit some pattern; every pattern must fit one.
std::vector<char> named(const std::vector<std::string>& names, const std::string& patterns, const std::string& what) {
  std::vector<char> out(names.size(), 0);
  for (const std::string_view pattern : parts_between_commas(patterns)) {
    bool found = false;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (fits_pattern(pattern, names[i])) out[i] = 1, found = true;
    if (!found) throw InvalidInput("there is no " + what + " '" + std::string(pattern) + "'");
  }
  return out;
}

/// The way from a joint up to the next one that is kept: its own index first, those that are left out above it after.
std::vector<int> chain_to_kept(const Skeleton& skeleton, const std::vector<char>& keep, int joint) {
  std::vector<int> chain{joint};
  for (int up = skeleton.joints[at(joint)].parent_idx; up >= 0 && !keep[at(up)];
       up = skeleton.joints[at(up)].parent_idx)
    chain.push_back(up);
  return chain;
}

Skeleton kept_skeleton(const Skeleton& skeleton, const std::vector<char>& keep) {
  Skeleton out;
  out.metres_per_unit = skeleton.metres_per_unit;
  std::vector<int> new_idx(skeleton.joints.size(), -1);
  std::vector<char> has_tip(skeleton.joints.size(), 0);
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    if (!keep[at(j)]) continue;
    const std::vector<int> chain = chain_to_kept(skeleton, keep, j);
    Joint joint = skeleton.joints[at(j)];
    for (std::size_t k = 1; k < chain.size(); ++k) joint.offset += skeleton.joints[at(chain[k])].offset;
    const int above = skeleton.joints[at(chain.back())].parent_idx;
    if (above >= 0) has_tip[at(above)] = 1;
    joint.parent_idx = above < 0 ? -1 : new_idx[at(above)];
    new_idx[at(j)] = out.num_joints();
    out.joints.push_back(std::move(joint));
  }
  for (const EndSite& site : skeleton.end_sites)
    if (keep[at(site.parent_idx)]) {
      out.end_sites.push_back({new_idx[at(site.parent_idx)], site.offset});
      has_tip[at(site.parent_idx)] = 1;
    }
  // The tips of limbs that were cut short, so that they keep their length.
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    const int parent = skeleton.joints[at(j)].parent_idx;
    if (parent >= 0 && !keep[at(j)] && keep[at(parent)] && !has_tip[at(parent)])
      out.end_sites.push_back({new_idx[at(parent)], skeleton.joints[at(j)].offset});
  }
  return out;
}

/// Units that are not known must be when lengths become those of another unit or size.
void settle_unit(Clip& clip, const JobContext& job) {
  if (clip.skeleton.metres_per_unit > 0) return;
  clip.skeleton.metres_per_unit = metres_per_unit_or_guess(clip.skeleton);
  job.warn(clip.name + ": its unit of length is not known; the body is taken to stand 1.7 m");
}

bool stands_still(const Clip& clip) {
  const auto moves = [&](Index column) {
    return clip.num_frames() > 1 &&
           clip.translations.col(column).maxCoeff() - clip.translations.col(column).minCoeff() > 0;
  };
  return !moves(0) && !moves(2);
}

double heading_near(const Quat& q, double near) {
  const double heading = 2 * std::atan2(q.y(), q.w());
  return heading + 2 * std::numbers::pi * std::round((near - heading) / (2 * std::numbers::pi));
}

std::string free_name(const Skeleton& skeleton) {
  std::string name = kRootBone;
  for (int n = 2; skeleton.find(name) >= 0; ++n) name = kRootBone + std::string("_") + std::to_string(n);
  return name;
}

}  // namespace

bool fits_pattern(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = pattern.npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != pattern.npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<char> chosen_names(const std::vector<std::string>& names, const std::string& only,
                               const std::string& without, const std::string& what) {
  std::vector<char> keep = only.empty() ? std::vector<char>(names.size(), 1) : named(names, only, what);
  const std::vector<char> dropped = named(names, without, what);
  for (std::size_t i = 0; i < names.size(); ++i) keep[i] = static_cast<char>(keep[i] != 0 && dropped[i] == 0);
  if (std::find(keep.begin(), keep.end(), 1) == keep.end()) throw InvalidInput("no " + what + " is left to write");
  return keep;
}

Clip keep_joints(const Clip& clip, const std::vector<char>& keep) {
  const Skeleton& skeleton = clip.skeleton;
  if (keep.size() != skeleton.joints.size() || std::find(keep.begin(), keep.end(), 1) == keep.end())
    throw InvalidInput(clip.name + ": no joint is left to write");
  Clip out = make_clip(kept_skeleton(skeleton, keep), clip.num_frames(), clip.frame_time_secs);
  out.name = clip.name;
  int kept = 0;
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    if (!keep[at(j)]) continue;
    const std::vector<int> chain = chain_to_kept(skeleton, keep, j);
    for (Index t = 0; t < clip.num_frames(); ++t) {
      Vector3 position = clip.translation(t, j);
      Quat rotation = clip.rotation(t, j);
      for (std::size_t k = 1; k < chain.size(); ++k) {
        const Quat above = clip.rotation(t, chain[k]);
        position = clip.translation(t, chain[k]) + above * position;
        rotation = above * rotation;
      }
      out.set_translation(t, kept, position);
      out.set_rotation(t, kept, chain.size() > 1 ? rotation.normalized() : rotation);
    }
    ++kept;
  }
  return out;
}

void hold_in_place(Clip& clip) {
  for (Index t = 0; t < clip.num_frames(); ++t) {
    const Vector3 travel(clip.translation(t, 0).x(), 0, clip.translation(t, 0).z());
    for (int j = 0; j < clip.skeleton.num_joints(); ++j)
      if (clip.skeleton.joints[at(j)].parent_idx < 0) clip.set_translation(t, j, clip.translation(t, j) - travel);
  }
}

Clip with_root_bone(const Clip& clip) {
  Skeleton skeleton = clip.skeleton;
  for (Joint& joint : skeleton.joints) ++joint.parent_idx;
  for (EndSite& site : skeleton.end_sites) ++site.parent_idx;
  Joint bone;
  bone.name = free_name(clip.skeleton);
  bone.channels = {Channel::kXPosition, Channel::kYPosition, Channel::kZPosition,
                   Channel::kZRotation, Channel::kXRotation, Channel::kYRotation};
  skeleton.joints.insert(skeleton.joints.begin(), bone);
  Clip out = make_clip(std::move(skeleton), clip.num_frames(), clip.frame_time_secs);
  out.name = clip.name;
  out.translations.rightCols(clip.translations.cols()) = clip.translations;
  out.rotations.rightCols(clip.rotations.cols()) = clip.rotations;
  double heading = 0;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    const Vector3 travel(clip.translation(t, 0).x(), 0, clip.translation(t, 0).z());
    heading = heading_near(clip.rotation(t, 0), heading);
    const Quat turn(Eigen::AngleAxisd(heading, Vector3::UnitY()));
    out.set_translation(t, 0, travel);
    out.set_rotation(t, 0, turn);
    for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
      if (clip.skeleton.joints[at(j)].parent_idx >= 0) continue;
      out.set_translation(t, j + 1, turn.conjugate() * (clip.translation(t, j) - travel));
      out.set_rotation(t, j + 1, (turn.conjugate() * clip.rotation(t, j)).normalized());
    }
  }
  return out;
}

Clip adapt_clip(Clip clip, const AdaptClipOptions& options, const JobContext& job) {
  check_options(options);
  std::vector<char> keep = chosen_names(joint_names(clip.skeleton), options.joints, options.without, "joint");
  if (options.root != RootMotion::kKeep && stands_still(clip))
    job.warn(clip.name + ": its first joint does not travel, so there is no travel to take away");
  if (options.root == RootMotion::kInPlace) hold_in_place(clip);
  if (options.root == RootMotion::kBone) {
    clip = with_root_bone(clip);
    keep.insert(keep.begin(), 1);
  }
  const bool subset = std::find(keep.begin(), keep.end(), 0) != keep.end();
  if (clip.skeleton.skin && (subset || options.scale != 1)) {
    job.warn(clip.name + ": its skin does not fit the changed body and is left out");
    clip.skeleton.skin = nullptr;
  }
  if (subset) clip = keep_joints(clip, keep);
  job.check_cancelled();
  if (options.out_fps > 0 && std::abs(options.out_fps * clip.frame_time_secs - 1) > 1e-9)
    clip = resample(clip, 1 / options.out_fps);
  if (options.scale != 1) {
    settle_unit(clip, job);
    const double unit = clip.skeleton.metres_per_unit;
    scale_lengths(clip, options.scale);
    clip.skeleton.metres_per_unit = unit;  // the body grew, not the unit
  }
  if (options.out_unit != LengthUnit::kAuto) {
    settle_unit(clip, job);
    scale_lengths(clip, clip.skeleton.metres_per_unit / metres_per_unit(options.out_unit));
    clip.skeleton.metres_per_unit = metres_per_unit(options.out_unit);
  }
  return clip;
}

MarkerSet adapt_markers(MarkerSet markers, const AdaptClipOptions& options) {
  check_options(options);
  if (options.root != RootMotion::kKeep) throw InvalidInput("root: markers have no root to hold in place");
  const std::vector<char> keep = chosen_names(markers.names, options.joints, options.without, "marker");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) names.push_back(markers.names[i]);
  if (names.size() < keep.size()) markers = pick_markers(markers, names);
  if (options.out_fps > 0 && std::abs(options.out_fps * markers.frame_time_secs - 1) > 1e-9)
    markers = resample(markers, 1 / options.out_fps);
  markers.positions *= options.scale;
  if (options.out_unit != LengthUnit::kAuto) {
    if (!(markers.metres_per_unit > 0))
      throw InvalidInput(markers.name + ": its unit of length is not known; name it with --unit");
    markers.positions *= markers.metres_per_unit / metres_per_unit(options.out_unit);
    markers.metres_per_unit = metres_per_unit(options.out_unit);
  }
  return markers;
}

}  // namespace motex
