// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/choreography_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "motex/core/rng.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/liveliness.h"

namespace motex {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostFollowers = 24, kLeastPredecessors = 4;
constexpr double kMostCells = 1e8;
constexpr double kVariation = 6;
constexpr double kRepeatCost = 2;  // of an example that follows itself: what is likeliest must not stand still

std::size_t at(int instance) { return static_cast<std::size_t>(instance); }

/// Rows of the corpus played in first … last frames.
struct Source {
  Index row = 0, length = 0;
  Index shortest = 1, longest = 0;
};

Source stretched(Index row, Index length, double stretch, Index least) {
  const auto n = static_cast<double>(length);
  if (length < 4) return {row, length, length, length};
  return {row, length, std::max({Index{4}, least, static_cast<Index>(std::ceil(n / (1 + stretch) - 1e-9))}),
          static_cast<Index>(n * (1 + stretch) + 1e-9)};
}

}  // namespace

/// Tables over (node, frames so far). Nodes: the instances, and one more for the rest of the one that holds the start.
struct ChoreographyPlanner::Search {
  Search(const ChoreographyPlanner& planner, const Edges& edges, const PlanRequest& wanted, Index horizon);

  void fill(const JobContext& job);
  double cost_of(Index frames) const { return finish(frames).cost; }
  Plan trace(Index frames) const;

 private:
  /// How the last segment ends at the end poses.
  struct Finish {
    double cost = kNever;
    int node = -1;
    bool is_exit = false;  ///< the beginning of the instance that holds the end frame; else `node` in full, bent
    Index length = 0;      ///< of the exit; 2: nothing of it is played
  };
  void draw_extra_costs();
  void prepare_rest();
  void prepare_exit();
  Finish finish(Index frames) const;
  std::size_t cell(int node, Index frames) const {
    return static_cast<std::size_t>(frames) * sources_.size() + at(node);
  }
  double& begun(int node, Index frames) { return begun_[cell(node, frames)]; }
  double begun(int node, Index frames) const { return begun_[cell(node, frames)]; }
  double& done(int node, Index frames) { return done_[cell(node, frames)]; }
  double done(int node, Index frames) const { return done_[cell(node, frames)]; }
  double best_length(int node, Index frames, Index& length) const;
  double best_predecessor(int node, Index frames, Edge& edge) const;
  double edge_cost(const Edge& edge, int to) const {
    return -edge.log_prob + edge.distance / tau_ + (instance_of(edge.from) == to ? kRepeatCost : 0);
  }
  double pace_cost(const Source& source, Index length) const {
    return motex::pace_cost(source.length, length, wanted_.stretch);
  }
  double bend_distance(int node) const { return distance_to(wanted_.start, source(node).row); }
  double distance_to(const PlanPoses& poses, Index row) const { return pose_distance(model_, poses.features, row); }
  double end_distance(int node) const;
  const Source& source(int node) const { return sources_[at(node)]; }
  int instance_of(int node) const { return node == rest_ ? rest_instance_ : node; }

  const MotionTexture& model_;
  const Edges& predecessors_;
  const PlanRequest& wanted_;
  double tau_;
  Index min_frames_, least_bent_;
  Index horizon_;
  std::size_t width_;
  int rest_;
  int rest_instance_ = -1;
  bool has_rest_ = false, rest_can_bend_ = false;
  Source exit_;
  bool rest_is_exit_ = false;  ///< start and end lie in one instance
  int exit_instance_ = -1;
  std::vector<Source> sources_;
  const std::vector<double>& liveliness_;
  std::vector<double> extra_;  ///< by instance: PlanRequest::variation and liveliness
  std::vector<double> begun_, done_;
};

ChoreographyPlanner::Search::Search(const ChoreographyPlanner& planner, const Edges& edges, const PlanRequest& wanted,
                                    Index horizon)
    : model_(planner.model_),
      predecessors_(edges),
      wanted_(wanted),
      tau_(planner.tau_ * wanted.nearness),
      min_frames_(planner.min_frames_),
      least_bent_(std::max<Index>(8, planner.min_frames_ / 2)),
      horizon_(horizon),
      width_(static_cast<std::size_t>(horizon + 1)),
      rest_(static_cast<int>(model_.instances.size())),
      liveliness_(planner.liveliness_) {
  for (const Instance& a : model_.instances)
    sources_.push_back(stretched(a.row, hand_over_row(model_, a) + 2 - a.row, wanted.stretch, min_frames_));
  draw_extra_costs();
  prepare_rest();
  prepare_exit();
  if (static_cast<double>(width_) * static_cast<double>(sources_.size()) > kMostCells)
    throw InvalidInput("planning " + std::to_string(wanted.num_frames) + " frames over " +
                       std::to_string(model_.instances.size()) +
                       " examples at once takes too much memory; divide the way by poses in between");
}

void ChoreographyPlanner::Search::draw_extra_costs() {
  extra_.assign(model_.instances.size(), 0);
  Rng rng(wanted_.variation);
  if (wanted_.variation != 0)
    for (double& extra : extra_) extra = kVariation * rng.uniform();
  for (std::size_t b = 0; b < extra_.size(); ++b)
    extra_[b] -=
        wanted_.liveliness * liveliness_[b] * static_cast<double>(sources_[b].length) * model_.frame_time_secs();
}

/// A rest too short to play goes on into the instance after it.
void ChoreographyPlanner::Search::prepare_rest() {
  if (wanted_.start.row < 0) {
    sources_.push_back({});
    return;
  }
  rest_instance_ = instance_at(model_, wanted_.start.row);
  const auto end_of = [&](int i) { return hand_over_row(model_, model_.instances[at(i)]) + 2; };
  const auto follows = [&](int i) {
    return i + 1 < rest_ && model_.instances[at(i + 1)].run_idx == model_.instances[at(i)].run_idx;
  };
  if (end_of(rest_instance_) - wanted_.start.row < 4 && follows(rest_instance_)) ++rest_instance_;
  const Index length = end_of(rest_instance_) - wanted_.start.row;
  has_rest_ = length >= 4;
  rest_can_bend_ = length >= least_bent_;
  sources_.push_back(stretched(wanted_.start.row, length, wanted_.stretch, rest_can_bend_ ? least_bent_ : Index{0}));
}

void ChoreographyPlanner::Search::prepare_exit() {
  if (wanted_.end.row < 0) return;
  exit_instance_ = instance_at(model_, wanted_.end.row);
  const Index row = model_.instances[at(exit_instance_)].row;
  exit_ = stretched(row, wanted_.end.row + 2 - row, wanted_.stretch, 0);
  rest_is_exit_ = wanted_.end.row >= wanted_.start.row &&
                  (rest_instance_ == exit_instance_ || instance_at(model_, wanted_.start.row) == exit_instance_);
}

double ChoreographyPlanner::Search::end_distance(int node) const {
  return distance_to(wanted_.end, source(node).row + source(node).length - 2);
}

double ChoreographyPlanner::Search::best_length(int node, Index frames, Index& length) const {
  double best = kNever;
  const Source& s = source(node);
  for (Index l = s.shortest; l <= std::min(s.longest, frames + 2); ++l) {
    const double before = begun(node, frames + 2 - l);
    if (before == kNever) continue;
    const double cost = before + pace_cost(s, l);
    if (cost < best) best = cost, length = l;
  }
  return best;
}

double ChoreographyPlanner::Search::best_predecessor(int node, Index frames, Edge& edge) const {
  double best = kNever;
  for (const Edge& e : predecessors_[at(node)]) {
    const double cost = done(e.from, frames) + edge_cost(e, node);
    if (cost < best) best = cost, edge = e;
  }
  const double rest_cost = done(rest_, frames);
  if (rest_cost == kNever) return best;
  const bool follows =
      node == rest_instance_ + 1 && model_.instances[at(node)].run_idx == model_.instances[at(rest_instance_)].run_idx;
  if (!rest_can_bend_ && !follows) return best;
  const double log_prob =
      model_.transitions.log_prob(model_.instances[at(rest_instance_)].texton, model_.instances[at(node)].texton);
  if (!std::isfinite(log_prob)) return best;
  const Edge e{rest_, key_pose_distance(model_.corpus, source(rest_).row + source(rest_).length - 2, source(node).row),
               log_prob};
  if (rest_cost + edge_cost(e, node) < best) best = rest_cost + edge_cost(e, node), edge = e;
  return best;
}

void ChoreographyPlanner::Search::fill(const JobContext& job) {
  begun_.assign(width_ * sources_.size(), kNever);
  done_.assign(width_ * sources_.size(), kNever);
  for (int b = 0; b < rest_; ++b) begun(b, 0) = kBend * bend_distance(b) / tau_ + kJumpCost + extra_[at(b)];
  if (has_rest_) begun(rest_, 0) = 0;
  for (Index f = 1; f <= horizon_; ++f) {
    job.check_cancelled();
    Index length = 0;
    Edge edge;
    for (int node = 0; node <= rest_; ++node) done(node, f) = best_length(node, f, length);
    for (int node = 0; node < rest_; ++node) begun(node, f) = best_predecessor(node, f, edge) + extra_[at(node)];
  }
}

ChoreographyPlanner::Search::Finish ChoreographyPlanner::Search::finish(Index frames) const {
  Finish best;
  const auto consider = [&](double cost, int node, bool is_exit, Index length) {
    if (cost < best.cost) best = {cost, node, is_exit, length};
  };
  for (Index l = exit_.shortest; l <= std::min(exit_.longest, frames + 2); ++l) {
    const Index before = frames + 2 - l;
    if (before > 0 || l >= least_bent_)
      consider(begun(exit_instance_, before) + pace_cost(exit_, l), exit_instance_, true, l);
  }
  if (rest_is_exit_) {
    const Source way = stretched(wanted_.start.row, wanted_.end.row + 2 - wanted_.start.row, wanted_.stretch, 0);
    const Index l = frames + 2;
    if (l >= way.shortest && l <= way.longest) consider(pace_cost(way, l), rest_, true, l);
  }
  for (int node = 0; node <= rest_; ++node)
    if ((node != rest_ || rest_can_bend_) && done(node, frames) < best.cost)
      consider(done(node, frames) + kBend * end_distance(node) / tau_ + kJumpCost, node, false, 0);
  return best;
}

Plan ChoreographyPlanner::Search::trace(Index frames) const {
  const Finish end = finish(frames);
  Plan plan;
  plan.cost = end.cost;
  int node = end.node;
  Index row_after = wanted_.end.row, now = frames;
  double distance_after = 0;
  const auto add = [&](int n, Index source_row, Index source_length, Index length, bool is_first) {
    PlannedSegment s;
    s.instance = instance_of(n);
    s.piece = {model_.instances[at(s.instance)].texton,   source_row, source_length,
               is_first ? wanted_.start.row : source_row, row_after,  length};
    s.first_distance = is_first ? distance_to(wanted_.start, source_row) : 0;
    s.last_distance = distance_after;
    plan.segments.insert(plan.segments.begin(), s);
    row_after = source_row;
    now -= length - 2;
  };
  if (end.is_exit) {
    const Index row = node == rest_ ? wanted_.start.row : exit_.row;
    const bool is_first = now == end.length - 2;
    if (end.length > 2 || is_first) add(node, row, wanted_.end.row + 2 - row, end.length, is_first);
    row_after = row;
  } else {
    plan.end_distance = distance_after = end_distance(node);
  }
  bool is_begun = end.is_exit;  // `node` begins at `now`; else it is done by then
  while (now > 0) {
    if (is_begun) {
      Edge edge;
      best_predecessor(node, now, edge);
      plan.cost -= extra_[at(node)];
      plan.log_prob += edge.log_prob;
      distance_after = edge.distance;
      node = edge.from;
    }
    Index length = 0;
    best_length(node, now, length);
    add(node, source(node).row, source(node).length, length, now == length - 2);
    is_begun = true;
  }
  if (is_begun && node != rest_) plan.cost -= extra_[at(node)];
  plan.start_distance = plan.segments.front().first_distance;
  return plan;
}

ChoreographyPlanner::ChoreographyPlanner(const MotionTexture& model)
    : model_(model),
      tau_(usual_jump_distance(model)),
      min_frames_(std::max<Index>(5, std::lround(model.options.min_duration / model.frame_time_secs()))),
      fastest_(fastest_step(model)),
      liveliness_(liveliness(model)),
      edges_(edges(kMostFollowers)) {}

double ChoreographyPlanner::mean_liveliness(const Plan& plan) const {
  double sum = 0, frames = 0;
  for (const PlannedSegment& s : plan.segments) {
    sum += liveliness_[at(s.instance)] * static_cast<double>(s.piece.length);
    frames += static_cast<double>(s.piece.length);
  }
  return frames > 0 ? sum / frames : 0;
}

ChoreographyPlanner::Edges ChoreographyPlanner::edges(std::size_t num_followers) const {
  const int n = static_cast<int>(model_.instances.size());
  const auto cheaper = [&](const Edge& x, const Edge& y) {
    return x.distance / tau_ - x.log_prob < y.distance / tau_ - y.log_prob;
  };
  Edges kept(model_.instances.size()), into(model_.instances.size());
  for (int a = 0; a < n; ++a) {
    const Instance& from = model_.instances[at(a)];
    const Index end = hand_over_row(model_, from);
    struct Follower {
      Edge edge;
      int to;
    };
    std::vector<Follower> followers;
    for (int b = 0; b < n; ++b) {
      const double log_prob = model_.transitions.log_prob(from.texton, model_.instances[at(b)].texton);
      if (!std::isfinite(log_prob)) continue;
      const Edge edge{a, key_pose_distance(model_.corpus, end, model_.instances[at(b)].row), log_prob};
      followers.push_back({edge, b});
      auto& best = into[at(b)];
      best.insert(std::upper_bound(best.begin(), best.end(), edge, cheaper), edge);
      if (best.size() > kLeastPredecessors) best.pop_back();
    }
    std::stable_sort(followers.begin(), followers.end(),
                     [&](const Follower& x, const Follower& y) { return cheaper(x.edge, y.edge); });
    for (std::size_t k = 0; k < followers.size(); ++k)
      if (k < num_followers || (followers[k].to == a + 1 && followers[k].edge.distance == 0))
        kept[at(followers[k].to)].push_back(followers[k].edge);
  }
  for (std::size_t b = 0; b < into.size(); ++b)
    for (const Edge& edge : into[b])
      if (std::none_of(kept[b].begin(), kept[b].end(), [&](const Edge& other) { return other.from == edge.from; }))
        kept[b].push_back(edge);
  return kept;
}

Plan ChoreographyPlanner::plan(const PlanRequest& request, const JobContext& job) const {
  if (request.num_frames < 2) throw InvalidInput("a way from pose to pose has at least 2 frames");
  const Index wanted = request.num_frames - 2;
  const auto search = [&](const Edges& graph) {
    Search found(*this, graph, request, wanted);
    found.fill(job);
    return found.cost_of(wanted) < kNever ? found.trace(wanted) : Plan{{}, kNever, 0, 0, 0};
  };
  Plan best = search(edges_);
  if (best.cost < kNever && request.num_frames > 2 * min_frames_) return best;
  const ChoreographyBridge bridge(model_, request, tau_ * request.nearness, fastest_);
  if (request.num_frames <= 2 * min_frames_) {
    Plan bridged = bridge.plan(request.num_frames);
    if (bridged.cost < best.cost) best = std::move(bridged);
  }
  if (best.cost == kNever) best = search(edges(model_.instances.size()));
  if (best.cost == kNever) best = bridge.plan(request.num_frames);
  if (best.cost == kNever) throw_nearest(request, bridge, job);
  return best;
}

void ChoreographyPlanner::throw_nearest(const PlanRequest& request, const ChoreographyBridge& bridge,
                                        const JobContext& job) const {
  const Index wanted = request.num_frames - 2;
  Index longest = 0;
  for (const Instance& a : model_.instances) longest = std::max(longest, a.length);
  const Index horizon = wanted + 2 * longest + 2;
  Search search(*this, edges_, request, horizon);
  search.fill(job);
  const auto works = [&](Index frames) {
    return frames >= 0 && frames <= horizon &&
           (search.cost_of(frames) < kNever ||
            (frames + 2 >= bridge.least_frames() && frames + 2 <= bridge.most_frames()));
  };
  for (Index away = 1; away <= horizon; ++away)
    for (const Index frames : {wanted - away, wanted + away})
      if (works(frames))
        throw InvalidInput("nothing in the model leads from these poses to those in " +
                           std::to_string(request.num_frames) + " frames; the nearest that works is " +
                           std::to_string(frames + 2) + " frames");
  throw InvalidInput("nothing in the model leads from these poses to those");
}

}  // namespace motex
