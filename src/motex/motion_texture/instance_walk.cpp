// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/instance_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/markov/graph.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/liveliness.h"
#include "motex/motion_texture/model_edits.h"

namespace motex {
namespace {

constexpr double kPatience = 0.65;
constexpr double kCuriosity = 6, kSteeredCuriosity = 2;
constexpr double kFarthest = 1.25;  // τ
constexpr std::size_t kMostFollowers = 24;
constexpr double kMostRatio = 20;  // of a step's frequency as edited to that as learned
constexpr double kMostBalanceSecs = 10, kBalanceNow = 0.3, kBalanceAhead = 0.2;  // the latter a second
constexpr int kSweeps = 2;  // of the look-ahead, each time an instance was chosen; values are kept between

}  // namespace

InstanceWalk::InstanceWalk(const MotionTexture& model, const SynthesizeOptions& options, std::vector<int> path,
                           bool endless)
    : model_(model),
      key_poses_(options.key_poses),
      path_(std::move(path)),
      endless_(endless),
      rng_(Rng(options.seed).fork(1)),
      tau_(options.nearness * usual_jump_distance(model)),
      texton_allowed_(model.textons.size(), false),
      freshness_(model.instances.size(), 1),
      value_(model.instances.size(), 1) {
  for (const int texton : path_) check_playable(model, texton);
  std::vector<int> danced = danced_textons(model);
  if (danced.empty()) danced = {model.instances.front().texton};
  for (const int texton : danced) texton_allowed_[static_cast<std::size_t>(texton)] = true;
  for (int i = 0; i < static_cast<int>(model.instances.size()); ++i) {
    const int texton = model.instances[static_cast<std::size_t>(i)].texton;
    if (texton_allowed_[static_cast<std::size_t>(texton)]) allowed_.push_back(i);
  }
  for (int i = 0; i < static_cast<int>(model.instances.size()); ++i) followers_.push_back(followers_of(i));
  lead_into_every_part();
  liveliness_ = liveliness(model, allowed_);
}

/// What starts a clip may follow nothing, and may lie near no end; so may a part that leads to itself alone. The
/// nearest possible end is made to lead there, until there is a way from every instance to every other.
void InstanceWalk::lead_into_every_part() {
  for (bool is_led = true; is_led;) {
    is_led = false;
    Graph graph(static_cast<int>(followers_.size()));
    for (const int a : allowed_)
      for (const Follower& b : followers_[static_cast<std::size_t>(a)]) graph.add_edge(a, b.instance);
    const Components parts = strongly_connected_components(graph);
    const auto part_of = [&](int i) {
      return static_cast<std::size_t>(parts.component_of[static_cast<std::size_t>(i)]);
    };
    std::vector<bool> is_entered(parts.members.size(), false);
    for (const int a : allowed_)
      for (const Follower& b : followers_[static_cast<std::size_t>(a)])
        if (part_of(b.instance) != part_of(a)) is_entered[part_of(b.instance)] = true;
    for (std::size_t k = 0; k < parts.members.size(); ++k)
      if (!is_entered[k] && lead_into(parts.members[k])) is_led = true;
  }
}

bool InstanceWalk::lead_into(const std::vector<int>& part) {
  double best = std::numeric_limits<double>::infinity();
  int from = -1, to = -1;
  for (const int b : part) {
    if (!std::binary_search(allowed_.begin(), allowed_.end(), b)) return false;
    for (const int a : allowed_) {
      if (transition(a, b) <= 0 || std::binary_search(part.begin(), part.end(), a)) continue;
      const double d = distance(a, b);
      if (d < best) best = d, from = a, to = b;
    }
  }
  if (from < 0) return false;
  followers_[static_cast<std::size_t>(from)].push_back({to, transition(from, to) * std::exp(-kFarthest)});
  return true;
}

double InstanceWalk::transition(int from, int to) const {
  return model_.transitions.probability(model_.instances[static_cast<std::size_t>(from)].texton,
                                        model_.instances[static_cast<std::size_t>(to)].texton);
}

double InstanceWalk::preference(int from, int to) const {
  if (model_.visit_ratios.empty()) return 1;
  const double before = model_.unweighted.probability(model_.instances[static_cast<std::size_t>(from)].texton,
                                                      model_.instances[static_cast<std::size_t>(to)].texton);
  return before > 0 ? transition(from, to) / before : 1;
}

double InstanceWalk::fading(int from, int to) const {
  if (model_.visit_ratios.empty() || from < 0) return 0.5;
  const int texton = model_.instances[static_cast<std::size_t>(from)].texton;
  const double r = model_.visit_ratios[static_cast<std::size_t>(texton)] * preference(from, to);
  if (!(r > 0)) return 0.5;  // a forbidden step that a path asked for
  return std::pow(0.5, 1 / std::clamp(r, 1 / kMostRatio, kMostRatio));
}

double InstanceWalk::distance(int from, int to) const {
  if (key_poses_ == KeyPoses::kRandom) return 0;
  return key_pose_distance(model_.corpus, hand_over_row(model_, model_.instances[static_cast<std::size_t>(from)]),
                           model_.instances[static_cast<std::size_t>(to)].row);
}

std::vector<InstanceWalk::Follower> InstanceWalk::followers_of(int instance) const {
  struct Candidate {
    double distance, transition;
    int instance;
  };
  std::vector<Candidate> candidates;
  for (const int b : allowed_) {
    const double m = transition(instance, b);
    if (m > 0) candidates.push_back({distance(instance, b), m, b});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& x, const auto& y) { return x.distance < y.distance; });
  std::vector<Follower> out;
  std::vector<bool> has_texton(model_.textons.size(), false);
  const auto most = key_poses_ == KeyPoses::kNearest ? kMostFollowers : candidates.size();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Candidate& c = candidates[k];
    const int texton = model_.instances[static_cast<std::size_t>(c.instance)].texton;
    const bool is_near = k < most && (k < 2 || c.distance <= kFarthest * tau_);
    if (!is_near && (has_texton[static_cast<std::size_t>(texton)] || preference(instance, c.instance) <= 1)) continue;
    has_texton[static_cast<std::size_t>(texton)] = true;
    const double farther = c.distance - candidates[0].distance;
    out.push_back(
        {c.instance, c.transition * std::exp(-(is_near ? farther : std::min(farther, kFarthest * tau_)) / tau_)});
  }
  return out;
}

void InstanceWalk::look_ahead() {
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t b = value_.size(); b-- > 0;) {
      double best = 0;
      for (const Follower& c : followers_[b]) best = std::max(best, value_[static_cast<std::size_t>(c.instance)]);
      const double own = freshness_[b] * std::exp(-kBalanceAhead * balance_ * liveliness_[b]);
      value_[b] = std::max(own, kPatience * best);
    }
}

int InstanceWalk::choose_endless(const Taste& taste) {
  if (current_ < 0) return allowed_[rng_.below(allowed_.size())];
  const auto& followers = followers_[static_cast<std::size_t>(current_)];
  if (followers.empty()) return allowed_[rng_.below(allowed_.size())];
  double freshest = 0;
  for (const Follower& b : followers) freshest = std::max(freshest, value_[static_cast<std::size_t>(b.instance)]);
  std::vector<double> weights;
  for (const Follower& b : followers)
    weights.push_back(
        b.weight *
        std::pow(value_[static_cast<std::size_t>(b.instance)] / freshest, taste ? kSteeredCuriosity : kCuriosity) *
        std::exp(-kBalanceNow * balance_ * liveliness_[static_cast<std::size_t>(b.instance)]) *
        (taste ? taste(b.instance) : 1));
  return followers[rng_.weighted(weights)].instance;
}

int InstanceWalk::choose_of_texton(int texton) {
  const auto& among = model_.textons[static_cast<std::size_t>(texton)].instances;
  if (current_ < 0) return among[rng_.below(among.size())];
  std::vector<double> distances, weights;
  for (const int b : among) distances.push_back(distance(current_, b));
  const double nearest = *std::min_element(distances.begin(), distances.end());
  for (const double d : distances) weights.push_back(std::exp(-(d - nearest) / tau_));
  return among[rng_.weighted(weights)];
}

int InstanceWalk::next(const Taste& taste) {
  before_ = {current_, path_done_, balance_};
  if (path_done_ < path_.size())
    current_ = choose_of_texton(path_[path_done_++]);
  else if (endless_)
    current_ = choose_endless(taste);
  else
    return -1;
  const double secs =
      static_cast<double>(model_.instances[static_cast<std::size_t>(current_)].length) * model_.frame_time_secs();
  balance_ = std::clamp(balance_ + liveliness_[static_cast<std::size_t>(current_)] * secs, -kMostBalanceSecs,
                        kMostBalanceSecs);
  double& fresh = freshness_[static_cast<std::size_t>(current_)];
  fresh *= fading(before_.current, current_);
  if (fresh < 1e-9)  // long ago counts less: what was played more than 30 times oftener than others starts anew
    for (double& f : freshness_) f = std::min(1.0, f * 1e6);
  look_ahead();
  return current_;
}

void InstanceWalk::take_back() {
  if (current_ >= 0) freshness_[static_cast<std::size_t>(current_)] /= fading(before_.current, current_);
  current_ = before_.current, path_done_ = before_.path_done, balance_ = before_.balance;
}

std::vector<std::vector<int>> InstanceWalk::followers() const {
  std::vector<std::vector<int>> out(followers_.size());
  for (std::size_t a = 0; a < followers_.size(); ++a)
    for (const Follower& b : followers_[a]) out[a].push_back(b.instance);
  return out;
}

void InstanceWalk::lead(std::vector<int> path) {
  path_ = std::move(path);
  path_done_ = 0;
  before_.path_done = 0;
}

}  // namespace motex
