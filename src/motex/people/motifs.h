// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/matrix.h"
#include "motex/core/options.h"
#include "motex/people/motif.h"

namespace motex {

struct FindMotifsOptions {
  int window = 0;
  double frames_per_sec = 30;
  double min_secs = 0.5;
  double max_secs = 6;
  double radius = 0;
  int max_motifs = 26;
  double false_motifs = 1e-3;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"window", "frames", "length of a motif; auto = every length from min_secs to max_secs"}, self.window,
          Range{4, 1e6, true});
    visit(Field{"min_secs", "s", "shortest motif"}, self.min_secs, Range{0.1, 1000});
    visit(Field{"max_secs", "s", "longest motif"}, self.max_secs, Range{0.1, 1000});
    visit(Field{"radius", "",
                "R: occurrences lie within it, Euclidean between z-normalised windows / √window; auto = where "
                "their number is least likely by chance"},
          self.radius, Range{0.001, 2, true});
    visit(Field{"max_motifs", "", "K: the most significant motifs that are reported"}, self.max_motifs, Range{1, 1000});
    visit(Field{"false_motifs", "", "motifs that chance may add to a series in which nothing repeats"},
          self.false_motifs, Range{1e-12, 1});
  }
};

/// Something that was looked at and is no motif.
struct MotifCandidate {
  int window = 0;           ///< frames
  double distance = 0;      ///< of the closest pair, / √window
  std::vector<int> starts;  ///< first frames of its occurrences
  std::string reason;       ///< why it is no motif: one sentence
};

struct MotifReport {
  MotifSet set;
  std::vector<MotifCandidate> candidates;
  std::vector<int> windows;  ///< lengths that were tried, frames
};

/// What repeats in a series (rows = frames, columns = signals). For every length the closest pairs of the exact matrix
/// profile (idle windows and straight drifts left out) are patterns to start from; a pattern is looked for in the whole
/// series at 0.82 … 1.22 of its tempo with at most twice or half its amplitude. Several signals: each is divided by its
/// Activity::scale, and a window is z-normalised by the one deviation of all its signals (SeriesWindows).
///
/// R, the number of occurrences c and the significance come from one rule: in a series that moves likewise but repeats
/// nothing (background_series(), the worse of two kinds) a match at least as close as the c-th comes λ(c) times; R lies
/// where −ln P(Poisson(λ) ≥ c − 1) is greatest. What chance would bring less than `false_motifs` times among all
/// patterns tried is a motif; what saves most (select_motifs(), MotifCode) comes first and its frames are taken. Motifs
/// are mutually exclusive: no two share frames, and exemplars of one class lie in one motif (their distance is above 2R
/// otherwise). [PT04] section 2.2
///
/// Then whole actions are made of them (refine_motifs()): where no window is asked for, one that holds two like
/// performances is halved and one that holds a part of an action grows; performances left over are gathered.
///
/// stretches: never crossed (takes of film); empty = the whole series. A series shorter than two of the shortest
/// windows has no motif. Throws InvalidInput (window longer than half of the series, options out of range), Cancelled.
MotifReport find_motifs(const FrameMatrix& series, const FindMotifsOptions& options = {},
                        const std::vector<FrameSpan>& stretches = {}, const JobContext& job = {});

/// "A" … "Z", "AA", …
std::string motif_letter(int idx);

}  // namespace motex
