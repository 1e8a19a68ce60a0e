// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/people/edit_list.h"
#include "motex/people/film_planner.h"
#include "motex/people/people_texture.h"
#include "motex/people/script.h"
#include "motex/people/shot_options.h"

namespace motex {

struct DirectOptions : ShotOptions {
  double max_latency_secs = 3;
  double stand_secs = 1;
  bool loop = false;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    ShotOptions::visit_fields(self, visit);
    visit(Field{"max_latency_secs", "s",
                "longest wait between two actions; where none is that near, it takes longer with a warning"},
          self.max_latency_secs, Range{0, 600});
    visit(Field{"stand_secs", "s", "how long the actor stands where the script does not say"}, self.stand_secs,
          Range{0.1, 600});
    visit(Field{"loop", "", "the last frame goes on to the first"}, self.loop, Range{});
    visit(Field{"seed", "", "of what the script leaves free"}, self.seed, Range{0, 1.8e19});
  }
};

struct DirectReport {
  EditList edits;
  std::vector<double> latency_secs;  ///< one a performance: the wait before it
  double cost = 0;                   ///< of the film (cost_of_cut, PlanCosts)
  double longest_latency_secs() const;
};

/// Turns a script into a film: between actions the cheapest way by cuts and waiting, at each action the best fork
/// between its occurrences (FilmPlanner). An occurrence that was just shown comes again only when the others cost far
/// more. beats: seconds of the film, rising; cuts and the accents of actions are drawn to them. The footage may begin
/// and end a film anywhere, but a film never runs into the end of a take. [PT04] section 3
/// Throws InvalidInput: texture.cuts not found yet, a motif that does not exist, no way from one action to the next or,
/// with `loop`, back to the beginning.
DirectReport direct(const PeopleTexture& texture, std::span<const Direction> script, const DirectOptions& options = {},
                    std::span<const double> beats = {}, const JobContext& job = {});

/// Shots, cuts and performances of a film. Pieces go on from one another in the take or by their cuts.
EditList edit_list_of(const PeopleTexture& texture, std::span<const FilmPiece> pieces,
                      std::span<const int> motif_of_step, int transition_frames);

}  // namespace motex
