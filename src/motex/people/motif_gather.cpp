// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_gather.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motex/people/chance_rate.h"
#include "motex/people/motif_occurrences.h"

namespace motex {
namespace {

constexpr double kLeastSeen = 2.0 / 3;  // of a performance that the end of a take cuts off

/// Mean amplitude of what is whole.
double amplitude_of(const MotifSearch& search, const Motif& motif) {
  double sum = 0, count = 0;
  for (const Occurrence& one : motif.occurrences)
    if (whole(search, one)) sum += search.frames.amplitude(one.start, one.length), count += 1;
  return sum / count;
}

/// First frames and lengths of what is whole.
std::vector<FrameSpan> takes_of(const MotifSearch& search) {
  std::vector<FrameSpan> takes;
  for (int t = 0; t < search.frames.num_frames(); ++t) {
    if (!search.frames.whole(t, 1)) continue;
    if (takes.empty() || takes.back().end() != t || !search.frames.whole(t - 1, 2)) takes.push_back({t, 0});
    ++takes.back().length;
  }
  return takes;
}

/// A performance that begins before its take or ends after it.
struct CutMatch {
  Match match;   ///< of all of it; its correlation and amplitude are those of what is seen
  Pattern seen;  ///< what is seen of the pattern
};

/// The one that resembles the pattern best at that end of the take; correlation 0: the take is too short.
CutMatch cut_match(const MotifSearch& search, const Pattern& pattern, const FrameSpan& take, bool at_end) {
  CutMatch best;
  for (std::size_t k = 0; k < kMatchedTempos; ++k) {
    const int length = played_length(static_cast<int>(pattern.rows()), kTempos[k]);
    const Pattern played = stretched(pattern, length);
    const int most = std::min(length - 1, take.length);
    for (int seen = static_cast<int>(std::ceil(kLeastSeen * length)); seen <= most; ++seen) {
      const int start = at_end ? take.end() - seen : take.start;
      Pattern rows = stretched(at_end ? played.topRows(seen) : played.bottomRows(seen), seen);
      const double correlation = search.frames.pattern(start, seen, seen).cwiseProduct(rows).sum();
      if (correlation <= best.match.correlation) continue;
      const int before = at_end ? 0 : length - seen;
      best.match = {start - before, length, correlation, search.frames.amplitude(start, seen), 0};
      best.seen = std::move(rows);
    }
  }
  return best;
}

/// What resembles a motif and is no chance.
class Strays {
 public:
  Strays(const MotifSearch& search, const std::vector<FrameSpan>& active, const Motif& motif)
      : search_(&search),
        active_(&active),
        mean_(mean_of(search, motif.occurrences, motif.window)),
        amplitude_(amplitude_of(search, motif)) {}

  std::vector<Match> whole_ones() const {
    const ChanceRates rate_of = rates(mean_);
    std::vector<Match> out;
    for (const Match& match : search_->frames.matches(mean_, kAgree))
      if (is_as_strong(match.amplitude, amplitude_) && is_near(rate_of, match.correlation)) out.push_back(match);
    return out;
  }
  std::vector<Match> cut_ones(const std::vector<FrameSpan>& takes) const {
    std::vector<Match> out;
    for (const FrameSpan& take : takes) {
      for (const bool at_end : {false, true}) {
        const CutMatch cut = cut_match(*search_, mean_, take, at_end);
        if (cut.match.correlation < kAgree || !is_as_strong(cut.match.amplitude, amplitude_)) continue;
        if (is_near(rates(cut.seen), cut.match.correlation)) out.push_back(cut.match);
      }
    }
    return out;
  }

 private:
  ChanceRates rates(const Pattern& pattern) const {
    return {backgrounds_of(search_->series, *active_, static_cast<int>(pattern.rows())), pattern};
  }
  bool is_near(const ChanceRates& rate_of, double correlation) const {
    const double radius = search_->options.radius, places = static_cast<double>(search_->series.rows());
    return radius > 0 ? correlation_distance(correlation) <= radius : rate_of(correlation) * places <= kStray;
  }

  const MotifSearch* search_;
  const std::vector<FrameSpan>* active_;
  Pattern mean_;
  double amplitude_;
};

}  // namespace

void gather_performances(const MotifSearch& search, const std::vector<FrameSpan>& active, std::vector<Motif>& motifs) {
  struct Stray {
    Motif* motif;
    Match match;
  };
  const std::vector<FrameSpan> takes = takes_of(search);
  std::vector<Stray> all;
  for (Motif& motif : motifs) {
    const Strays strays(search, active, motif);
    for (const Match& match : strays.whole_ones()) all.push_back({&motif, match});
    for (const Match& match : strays.cut_ones(takes)) all.push_back({&motif, match});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Stray& a, const Stray& b) { return a.match.correlation > b.match.correlation; });
  for (const Stray& one : all) {
    const Occurrence place{one.match.start, one.match.length, correlation_distance(one.match.correlation)};
    if (is_free(search, motifs, place)) one.motif->occurrences.push_back(place);
  }
}

}  // namespace motex
