// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/crowd.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Appends the clip's joints and frames, moved by dx along x.
void append(const Clip& clip, const std::string& prefix, double dx, Clip& out) {
  const int before = out.skeleton.num_joints(), joints = clip.skeleton.num_joints();
  for (Joint joint : clip.skeleton.joints) {
    joint.name = prefix + joint.name;
    if (joint.parent_idx >= 0) joint.parent_idx += before;
    out.skeleton.joints.push_back(std::move(joint));
  }
  for (EndSite site : clip.skeleton.end_sites) {
    site.parent_idx += before;
    out.skeleton.end_sites.push_back(site);
  }
  const Index frames = clip.num_frames(), rest = out.rotations.rows() - frames;
  out.translations.block(0, 3 * before, frames, 3 * joints) = clip.translations;
  out.rotations.block(0, 4 * before, frames, 4 * joints) = clip.rotations;
  out.translations.block(frames, 3 * before, rest, 3 * joints).rowwise() = clip.translations.row(frames - 1);
  out.rotations.block(frames, 4 * before, rest, 4 * joints).rowwise() = clip.rotations.row(frames - 1);
  for (int j = 0; j < joints; ++j)
    if (clip.skeleton.joints[static_cast<std::size_t>(j)].parent_idx < 0)
      out.translations.col(3 * (before + j)).array() += dx;
}

}  // namespace

Clip side_by_side(std::span<const Clip> clips, double margin) {
  if (clips.empty()) throw InvalidInput("there is no clip to put beside another");
  Clip out;
  out.name = clips[0].name;
  out.frame_time_secs = clips[0].frame_time_secs;
  out.skeleton.metres_per_unit = clips[0].skeleton.metres_per_unit;
  Index frames = 0;
  int joints = 0;
  for (const Clip& clip : clips) {
    if (std::abs(clip.frame_time_secs / out.frame_time_secs - 1) > 1e-6)
      throw InvalidInput(clip.name + " has another frame rate than " + out.name);
    if (clip.num_frames() == 0) throw InvalidInput(clip.name + " has no frame");
    frames = std::max(frames, clip.num_frames());
    joints += clip.skeleton.num_joints();
  }
  out.translations.resize(frames, 3 * joints);
  out.rotations.resize(frames, 4 * joints);
  double edge = 0;
  for (std::size_t k = 0; k < clips.size(); ++k) {
    const FrameMatrix positions = world_positions(clips[k]);
    double low = positions(0, 0), high = low;
    for (Index j = 0; j < positions.cols(); j += 3) {
      low = std::min(low, positions.col(j).minCoeff());
      high = std::max(high, positions.col(j).maxCoeff());
    }
    append(clips[k], "d" + std::to_string(k + 1) + ":", edge - low, out);
    edge += high - low + margin;
  }
  return out;
}

}  // namespace motex
