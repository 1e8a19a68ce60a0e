// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "motex/people/film_graph.h"

namespace motex {

/// Frames first … last in a row; cut: the one that leads to first, −1 = the film just goes on there.
struct FilmPiece {
  int first = 0, last = 0;
  int cut = -1;
  int step = -1;  ///< of the script, while its action is performed
};

/// A film that has been played up to a frame, and what it cost.
struct FilmState {
  int frame = 0;  ///< the last one played
  int time = 0;   ///< frames played
  double cost = 0;
  int end = -1;  ///< its last piece, for FilmPlanner::pieces_of()
};

/// One performance of a motif: entered at the first frame of one occurrence, left at the last of another or the same,
/// with at most one fork between the two where they are alike and as far on. A tenth of an occurrence at each end need
/// not be shown. [PT04] section 3, Figure 5
struct PerformanceWay {
  int entered = 0, left = 0;  ///< occurrences
  std::vector<FilmPiece> pieces;
  int length = 0;  ///< frames
  int accent = 0;  ///< frames from its beginning to where the silhouette is farthest from how it began
  double cost = 0;
};

struct PlanCosts {
  double wait_per_sec = 1;    ///< on the way to what was asked for, standing or moving
  double detour_per_sec = 4;  ///< the same while another action is performed
  double off_beat = 3;        ///< of a cut or an accent eight frames or more from a beat
  double same_again = 3;      ///< an occurrence that was just shown
};

/// Finds the cheapest film from state to state by dynamic programming over frames and time: cuts cost cost_of_cut(),
/// waiting costs time. Exact within the latency limit, up to beats on which idle stretches begin.
class FilmPlanner {
 public:
  /// beats: in film frames, rising; may be empty. texture and graph must outlive the planner.
  FilmPlanner(const PeopleTexture& texture, const FilmGraph& graph, std::vector<double> beats = {},
              const PlanCosts& costs = {});

  /// The ways to perform a motif, cheapest first; none when all occurrences are cut off by the ends of takes.
  const std::vector<PerformanceWay>& ways(int motif);

  /// What a step of a film may cost more: by occurrence of the motif.
  using Penalties = std::map<int, double>;

  /// Films that begin with the motif, or with that many idle frames.
  std::vector<FilmState> begin_with_motif(int motif, int step, const Penalties& penalties = {});
  std::vector<FilmState> begin_with_idle(int num_frames, int step);

  /// Goes on from each state to the end of the motif, or through idle frames, with at most max_wait frames before it
  /// begins. Empty when none can.
  std::vector<FilmState> go_on_to_motif(const std::vector<FilmState>& from, int motif, int step, int max_wait,
                                        const Penalties& penalties = {});
  std::vector<FilmState> go_on_to_idle(const std::vector<FilmState>& from, int num_frames, int step, int max_wait);
  /// Goes on until `frame` could be played next, by a cut or in the take; the pieces end before it, that of a cut has
  /// last = first − 1.
  std::vector<FilmState> go_on_to_frame(const std::vector<FilmState>& from, int frame, int max_wait);

  /// From the beginning.
  std::vector<FilmPiece> pieces_of(const FilmState& state) const;
  double beat_distance(double film_frame) const;  ///< frames; 0 without beats

 private:
  struct Node {
    FilmPiece piece;
    int parent = -1;
  };
  struct Waiting;
  struct Entry {
    int time = -1;  ///< film frames before the entry frame is played
    double cost = 0;
    int row = -1, frame = -1;  ///< state in `Waiting` that it comes from
    int cut = -1, landed = 0;  ///< by which cut, and where; −1 = in the take
  };
  double beat_cost(double film_frame) const;
  double wait_cost(int first, int end) const;
  Waiting wait(const std::vector<FilmState>& from, int max_wait) const;
  void enter(const Waiting& waiting, int frame, std::vector<Entry>& entries) const;
  int trace(const Waiting& waiting, const std::vector<FilmState>& from, int row, int frame);
  int add_entry(const Waiting& waiting, const std::vector<FilmState>& from, const Entry& entry, int frame);
  int append(int parent, const FilmPiece& piece);
  void perform(const PerformanceWay& way, int step, int time, double cost, int parent,
               std::map<std::pair<int, int>, FilmState>& best);
  struct IdleStart {
    int frame = 0, num_played = 0;  ///< the last idle frame that is played at once, and how many that are
    Entry entry;
  };
  std::vector<FilmState> stand(const std::vector<IdleStart>& starts, int num_frames, int step, const Waiting* waiting,
                               const std::vector<FilmState>& from);
  bool is_idle(int first, int end) const;
  std::vector<PerformanceWay> find_ways(int motif) const;
  static std::vector<FilmState> kept(const std::map<std::pair<int, int>, FilmState>& best);

  const PeopleTexture& texture_;
  const FilmGraph& graph_;
  std::vector<double> beats_;
  PlanCosts costs_;
  std::vector<char> idle_;
  std::vector<double> wait_sum_;                        // cost of waiting before frame t, from 0
  std::vector<std::vector<FilmGraph::Jump>> landings_;  // by frame: cuts that land there; `to` is where they come from
  std::vector<Node> nodes_;
  std::map<int, std::vector<PerformanceWay>> ways_;
};

}  // namespace motex
