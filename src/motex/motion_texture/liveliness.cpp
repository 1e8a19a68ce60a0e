// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/liveliness.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace motex {
namespace {

constexpr double kSampleSecs = 0.1;

/// Sum over joints and end sites of the way from row − 1 to row, units.
double way_of_joints(const MotionTexture& model, Index row, Clip& pair) {
  RootPlace place;
  for (Index k = 0; k < 2; ++k) {
    const Vector features = model.corpus.row(row - 1 + k).cast<double>();
    decode_frame(model.features, features.data(), k == 0, place, pair, k);
  }
  const FrameMatrix positions = world_positions(pair);
  double sum = 0;
  for (Index j = 0; j + 3 <= positions.cols(); j += 3)
    sum += (positions.block<1, 3>(1, j) - positions.block<1, 3>(0, j)).norm();
  return sum;
}

}  // namespace

std::vector<double> mean_speeds(const MotionTexture& model) {
  const auto stride = std::max<Index>(1, std::lround(kSampleSecs / model.frame_time_secs()));
  const Skeleton& skeleton = model.features.skeleton;
  const auto joints = static_cast<double>(skeleton.joints.size() + skeleton.end_sites.size());
  Clip pair = make_held_clip(model.features, 2);
  std::vector<double> out;
  for (const Instance& x : model.instances) {
    double sum = 0, count = 0;
    for (Index t = 1; t < x.length; t += stride, ++count) sum += way_of_joints(model, x.row + t, pair);
    out.push_back(count > 0 ? model.features.cm_per_unit * sum / (joints * count) : 0);
  }
  return out;
}

std::vector<double> liveliness(const MotionTexture& model, const std::vector<int>& among) {
  std::vector<double> out = mean_speeds(model);
  double sum = 0, weights = 0;
  for (const int i : among) {
    const Instance& x = model.instances[static_cast<std::size_t>(i)];
    const double visits = model.visit_ratios.empty() ? 1 : model.visit_ratios[static_cast<std::size_t>(x.texton)];
    const double weight = visits * static_cast<double>(x.length);
    sum += weight * out[static_cast<std::size_t>(i)], weights += weight;
  }
  for (double& u : out) u = sum > 0 ? u * weights / sum - 1 : 0;
  return out;
}

std::vector<double> liveliness(const MotionTexture& model) {
  std::vector<int> all(model.instances.size());
  std::iota(all.begin(), all.end(), 0);
  return liveliness(model, all);
}

}  // namespace motex
