// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/choreography_bridge.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kFastest = 0.999;
constexpr Index kStepChannels[] = {0, 1, 3};

}  // namespace

PlanPoses poses_at(const MotionTexture& model, Index row) {
  PlanPoses out{model.corpus.middleRows(row, 2).cast<double>(), row};
  if (model.heights.size() == model.corpus.rows()) out.features.col(2) = model.heights.segment(row, 2);
  return out;
}

int instance_at(const MotionTexture& model, Index row) {
  const auto after = std::upper_bound(model.instances.begin(), model.instances.end(), row,
                                      [](Index r, const Instance& instance) { return r < instance.row; });
  return static_cast<int>(after - model.instances.begin()) - 1;
}

double pose_distance(const MotionTexture& model, const FrameMatrix& poses, Index row) {
  return std::sqrt(0.5 * (poses - model.corpus.middleRows(row, 2).cast<double>()).squaredNorm());
}

double distance_from_model(const MotionTexture& model, const FrameMatrix& poses) {
  double least = kNever;
  for (const Run& run : model.runs)
    for (Index r = run.row; r + 2 <= run.row + run.length; ++r) least = std::min(least, pose_distance(model, poses, r));
  return least;
}

double pace_cost(Index source_length, Index length, double stretch) {
  if (length == source_length) return 0;
  const double ratio =
      std::log(static_cast<double>(length) / static_cast<double>(source_length)) / std::log1p(std::max(stretch, 1e-9));
  return ratio * ratio;
}

double fastest_step(const MotionTexture& model) {
  std::vector<double> steps;
  for (const Run& run : model.runs)
    for (Index r = run.row; r + 1 < run.row + run.length; ++r) {
      Vector step = (model.corpus.row(r + 1) - model.corpus.row(r)).transpose().cast<double>();
      for (const Index c : kStepChannels) step[c] = 0;
      steps.push_back(step.norm());
    }
  if (steps.empty()) return 1e-6;
  const auto place = static_cast<std::ptrdiff_t>(kFastest * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), steps.begin() + place, steps.end());
  return std::max(steps[static_cast<std::size_t>(place)], 1e-6);
}

ChoreographyBridge::ChoreographyBridge(const MotionTexture& model, const PlanRequest& request, double tau,
                                       double fastest)
    : model_(model),
      wanted_(request),
      tau_(tau),
      from_start_(Vector::Constant(model.corpus.rows(), kNever)),
      to_end_(from_start_) {
  Vector way = (request.end.features.row(0) - request.start.features.row(1)).transpose();
  for (const Index c : kStepChannels) way[c] = 0;
  least_ = 3 + std::max<Index>(1, static_cast<Index>(std::ceil(way.norm() / fastest)));
  for (const Run& run : model.runs) {
    most_ = std::max(most_, run.length);
    for (Index r = run.row; r + 2 <= run.row + run.length; ++r) {
      from_start_[r] = pose_distance(model, request.start.features, r);
      to_end_[r] = pose_distance(model, request.end.features, r);
    }
  }
}

Plan ChoreographyBridge::plan(Index num_frames) const {
  Plan best;
  best.cost = kNever;
  if (num_frames < least_ || num_frames > most_) return best;
  const auto frames = static_cast<double>(num_frames);
  const auto shortest = std::max<Index>(4, static_cast<Index>(std::ceil(frames / (1 + wanted_.stretch) - 1e-9)));
  const auto longest = static_cast<Index>(frames * (1 + wanted_.stretch) + 1e-9);
  Index row = -1, length = 0;
  for (Index n = shortest; n <= longest; ++n) {
    const double fixed = 2 * kJumpCost + pace_cost(n, num_frames, wanted_.stretch);
    for (const Run& run : model_.runs)
      for (Index r = run.row; r + n <= run.row + run.length; ++r) {
        const double cost = fixed + kBend * (from_start_[r] + to_end_[r + n - 2]) / tau_;
        if (cost < best.cost) best.cost = cost, row = r, length = n;
      }
  }
  PlannedSegment segment;
  segment.instance = instance_at(model_, row + length / 2);
  segment.piece = {model_.instances[static_cast<std::size_t>(segment.instance)].texton,
                   row,
                   length,
                   wanted_.start.row,
                   wanted_.end.row,
                   num_frames};
  best.start_distance = segment.first_distance = from_start_[row];
  best.end_distance = segment.last_distance = to_end_[row + length - 2];
  best.segments.push_back(segment);
  return best;
}

}  // namespace motex
