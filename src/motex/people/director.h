// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "motex/core/options.h"
#include "motex/core/rng.h"
#include "motex/people/edit_list.h"
#include "motex/people/film_graph.h"
#include "motex/people/film_planner.h"
#include "motex/people/people_texture.h"
#include "motex/people/shot_options.h"

namespace motex {

struct PlayOptions : ShotOptions {
  double shot_secs = 5;
  double max_latency_secs = 3;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    ShotOptions::visit_fields(self, visit);
    visit(Field{"shot_secs", "s", "mean time between two cuts"}, self.shot_secs, Range{0.2, 3600});
    visit(Field{"max_latency_secs", "s", "longest wait before an action that was asked for, where cuts allow it"},
          self.max_latency_secs, Range{0, 600});
    visit(Field{"seed", "", "of what is chosen"}, self.seed, Range{0, 1.8e19});
  }
};

/// One frame of a film that is made up while it plays.
struct DirectedFrame {
  int frame = 0;         ///< of the people texture
  int cut = -1;          ///< the cut that leads to it, in texture.cuts; −1 = it just goes on
  int motif = -1;        ///< that was asked for and is being performed
  int performance = -1;  ///< the how manyth of those, from 0
};

/// Plays for ever, and performs what is asked for. Free play stays among frames that film can go on from for ever
/// (FilmGraph::is_endless), cuts every few seconds to where the cut and what can follow it cost little and that was not
/// shown lately, drawn by the seed; a choice is gone to by the cheapest way. texture must outlive it.
class Director {
 public:
  /// Throws InvalidInput when no part of the footage can be played for ever: too few cuts.
  explicit Director(const PeopleTexture& texture, const PlayOptions& options = {});

  DirectedFrame next();
  /// Performs the motif as soon as it can, after what was chosen before. Throws InvalidInput: no such motif, or no way
  /// to it and on from there.
  void choose(int motif);
  /// Choices that are not yet being performed.
  int num_waiting() const { return static_cast<int>(choices_.size()); }
  const FilmGraph& graph() const { return graph_; }

 private:
  void plan();
  bool plan_choice(int motif);
  void plan_free();
  void go_on_to(int last);
  void jump(const FilmGraph::Jump& jump);
  int last_endless(int frame) const;

  const PeopleTexture& texture_;
  PlayOptions options_;
  FilmGraph graph_;
  Rng rng_;
  std::vector<bool> performable_;
  std::deque<int> choices_;
  std::deque<DirectedFrame> planned_;
  int num_performed_ = 0;
  int frame_ = 0;            // the last one planned
  std::int64_t time_ = 0;    // frames planned so far
  std::int64_t cut_at_ = 0;  // when a cut is due
  std::vector<std::int64_t> last_shown_;
};

/// A film of free play; what is performed in it is listed.
EditList play(const PeopleTexture& texture, int num_frames, const PlayOptions& options = {});

/// Film out of frames as a Director gives them.
EditList edit_list_of_frames(const PeopleTexture& texture, const std::vector<DirectedFrame>& frames,
                             int transition_frames);

}  // namespace motex
