// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/instance_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/markov/graph.h"
#include "motex/motion_texture/jumps.h"

namespace motex {
namespace {

double usual_jump_distance(const MotionTexture& model) {
  std::vector<double> nearest;
  for (std::size_t a = 0; a < model.instances.size(); ++a) {
    const Index end = hand_over_row(model, model.instances[a]);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < model.instances.size(); ++b)
      if (b != a && b != a + 1) best = std::min(best, key_pose_distance(model.corpus, end, model.instances[b].row));
    if (std::isfinite(best)) nearest.push_back(best);
  }
  if (nearest.empty()) return 1;
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return std::max(*middle, 1e-6);
}

}  // namespace

InstanceWalk::InstanceWalk(const MotionTexture& model, const SynthesizeOptions& options, std::vector<int> path, bool endless)
    : model_(model),
      key_poses_(options.key_poses),
      path_(std::move(path)),
      endless_(endless),
      rng_(Rng(options.seed).fork(1)),
      texton_allowed_(model.textons.size(), false),
      times_played_(model.instances.size(), 0) {
  for (const int texton : path_)
    if (texton < 0 || texton >= static_cast<int>(model.textons.size()))
      throw InvalidInput("there is no texton " + std::to_string(texton) + "; the model has 0 … " +
                         std::to_string(model.textons.size() - 1));
  tau_ = options.nearness * usual_jump_distance(model);
  const Components components = strongly_connected_components(counted_graph(model.transitions));
  for (const int texton : components.largest()) texton_allowed_[static_cast<std::size_t>(texton)] = true;
  for (std::size_t i = 0; i < model.instances.size(); ++i)
    if (is_allowed(static_cast<int>(i))) allowed_.push_back(static_cast<int>(i));
}

bool InstanceWalk::is_allowed(int instance) const {
  return texton_allowed_[static_cast<std::size_t>(model_.instances[static_cast<std::size_t>(instance)].texton)];
}

int InstanceWalk::choose(const std::vector<int>& among, const std::vector<double>* transition_row) {
  std::vector<double> weights(among.size(), 0);
  const Index end = current_ < 0 ? 0 : hand_over_row(model_, model_.instances[static_cast<std::size_t>(current_)]);
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<double> distances(among.size(), 0);
  const auto transition = [&](std::size_t k) {
    const Instance& b = model_.instances[static_cast<std::size_t>(among[k])];
    return transition_row != nullptr ? (*transition_row)[static_cast<std::size_t>(b.texton)] : 1.0;
  };
  for (std::size_t k = 0; k < among.size(); ++k) {
    if (transition(k) <= 0 || current_ < 0 || key_poses_ == KeyPoses::kRandom) continue;
    distances[k] = key_pose_distance(model_.corpus, end, model_.instances[static_cast<std::size_t>(among[k])].row);
    nearest = std::min(nearest, distances[k]);
  }
  if (!std::isfinite(nearest)) nearest = 0;
  double sum = 0;
  for (std::size_t k = 0; k < among.size(); ++k) {
    const double fresh = 1 + times_played_[static_cast<std::size_t>(among[k])];
    sum += weights[k] = transition(k) * std::exp(-(distances[k] - nearest) / tau_) / (fresh * fresh);
  }
  if (!(sum > 0)) return among[rng_.below(among.size())];
  return among[rng_.weighted(weights)];
}

int InstanceWalk::next() {
  if (path_done_ < path_.size()) {
    const int texton = path_[path_done_++];
    current_ = choose(model_.textons[static_cast<std::size_t>(texton)].instances, nullptr);
  } else if (!endless_) {
    return -1;
  } else if (current_ < 0) {
    current_ = allowed_[rng_.below(allowed_.size())];
  } else {
    const int texton = model_.instances[static_cast<std::size_t>(current_)].texton;
    std::vector<double> row(model_.textons.size(), 0);
    for (std::size_t j = 0; j < row.size(); ++j)
      if (texton_allowed_[j]) row[j] = model_.transitions.probability(texton, static_cast<int>(j));
    current_ = choose(allowed_, &row);
  }
  times_played_[static_cast<std::size_t>(current_)] += 1;
  return current_;
}

}  // namespace motex
