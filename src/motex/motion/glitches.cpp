// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/glitches.h"

#include <algorithm>
#include <cmath>

#include "motex/core/options_check.h"

namespace motex {
namespace {

/// Largest share of its limit that any second difference of each frame reaches; lag: frames of one step.
std::vector<double> excess(const Clip& clip, const GlitchOptions& options, Index lag) {
  const FrameMatrix positions = world_positions(clip);
  const Index frames = positions.rows(), points = positions.cols() / 3;
  const Index root = travelling_joint({&clip, 1});
  const double secs = static_cast<double>(lag) * clip.frame_time_secs;
  const double metres = metres_per_unit_or_guess(clip.skeleton) / (secs * secs);
  std::vector<double> shares(static_cast<std::size_t>(frames), 0);
  for (Index t = lag; t + lag < frames; ++t) {
    const Eigen::RowVectorXd second = positions.row(t + lag) - 2 * positions.row(t) + positions.row(t - lag);
    const auto travel = second.segment<3>(3 * root);
    double joint = 0;
    for (Index j = 0; j < points; ++j) joint = std::max(joint, (second.segment<3>(3 * j) - travel).norm());
    shares[static_cast<std::size_t>(t)] =
        metres * std::max(travel.norm() / options.root_acceleration, joint / options.joint_acceleration);
  }
  // The ends have no second difference of their own.
  for (Index t = 0; t < lag && frames > 2 * lag; ++t) {
    shares[static_cast<std::size_t>(t)] = shares[static_cast<std::size_t>(lag)];
    shares[static_cast<std::size_t>(frames - 1 - t)] = shares[static_cast<std::size_t>(frames - 1 - lag)];
  }
  return shares;
}

}  // namespace

std::vector<Index> find_glitch_frames(const Clip& clip, const GlitchOptions& options) {
  check_options(options);
  const auto lag = std::max<Index>(1, std::lround(1.0 / 60 / clip.frame_time_secs));
  const std::vector<double> shares = excess(clip, options, lag);
  std::vector<bool> bad(shares.size(), false);
  const auto spread = [&](std::size_t from, std::ptrdiff_t step) {
    for (auto u = static_cast<std::ptrdiff_t>(from); u >= 0 && u < std::ssize(shares); u += step) {
      if (shares[static_cast<std::size_t>(u)] <= options.extend) return;
      bad[static_cast<std::size_t>(u)] = true;
    }
  };
  for (std::size_t t = 0; t < shares.size(); ++t)
    if (shares[t] > 1) bad[t] = true, spread(t, 1), spread(t, -1);
  std::vector<Index> frames;
  for (std::size_t t = 0; t < bad.size(); ++t)
    if (bad[t]) frames.push_back(static_cast<Index>(t));
  return frames;
}

std::vector<FrameRange> ranges_without(Index num_frames, std::span<const Index> left_out, Index min_frames) {
  std::vector<FrameRange> ranges;
  Index first = 0;
  const auto close = [&](Index end) {
    if (end - first >= std::max<Index>(1, min_frames)) ranges.push_back({first, end - first});
    first = end + 1;
  };
  for (const Index frame : left_out) close(frame);
  close(num_frames);
  return ranges;
}

int travelling_joint(std::span<const Clip> clips) {
  if (clips.empty()) return 0;
  for (int j = 0; j < clips.front().skeleton.num_joints(); ++j)
    for (const Clip& clip : clips) {
      if (clip.num_frames() == 0) continue;
      const auto t = clip.translations.middleCols<3>(3 * j);
      const double size = std::max(1.0, t.cwiseAbs().maxCoeff());
      if ((t.colwise().maxCoeff() - t.colwise().minCoeff()).norm() > 1e-4 * size) return j;
    }
  return 0;
}

}  // namespace motex
