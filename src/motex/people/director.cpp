// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/director.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/people/direct.h"

namespace motex {
namespace {

constexpr double kWindowSecs = 2;     // in which a cut is looked for
constexpr double kTemperature = 0.5;  // of the choice among cuts, in units of cost_of_cut()
constexpr double kForgetSecs = 10;    // after which frames may well be shown again
constexpr double kShownLately = 4;    // what it costs to show them at once again
constexpr double kDiscount = 0.995;
constexpr double kTrim = 0.1;  // of an occurrence that may be missing at each end

const PlayOptions& checked(const PlayOptions& options) {
  check_options(options);
  return options;
}

}  // namespace

Director::Director(const PeopleTexture& texture, const PlayOptions& options)
    : texture_(texture),
      options_(checked(options)),
      graph_(texture, min_shot_frames(options, texture.frames_per_sec), options.transition_frames),
      rng_(options.seed),
      last_shown_(static_cast<std::size_t>(texture.num_frames()), -1'000'000) {
  std::vector<int> beginnings;
  for (const bool idle : {true, false}) {
    std::vector<char> mark(last_shown_.size(), idle ? 0 : 1);
    for (const FrameSpan& span : texture.alphabet.idle)
      for (int t = span.start; idle && t < std::min(span.end(), texture.num_frames()); ++t)
        mark[static_cast<std::size_t>(t)] = 1;
    for (int t = 0; t < texture.num_frames(); ++t)
      if (mark[static_cast<std::size_t>(t)] && graph_.is_endless(t)) beginnings.push_back(t);
    if (!beginnings.empty()) break;
  }
  if (beginnings.empty())
    throw InvalidInput(
        "the footage cannot be played for ever: no cut leads back to where it was; learn from more "
        "footage of repeated actions");
  frame_ = beginnings[rng_.below(beginnings.size())];
  FilmPlanner planner(texture, graph_);
  for (int motif = 0; motif < static_cast<int>(texture.alphabet.motifs.size()); ++motif) {
    const std::vector<PerformanceWay>& ways = planner.ways(motif);
    performable_.push_back(std::any_of(ways.begin(), ways.end(), [&](const PerformanceWay& way) {
      return graph_.is_endless(way.pieces.front().first) && graph_.is_endless(way.pieces.back().last);
    }));
  }
  planned_.push_back({frame_});
  time_ = 1;
  cut_at_ = std::llround(options_.shot_secs * texture.frames_per_sec * rng_.uniform(0.5, 1.5));
}

DirectedFrame Director::next() {
  if (planned_.empty()) plan();
  const DirectedFrame frame = planned_.front();
  planned_.pop_front();
  return frame;
}

void Director::choose(int motif) {
  if (motif < 0 || motif >= static_cast<int>(texture_.alphabet.motifs.size()))
    throw InvalidInput("there is no motif " + std::to_string(motif) + "; there are " +
                       alphabet_text(texture_.alphabet));
  if (!performable_[static_cast<std::size_t>(motif)])
    throw InvalidInput("no cuts lead to '" + texture_.alphabet.motifs[static_cast<std::size_t>(motif)].letter +
                       "' and on from there");
  choices_.push_back(motif);
}

void Director::plan() {
  while (!choices_.empty()) {
    const int motif = choices_.front();
    choices_.pop_front();
    if (plan_choice(motif)) return;
  }
  plan_free();
}

bool Director::plan_choice(int motif) {
  int wait = static_cast<int>(std::lround(options_.max_latency_secs * texture_.frames_per_sec));
  FilmPlanner planner(texture_, graph_);
  const std::vector<FilmState> here{{frame_, 0, 0, -1}};
  for (;; wait = std::min(2 * std::max(wait, 8), texture_.num_frames())) {
    for (const FilmState& state : planner.go_on_to_motif(here, motif, 0, wait)) {
      if (!graph_.is_endless(state.frame)) continue;
      // A cut that lands on the very beginning has a piece of its own without frames.
      int carried = -1;
      std::deque<DirectedFrame> frames;
      for (const FilmPiece& piece : planner.pieces_of(state)) {
        carried = piece.cut >= 0 ? piece.cut : carried;
        for (int t = piece.first; t <= piece.last; ++t, carried = -1)
          frames.push_back({t, carried, piece.step >= 0 ? motif : -1, piece.step >= 0 ? num_performed_ : -1});
      }
      planned_ = std::move(frames);
      ++num_performed_;
      for (const DirectedFrame& frame : planned_) last_shown_[static_cast<std::size_t>(frame.frame)] = time_++;
      frame_ = state.frame;
      cut_at_ = std::max(cut_at_, time_);
      return true;
    }
    if (wait >= texture_.num_frames()) return false;  // not from here, and nobody waits for ever
  }
}

int Director::last_endless(int frame) const {
  while (graph_.goes_on(frame) && graph_.is_endless(frame + 1)) ++frame;
  return frame;
}

void Director::go_on_to(int last) {
  while (frame_ < last) {
    planned_.push_back({++frame_});
    last_shown_[static_cast<std::size_t>(frame_)] = time_++;
  }
}

void Director::jump(const FilmGraph::Jump& jump) {
  planned_.push_back({jump.to, jump.cut});
  frame_ = jump.to;
  last_shown_[static_cast<std::size_t>(frame_)] = time_++;
  go_on_to(jump.to + graph_.min_shot() - 1);
  cut_at_ =
      time_ + std::llround(options_.shot_secs * texture_.frames_per_sec * rng_.uniform(0.5, 1.5)) - graph_.min_shot();
}

void Director::plan_free() {
  const int window = std::max(1, static_cast<int>(std::lround(kWindowSecs * texture_.frames_per_sec)));
  const int last = last_endless(frame_);
  // A cut is not due yet, and there is more to be shown than the window: play on.
  if (last - frame_ > window && time_ < cut_at_) return go_on_to(frame_ + 1);
  std::vector<std::pair<int, FilmGraph::Jump>> ways;
  std::vector<double> costs;
  for (int from = frame_; from <= std::min(last, frame_ + window); ++from)
    for (const FilmGraph::Jump& jump : graph_.jumps(from)) {
      const int landed = jump.to + graph_.min_shot() - 1;
      if (!graph_.is_endless(landed)) continue;
      const double age = static_cast<double>(time_ - last_shown_[static_cast<std::size_t>(landed)]);
      ways.emplace_back(from, jump);
      costs.push_back(jump.cost + kDiscount * graph_.future_cost(landed) +
                      kShownLately * std::exp(-age / (kForgetSecs * texture_.frames_per_sec)));
    }
  if (ways.empty()) return go_on_to(frame_ + 1);
  const double least = *std::min_element(costs.begin(), costs.end());
  for (double& cost : costs) cost = std::exp((least - cost) / kTemperature);
  const auto& [from, way] = ways[rng_.weighted(costs)];
  go_on_to(from);
  jump(way);
}

EditList edit_list_of_frames(const PeopleTexture& texture, const std::vector<DirectedFrame>& frames,
                             int transition_frames) {
  std::vector<FilmPiece> pieces;
  std::vector<int> motif_of_step;
  for (const DirectedFrame& frame : frames) {
    const int step = frame.performance;
    if (step >= static_cast<int>(motif_of_step.size())) motif_of_step.resize(static_cast<std::size_t>(step) + 1);
    if (step >= 0) motif_of_step[static_cast<std::size_t>(step)] = frame.motif;
    if (!pieces.empty() && frame.cut < 0 && pieces.back().step == step)
      pieces.back().last = frame.frame;
    else
      pieces.push_back({frame.frame, frame.frame, frame.cut, step});
  }
  return edit_list_of(texture, pieces, motif_of_step, transition_frames);
}

EditList play(const PeopleTexture& texture, int num_frames, const PlayOptions& options) {
  if (num_frames < 1) throw InvalidInput("a film has one frame at least");
  Director director(texture, options);
  std::vector<DirectedFrame> frames;
  frames.reserve(static_cast<std::size_t>(num_frames));
  for (int t = 0; t < num_frames; ++t) frames.push_back(director.next());
  EditList edits = edit_list_of_frames(texture, frames, options.transition_frames);
  int time = 0;
  for (Shot& shot : edits.shots) {
    for (std::size_t k = 0; k < texture.alphabet.motifs.size(); ++k)
      for (const Occurrence& o : texture.alphabet.motifs[k].occurrences) {
        const int trim = static_cast<int>(kTrim * o.length), first = o.start + trim,
                  last = o.start + o.length - 1 - trim;
        if (first < shot.first || last > shot.last) continue;
        edits.performances.push_back({static_cast<int>(k), time + first - shot.first, last - first + 1});
        if (shot.motif < 0) shot.motif = static_cast<int>(k);
      }
    time += shot.last - shot.first + 1;
  }
  std::stable_sort(edits.performances.begin(), edits.performances.end(),
                   [](const Performance& a, const Performance& b) { return a.start < b.start; });
  return edits;
}

}  // namespace motex
