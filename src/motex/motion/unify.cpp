// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/unify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "motex/core/error.h"
#include "motex/motion/length_unit.h"

namespace motex {
namespace {

constexpr double kLargestDifference = 0.05;  // of a bone's length
constexpr double kShortBone = 0.01;          // of the body: the length that counts at least
constexpr double kSameRate = 1e-4;           // 1/60 and 0.0166667 are one rate
constexpr double kStill = 1e-6;              // of a bone's length
constexpr double kWorthSaying = 5e-4;        // of a bone's length: a file's rounding is not

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

std::string fixed(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

double body_size(const Skeleton& skeleton) {
  double sum = 0;
  for (const Joint& joint : skeleton.joints)
    if (joint.parent_idx >= 0) sum += joint.offset.norm();
  return sum;
}

// Where offsets may differ freely: roots and joints that travel take their place from the frames.
bool stands_still(const Clip& clip, int joint) {
  const Vector3& offset = clip.skeleton.joints[at(joint)].offset;
  const auto away = clip.translations.middleCols<3>(3 * joint).rowwise() - offset.transpose();
  return clip.num_frames() == 0 || away.cwiseAbs().maxCoeff() <= kStill * std::max(1.0, offset.norm());
}

void check_same_joints(const std::vector<Clip>& clips) {
  for (const Clip& clip : clips) {
    const std::string difference = skeleton_difference(clips[0].skeleton, clip.skeleton);
    if (!difference.empty())
      throw InvalidInput("the skeletons of " + clips[0].name + " and " + clip.name + " differ: " + difference);
  }
}

void unify_units(std::vector<Clip>& clips, const JobContext& job) {
  double& unit = clips[0].skeleton.metres_per_unit;
  for (Clip& clip : clips) {
    // Two clips that do not know their units are taken to be in one.
    if (unit > 0 || clip.skeleton.metres_per_unit > 0) match_unit(clip, clips[0].skeleton, job);
    if (!(unit > 0)) unit = clip.skeleton.metres_per_unit;
  }
  for (Clip& clip : clips) clip.skeleton.metres_per_unit = unit;
}

// The mean of a vector over the clips; says by how much of its length it differs between them.
struct Mean {
  Vector3 value = Vector3::Zero();
  double difference = 0;
  std::size_t worst = 0;  // the clip that is farthest from the first
};

template <typename OffsetOf>
Mean mean_offset(const std::vector<Clip>& clips, double shortest, OffsetOf offset_of) {
  Mean mean;
  double length = shortest, farthest = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const Vector3 offset = offset_of(clips[c]);
    mean.value += offset / static_cast<double>(clips.size());
    length = std::max(length, offset.norm());
    const double away = (offset - offset_of(clips[0])).norm();
    if (away > farthest) farthest = away, mean.worst = c;
  }
  mean.difference = length > 0 ? farthest / length : 0;
  if (farthest == 0) mean.value = offset_of(clips[0]);  // to the last bit
  return mean;
}

[[noreturn]] void refuse(const std::vector<Clip>& clips, const Mean& mean, const std::string& joint) {
  throw InvalidInput("the skeletons of " + clips[0].name + " and " + clips[mean.worst].name +
                     " differ: the offset of " + joint + " by " + fixed(100 * mean.difference, 0) +
                     " % of its length; up to 5 % is averaged");
}

double unify_joint(std::vector<Clip>& clips, int joint, double shortest) {
  const Skeleton& first = clips[0].skeleton;
  const bool root = first.joints[at(joint)].parent_idx < 0;
  const Mean mean =
      mean_offset(clips, shortest, [&](const Clip& clip) { return clip.skeleton.joints[at(joint)].offset; });
  std::vector<char> still;
  for (const Clip& clip : clips) still.push_back(stands_still(clip, joint));
  const bool matters = !root && std::all_of(still.begin(), still.end(), [](char s) { return s != 0; });
  if (matters && mean.difference > kLargestDifference)
    refuse(clips, mean, "joint '" + first.joints[at(joint)].name + "'");
  for (std::size_t c = 0; c < clips.size(); ++c) {
    Clip& clip = clips[c];
    Joint& own = clip.skeleton.joints[at(joint)];
    own.offset = matters ? mean.value : first.joints[at(joint)].offset;
    own.channels = first.joints[at(joint)].channels;
    if (still[c] && matters) clip.translations.middleCols<3>(3 * joint).rowwise() = own.offset.transpose();
  }
  return matters ? mean.difference : 0;
}

// End sites are tips only: where their number or place differs the first clip's are taken.
void unify_end_sites(std::vector<Clip>& clips) {
  for (Clip& clip : clips)
    if (&clip != &clips[0]) clip.skeleton.end_sites = clips[0].skeleton.end_sites;
}

void unify_skeletons(std::vector<Clip>& clips, const JobContext& job) {
  check_same_joints(clips);
  unify_units(clips, job);
  const double shortest = kShortBone * body_size(clips[0].skeleton);
  double largest = 0;
  std::string where;
  for (int j = 0; j < clips[0].skeleton.num_joints(); ++j) {
    const double difference = unify_joint(clips, j, shortest);
    if (difference > largest) largest = difference, where = clips[0].skeleton.joints[at(j)].name;
  }
  unify_end_sites(clips);
  if (largest > kWorthSaying)
    job.warn("the clips' bones differ by up to " + fixed(100 * largest, 1) + " % (joint '" + where +
             "'); their mean lengths are used");
}

void unify_rates(std::vector<Clip>& clips, const JobContext& job) {
  double slowest = 0;
  for (const Clip& clip : clips) slowest = std::max(slowest, clip.frame_time_secs);
  int num_resampled = 0;
  for (Clip& clip : clips) {
    if (clip.frame_time_secs < slowest * (1 - kSameRate)) {
      clip = resample(clip, slowest);
      ++num_resampled;
    }
    clip.frame_time_secs = slowest;
  }
  if (num_resampled > 0)
    job.warn("the clips have different frame rates; " + std::to_string(num_resampled) + " of " +
             std::to_string(clips.size()) + " were resampled to the lowest, " + fixed(1 / slowest, 3) + " Hz");
}

}  // namespace

void unify_clips(std::vector<Clip>& clips, const JobContext& job) {
  if (clips.empty()) return;
  unify_skeletons(clips, job);
  unify_rates(clips, job);
}

}  // namespace motex
