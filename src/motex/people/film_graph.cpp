// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/film_graph.h"

#include <algorithm>
#include <string>

#include "motex/core/error.h"
#include "motex/markov/future_cost.h"
#include "motex/people/cut_smoothness.h"

namespace motex {
namespace {

constexpr double kSmoothEnough = 1.2, kJolt = 40;

std::vector<char> marked(const std::vector<int>& nodes, std::size_t count) {
  std::vector<char> mark(count, 0);
  if (nodes.size() < 2) return mark;
  for (const int node : nodes) mark[static_cast<std::size_t>(node)] = 1;
  return mark;
}

}  // namespace

FilmGraph::FilmGraph(const PeopleTexture& texture, int min_shot, int transition_frames)
    : min_shot_(std::max(1, min_shot)) {
  const std::vector<int> take_of = take_of_frames(texture);
  const std::size_t n = take_of.size();
  for (const int take : take_of)
    last_of_take_.push_back(texture.takes[static_cast<std::size_t>(take)].frames.end() - 1);
  std::vector<std::vector<Jump>> from(n);
  const std::vector<Cut>& cuts = texture.cuts.cuts;
  const SecondDifferenceScales scales = second_difference_scales(texture);
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    Cut cut = cuts[k];
    if (cut.from < 0 || cut.to < 0 || cut.from >= num_frames() || cut.to >= num_frames())
      throw InvalidInput("cut " + std::to_string(k) + " joins frames that are not there");
    if (cut.to + min_shot_ - 1 > last_of_take(cut.to)) continue;
    if (transition_frames > 0)
      cut.smoothness = std::max(cut.smoothness,
                                transition_smoothness(texture, scales, cut.from, cut.to, transition_frames).largest());
    from[static_cast<std::size_t>(cut.from)].push_back(
        {cut.to, static_cast<int>(k), cost_of_cut(cut, texture.cuts.natural_difference)});
  }
  for (const std::vector<Jump>& jumps : from) {
    jump_begin_.push_back(jumps_.size());
    jumps_.insert(jumps_.end(), jumps.begin(), jumps.end());
  }
  jump_begin_.push_back(jumps_.size());
  // A jump leads to the last of the frames that must be played after it, so that every path keeps min_shot.
  Graph graph(num_frames());
  for (int frame = 0; frame < num_frames(); ++frame) {
    if (goes_on(frame)) graph.add_edge(frame, frame + 1, 0);
    for (const Jump& jump : jumps(frame)) graph.add_edge(frame, jump.to + min_shot_ - 1, jump.cost);
  }
  future_cost_ = future_costs(graph);
  if (n > 0) endless_ = marked(strongly_connected_components(graph).largest(), n);
}

double FilmGraph::endless_share() const {
  const auto num = std::count(endless_.begin(), endless_.end(), 1);
  return endless_.empty() ? 0 : static_cast<double>(num) / static_cast<double>(endless_.size());
}

double cost_of_cut(const Cut& cut, double natural_difference) {
  const double difference = cut.difference / std::max(natural_difference / 2, 8.0);
  return 1 + difference * difference + cut.smoothness * cut.smoothness +
         kJolt * std::max(0.0, cut.smoothness - kSmoothEnough);
}

}  // namespace motex
