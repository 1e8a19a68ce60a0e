// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/film_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motex {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kNothing = -1, kInTake = -2, kFirstSource = -3;  // how a state was come to; a cut has its number
constexpr double kTrim = 0.1;                                  // of an occurrence that may be missing at each end
constexpr double kPhaseStep = 0.15;                            // a fork may leap over that much of an action
constexpr double kBeatSlack = 1, kBeatReach = 8;
constexpr double kWorthKeeping = 15;  // costs above the best
constexpr std::size_t kMaxStates = 4000;

}  // namespace

/// Cost and predecessor of having played frame t, `row` frames after the earliest state.
struct FilmPlanner::Waiting {
  int base = 0, rows = 0, columns = 0;
  std::vector<float> cost;
  std::vector<int> came;

  std::size_t at(int row, int frame) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(frame);
  }
  void offer(int row, int frame, double new_cost, int how) {
    const std::size_t i = at(row, frame);
    if (static_cast<float>(new_cost) < cost[i]) cost[i] = static_cast<float>(new_cost), came[i] = how;
  }
};

FilmPlanner::FilmPlanner(const PeopleTexture& texture, const FilmGraph& graph, std::vector<double> beats,
                         const PlanCosts& costs)
    : texture_(texture), graph_(graph), beats_(std::move(beats)), costs_(costs) {
  const auto n = static_cast<std::size_t>(graph.num_frames());
  idle_.assign(n, 0);
  std::vector<char> busy(n, 0);
  const auto mark = [&](std::vector<char>& mask, int start, int end) {
    for (int t = std::max(start, 0); t < std::min(end, graph.num_frames()); ++t) mask[static_cast<std::size_t>(t)] = 1;
  };
  for (const FrameSpan& span : texture.alphabet.idle) mark(idle_, span.start, span.end());
  for (const Motif& motif : texture.alphabet.motifs)
    for (const Occurrence& o : motif.occurrences) mark(busy, o.start, o.start + o.length);
  wait_sum_.push_back(0);
  for (std::size_t t = 0; t < n; ++t)
    wait_sum_.push_back(wait_sum_.back() + (busy[t] && !idle_[t] ? costs.detour_per_sec : costs.wait_per_sec) /
                                               std::max(texture.frames_per_sec, 1.0));
  landings_.resize(n);
  for (int frame = 0; frame < graph.num_frames(); ++frame)
    for (const FilmGraph::Jump& jump : graph.jumps(frame))
      landings_[static_cast<std::size_t>(jump.to)].push_back({frame, jump.cut, jump.cost});
}

double FilmPlanner::beat_distance(double film_frame) const {
  if (beats_.empty()) return 0;
  const auto next = std::lower_bound(beats_.begin(), beats_.end(), film_frame);
  double distance = std::numeric_limits<double>::infinity();
  if (next != beats_.end()) distance = *next - film_frame;
  if (next != beats_.begin()) distance = std::min(distance, film_frame - *std::prev(next));
  return distance;
}

double FilmPlanner::beat_cost(double film_frame) const {
  if (beats_.empty() || film_frame > beats_.back() + kBeatReach) return 0;
  return costs_.off_beat * std::clamp((beat_distance(film_frame) - kBeatSlack) / (kBeatReach - kBeatSlack), 0.0, 1.0);
}

double FilmPlanner::wait_cost(int first, int end) const {
  return wait_sum_[static_cast<std::size_t>(end)] - wait_sum_[static_cast<std::size_t>(first)];
}

bool FilmPlanner::is_idle(int first, int end) const {
  return std::all_of(idle_.begin() + first, idle_.begin() + end, [](char idle) { return idle != 0; });
}

int FilmPlanner::append(int parent, const FilmPiece& piece) {
  nodes_.push_back({piece, parent});
  return static_cast<int>(nodes_.size()) - 1;
}

std::vector<FilmPiece> FilmPlanner::pieces_of(const FilmState& state) const {
  std::vector<FilmPiece> pieces;
  for (int node = state.end; node >= 0; node = nodes_[static_cast<std::size_t>(node)].parent)
    pieces.push_back(nodes_[static_cast<std::size_t>(node)].piece);
  std::reverse(pieces.begin(), pieces.end());
  return pieces;
}

FilmPlanner::Waiting FilmPlanner::wait(const std::vector<FilmState>& from, int max_wait) const {
  Waiting waiting;
  waiting.columns = graph_.num_frames();
  waiting.base = std::min_element(from.begin(), from.end(), [](auto& a, auto& b) { return a.time < b.time; })->time;
  const int latest = std::max_element(from.begin(), from.end(), [](auto& a, auto& b) { return a.time < b.time; })->time;
  // Without beats nothing depends on when things happen: all states count as of the same time.
  waiting.rows = (beats_.empty() ? 0 : latest - waiting.base) + max_wait + 1;
  const std::size_t size = waiting.at(waiting.rows, 0);
  waiting.cost.assign(size, kInfinity);
  waiting.came.assign(size, kNothing);
  for (std::size_t k = 0; k < from.size(); ++k)
    waiting.offer(beats_.empty() ? 0 : from[k].time - waiting.base, from[k].frame, from[k].cost,
                  kFirstSource - static_cast<int>(k));
  const int after = graph_.min_shot() - 1;
  for (int row = 0; row + 1 < waiting.rows; ++row)
    for (int t = 0; t < waiting.columns; ++t) {
      const double cost = waiting.cost[waiting.at(row, t)];
      if (!std::isfinite(cost)) continue;
      if (graph_.goes_on(t)) waiting.offer(row + 1, t + 1, cost + wait_cost(t + 1, t + 2), kInTake);
      if (row + 1 + after >= waiting.rows) continue;
      const double off_beat = beat_cost(waiting.base + row);
      for (const FilmGraph::Jump& jump : graph_.jumps(t))
        waiting.offer(row + 1 + after, jump.to + after,
                      cost + jump.cost + off_beat + wait_cost(jump.to, jump.to + after + 1), jump.cut);
    }
  return waiting;
}

void FilmPlanner::enter(const Waiting& waiting, int frame, std::vector<Entry>& entries) const {
  // By time when beats count, else only the cheapest.
  std::map<int, Entry> best;
  const auto offer = [&](const Entry& entry) {
    Entry& old = best[beats_.empty() ? 0 : entry.time];
    if (old.time < 0 || entry.cost < old.cost) old = entry;
  };
  for (int row = 0; row < waiting.rows; ++row) {
    if (frame > 0 && graph_.goes_on(frame - 1)) {
      const double cost = waiting.cost[waiting.at(row, frame - 1)];
      if (std::isfinite(cost)) offer({waiting.base + row, cost, row, frame - 1, -1, frame});
    }
    for (int landed = frame; landed > frame - graph_.min_shot() && landed >= 0; --landed) {
      if (graph_.last_of_take(landed) != graph_.last_of_take(frame) || row + frame - landed >= waiting.rows) break;
      for (const FilmGraph::Jump& jump : landings_[static_cast<std::size_t>(landed)]) {
        const double cost = waiting.cost[waiting.at(row, jump.to)];
        if (!std::isfinite(cost)) continue;
        offer({waiting.base + row + frame - landed,
               cost + jump.cost + beat_cost(waiting.base + row) + wait_cost(landed, frame), row, jump.to, jump.cut,
               landed});
      }
    }
  }
  for (const auto& [time, entry] : best) entries.push_back(entry);
}

int FilmPlanner::trace(const Waiting& waiting, const std::vector<FilmState>& from, int row, int frame) {
  const int after = graph_.min_shot() - 1;
  std::vector<FilmPiece> pieces;
  int last = frame;
  while (true) {
    const int how = waiting.came[waiting.at(row, frame)];
    if (how == kInTake) {
      --row, --frame;
      continue;
    }
    if (how <= kFirstSource) {
      const FilmState& source = from[static_cast<std::size_t>(kFirstSource - how)];
      if (last > source.frame) pieces.push_back({source.frame + 1, last});
      int node = source.end;
      for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) node = append(node, *piece);
      return node;
    }
    const Cut& cut = texture_.cuts.cuts[static_cast<std::size_t>(how)];
    pieces.push_back({cut.to, last, how});
    row -= after + 1;
    frame = last = cut.from;
  }
}

int FilmPlanner::add_entry(const Waiting& waiting, const std::vector<FilmState>& from, const Entry& entry, int frame) {
  const int node = trace(waiting, from, entry.row, entry.frame);
  return entry.cut < 0 ? node : append(node, {entry.landed, frame - 1, entry.cut});
}

const std::vector<PerformanceWay>& FilmPlanner::ways(int motif) {
  const auto known = ways_.find(motif);
  return known != ways_.end() ? known->second : ways_[motif] = find_ways(motif);
}

void FilmPlanner::perform(const PerformanceWay& way, int step, int time, double cost, int parent,
                          std::map<std::pair<int, int>, FilmState>& best) {
  const int frame = way.pieces.back().last, end_time = time + way.length;
  const std::pair key(frame, beats_.empty() ? 0 : end_time);
  const bool forks = way.pieces.size() > 1;
  const int fork = way.pieces.front().last - way.pieces.front().first + 1;
  const double total = cost + way.cost + beat_cost(time + way.accent) + (forks ? beat_cost(time + fork) : 0);
  const auto old = best.find(key);
  if (old != best.end() && old->second.cost <= total) return;
  int node = parent;
  for (FilmPiece piece : way.pieces) {
    piece.step = step;
    node = append(node, piece);
  }
  best[key] = {frame, end_time, total, node};
}

std::vector<FilmState> FilmPlanner::kept(const std::map<std::pair<int, int>, FilmState>& best) {
  std::vector<FilmState> states;
  states.reserve(best.size());
  for (const auto& [key, state] : best) states.push_back(state);
  std::stable_sort(states.begin(), states.end(),
                   [](const FilmState& a, const FilmState& b) { return a.cost < b.cost; });
  while (!states.empty() && states.back().cost > states.front().cost + kWorthKeeping) states.pop_back();
  if (states.size() > kMaxStates) states.resize(kMaxStates);
  return states;
}

std::vector<FilmState> FilmPlanner::begin_with_motif(int motif, int step, const Penalties& penalties) {
  std::map<std::pair<int, int>, FilmState> best;
  for (const PerformanceWay& way : ways(motif)) {
    const auto penalty = penalties.find(way.entered);
    perform(way, step, 0, penalty == penalties.end() ? 0 : penalty->second, -1, best);
  }
  return kept(best);
}

std::vector<FilmState> FilmPlanner::go_on_to_motif(const std::vector<FilmState>& from, int motif, int step,
                                                   int max_wait, const Penalties& penalties) {
  if (from.empty()) return {};
  const Waiting waiting = wait(from, max_wait);
  std::map<int, std::vector<std::pair<Entry, int>>> entered;  // by first frame: how, and the node before it
  std::map<std::pair<int, int>, FilmState> best;
  for (const PerformanceWay& way : ways(motif)) {
    const int frame = way.pieces.front().first;
    if (!entered.contains(frame)) {
      std::vector<Entry> entries;
      enter(waiting, frame, entries);
      for (const Entry& entry : entries) entered[frame].emplace_back(entry, add_entry(waiting, from, entry, frame));
    }
    const auto penalty = penalties.find(way.entered);
    for (const auto& [entry, node] : entered[frame])
      perform(way, step, entry.time, entry.cost + (penalty == penalties.end() ? 0 : penalty->second), node, best);
  }
  return kept(best);
}

std::vector<FilmState> FilmPlanner::go_on_to_frame(const std::vector<FilmState>& from, int frame, int max_wait) {
  if (from.empty()) return {};
  const Waiting waiting = wait(from, max_wait);
  std::vector<Entry> entries;
  enter(waiting, frame, entries);
  std::vector<FilmState> states;
  for (const Entry& entry : entries)
    states.push_back({frame - 1, entry.time, entry.cost, add_entry(waiting, from, entry, frame)});
  std::stable_sort(states.begin(), states.end(),
                   [](const FilmState& a, const FilmState& b) { return a.cost < b.cost; });
  return states;
}

std::vector<FilmState> FilmPlanner::begin_with_idle(int num_frames, int step) {
  std::vector<IdleStart> starts;
  for (int t = 0; t < graph_.num_frames(); ++t)
    if (idle_[static_cast<std::size_t>(t)]) starts.push_back({t, 1, {0, 0, -1, -1, -1, t}});
  return stand(starts, num_frames, step, nullptr, {});
}

std::vector<FilmState> FilmPlanner::go_on_to_idle(const std::vector<FilmState>& from, int num_frames, int step,
                                                  int max_wait) {
  if (from.empty()) return {};
  const Waiting waiting = wait(from, max_wait);
  const int at_once = std::min(graph_.min_shot(), num_frames);
  std::vector<IdleStart> starts;
  for (int t = 0; t < graph_.num_frames(); ++t) {
    if (!idle_[static_cast<std::size_t>(t)]) continue;
    std::vector<Entry> entries;
    enter(waiting, t, entries);
    for (const Entry& entry : entries) {
      const int played = entry.cut < 0 ? 1 : at_once;
      if (t + played - 1 <= graph_.last_of_take(t) && is_idle(t, t + played))
        starts.push_back({t + played - 1, played, entry});
    }
  }
  return stand(starts, num_frames, step, &waiting, from);
}

std::vector<FilmState> FilmPlanner::stand(const std::vector<IdleStart>& starts, int num_frames, int step,
                                          const Waiting* waiting, const std::vector<FilmState>& from) {
  // Row u: u + 1 idle frames have been played. Of equal places the cheapest way in counts, whenever it came.
  Waiting standing;
  standing.rows = num_frames, standing.columns = graph_.num_frames();
  standing.cost.assign(standing.at(num_frames, 0), kInfinity);
  standing.came.assign(standing.cost.size(), kNothing);
  for (std::size_t k = 0; k < starts.size(); ++k)
    standing.offer(starts[k].num_played - 1, starts[k].frame, starts[k].entry.cost, kFirstSource - static_cast<int>(k));
  const int shot = graph_.min_shot();
  // Film frame at which the standing that led to a state began.
  const auto began = [&](int row, int t) {
    int how = standing.came[standing.at(row, t)];
    while (how > kFirstSource) {
      row -= how == kInTake ? 1 : shot;
      t = how == kInTake ? t - 1 : texture_.cuts.cuts[static_cast<std::size_t>(how)].from;
      how = standing.came[standing.at(row, t)];
    }
    return starts[static_cast<std::size_t>(kFirstSource - how)].entry.time;
  };
  for (int row = 0; row + 1 < num_frames; ++row)
    for (int t = 0; t < standing.columns; ++t) {
      const double cost = standing.cost[standing.at(row, t)];
      if (!std::isfinite(cost)) continue;
      if (graph_.goes_on(t) && idle_[static_cast<std::size_t>(t + 1)]) standing.offer(row + 1, t + 1, cost, kInTake);
      if (row + shot >= num_frames) continue;
      const double off_beat = beats_.empty() ? 0 : beat_cost(began(row, t) + row + 1);
      for (const FilmGraph::Jump& jump : graph_.jumps(t))
        if (is_idle(jump.to, jump.to + shot))
          standing.offer(row + shot, jump.to + shot - 1, cost + jump.cost + off_beat, jump.cut);
    }
  std::map<std::pair<int, int>, FilmState> best;
  for (int t = 0; t < standing.columns; ++t) {
    double cost = standing.cost[standing.at(num_frames - 1, t)];
    if (!std::isfinite(cost)) continue;
    std::vector<FilmPiece> pieces;
    int row = num_frames - 1, frame = t, last = t, how = standing.came[standing.at(row, frame)];
    for (; how > kFirstSource; how = standing.came[standing.at(row, frame)]) {
      if (how == kInTake) {
        --row, --frame;
        continue;
      }
      const Cut& cut = texture_.cuts.cuts[static_cast<std::size_t>(how)];
      pieces.push_back({cut.to, last, how, step});
      row -= shot;
      frame = last = cut.from;
    }
    const IdleStart& start = starts[static_cast<std::size_t>(kFirstSource - how)];
    const int first = start.frame - start.num_played + 1;
    int node = waiting == nullptr ? -1 : add_entry(*waiting, from, start.entry, first);
    pieces.push_back({first, last, -1, step});
    for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) node = append(node, *piece);
    best[{t, 0}] = {t, start.entry.time + num_frames, cost, node};
  }
  return kept(best);
}

std::vector<PerformanceWay> FilmPlanner::find_ways(int motif) const {
  const std::vector<Occurrence>& occurrences = texture_.alphabet.motifs[static_cast<std::size_t>(motif)].occurrences;
  struct Core {
    int first, last;
    double phase(int frame) const { return static_cast<double>(frame - first) / std::max(1, last - first); }
  };
  std::vector<Core> cores;
  std::vector<int> core_of(static_cast<std::size_t>(graph_.num_frames()), -1);
  for (const Occurrence& o : occurrences) {
    const int trim = static_cast<int>(kTrim * o.length);
    const Core core{o.start + trim, o.start + o.length - 1 - trim};
    const bool fits = core.first >= 0 && core.last < graph_.num_frames() && core.first <= core.last &&
                      core.last <= graph_.last_of_take(core.first);
    cores.push_back(fits ? core : Core{0, -1});
    for (int t = cores.back().first; t <= cores.back().last; ++t)
      core_of[static_cast<std::size_t>(t)] = static_cast<int>(cores.size()) - 1;
  }
  const auto accent = [&](const Core& core) {
    const auto shape = [&](int t) {
      return std::log(std::max(texture_.silhouettes[static_cast<std::size_t>(t)].aspect(), 1e-3));
    };
    int farthest = core.first;
    const double rest = 0.5 * (shape(core.first) + shape(core.last));
    for (int t = core.first; t <= core.last; ++t)
      if (std::abs(shape(t) - rest) > std::abs(shape(farthest) - rest)) farthest = t;
    return farthest;
  };
  std::map<std::pair<int, int>, PerformanceWay> ways;
  const int shot = graph_.min_shot();
  for (int a = 0; a < static_cast<int>(cores.size()); ++a) {
    const Core& core = cores[static_cast<std::size_t>(a)];
    if (core.first > core.last) continue;
    const int peak = accent(core);
    ways[{a, a}] = {a, a, {{core.first, core.last}}, core.last - core.first + 1, peak - core.first, 0};
    for (int from = core.first + shot - 1; from <= core.last - shot; ++from)
      for (const FilmGraph::Jump& jump : graph_.jumps(from)) {
        const int b = core_of[static_cast<std::size_t>(jump.to)];
        if (b < 0 || b == a) continue;
        const Core& other = cores[static_cast<std::size_t>(b)];
        const double leap = other.phase(jump.to) - core.phase(from);
        if (leap < 0 || leap > kPhaseStep || other.last - jump.to + 1 < shot) continue;
        const auto old = ways.find({a, b});
        if (old != ways.end() && old->second.cost <= jump.cost) continue;
        const int before = from - core.first + 1;
        const int moment = peak <= from ? peak - core.first : before + std::max(0, accent(other) - jump.to);
        ways[{a, b}] = {
            a,      b,        {{core.first, from}, {jump.to, other.last, jump.cut}}, before + other.last - jump.to + 1,
            moment, jump.cost};
      }
  }
  std::vector<PerformanceWay> sorted;
  for (auto& [key, way] : ways) sorted.push_back(std::move(way));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const PerformanceWay& a, const PerformanceWay& b) { return a.cost < b.cost; });
  return sorted;
}

}  // namespace motex
