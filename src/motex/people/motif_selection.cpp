// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_selection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "motex/core/quantile.h"

namespace motex {
namespace {

constexpr std::size_t kMostCandidates = 16;

/// Where whole actions stand in their windows is open as far as idle frames reach: in the middle.
int centring(const MotifSearch& search, const MotifSeed& seed) {
  if (!search.whole_only) return 0;
  std::vector<double> shifts;
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    shifts.push_back(search.action.off_centre(match.start, match.length));
  }
  const int shift = static_cast<int>(std::lround(quantile(std::move(shifts), 0.5)));
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    if (!search.frames.whole(match.start + shift, match.length)) return 0;
  }
  return shift;
}

Motif motif_of(const MotifSearch& search, const MotifSeed& seed) {
  const int shift = centring(search, seed);
  Motif motif;
  motif.window = seed.window;
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    motif.occurrences.push_back({match.start + shift, match.length, correlation_distance(match.correlation)});
  }
  motif.exemplar = motif.occurrences[0].start;
  motif.distance = motif.occurrences[1].distance;
  motif.radius = motif.occurrences.back().distance;
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
  return motif;
}

/// What overlaps an occurrence of the motif is no longer there to be matched.
void drop_taken(MotifSeed& seed, const Motif& motif, const MotifSearch& search) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < seed.matches.size(); ++k) {
    if (is_taken(motif.occurrences, seed.matches[k])) continue;
    seed.matches[kept] = seed.matches[k];
    seed.lambda[kept++] = seed.lambda[k];
  }
  if (kept == seed.matches.size()) return;
  seed.matches.resize(kept);
  seed.lambda.resize(kept);
  rate(seed, search);
}

std::string chance_words(double gain, double needed) {
  char text[120];
  std::snprintf(text, sizeof text, "not significant: −ln P of so many so alike by chance is %.1f, %.1f is needed", gain,
                needed);
  return text;
}

std::string overlap_words(const Motif& motif) {
  return "overlaps occurrences of the motif at frame " + std::to_string(motif.exemplar);
}

/// The motif that most occurrences of the seed lie within 2R of: it is no other action. [PT04] section 2.2
SelectedMotif* same_action(std::vector<SelectedMotif>& selected, const MotifSeed& seed) {
  for (SelectedMotif& known : selected) {
    int near = 0;
    for (int k = 0; k < seed.count; ++k) {
      const Match& match = seed.matches[static_cast<std::size_t>(k)];
      const Occurrence place{match.start, match.length, 0};
      near += std::any_of(known.others.begin(), known.others.end(), [&](const Match& other) {
        return correlation_distance(other.correlation) <= 2 * known.motif.radius && overlaps(other, place);
      });
    }
    if (2 * near > seed.count) return &known;
  }
  return nullptr;
}

void join(Motif& motif, const Motif& more) {
  motif.occurrences.insert(motif.occurrences.end(), more.occurrences.begin(), more.occurrences.end());
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
}

MotifCandidate candidate_of(const MotifSeed& seed, std::string reason) {
  MotifCandidate out;
  out.window = seed.window;
  out.distance = correlation_distance(seed.matches[1].correlation);
  for (int k = 0; k < seed.count; ++k) out.starts.push_back(seed.matches[static_cast<std::size_t>(k)].start);
  std::sort(out.starts.begin(), out.starts.end());
  out.reason = std::move(reason);
  return out;
}

/// One way to choose motifs among the patterns.
class Selection {
 public:
  Selection(const MotifSearch& search, const std::vector<MotifSeed>& seeds, double needed,
            const std::vector<SelectedMotif>& before)
      : search_(&search), needed_(needed), seeds_(seeds), selected_(before) {
    for (const SelectedMotif& known : before) drop_everywhere(known.motif, overlap_words(known.motif));
  }
  /// Patterns nearly as long as the motif where it is are not chosen.
  void forbid(const Motif& motif) {
    for (MotifSeed& seed : seeds_) {
      if (seed.window < kNearlyAsLong * motif.window) continue;
      int shared = 0;
      for (int k = 0; k < seed.count; ++k)
        shared += is_taken(motif.occurrences, seed.matches[static_cast<std::size_t>(k)]) ? 1 : 0;
      if (2 * shared >= seed.count) seed.count = 1;
    }
  }
  void run() {
    while (MotifSeed* best = next()) {
      const MotifSeed seed = *best;
      best->count = 1;  // looked at
      if (!take(seed)) return;
    }
  }
  double saved() const { return saved_; }
  std::vector<SelectedMotif>& selected() { return selected_; }
  std::vector<MotifCandidate>& candidates() { return candidates_; }

 private:
  static constexpr double kNearlyAsLong = 0.75;

  MotifSeed* next() {
    const auto is_better = [&](const MotifSeed& a, const MotifSeed& b) {
      const bool is_motif = a.gain >= needed_;
      if (is_motif != (b.gain >= needed_)) return is_motif;
      return is_motif && search_->options.window == 0 ? a.saved > b.saved : a.gain > b.gain;
    };
    MotifSeed* best = nullptr;
    for (MotifSeed& seed : seeds_)
      if (seed.count > 1 && (best == nullptr || is_better(seed, *best))) best = &seed;
    return best;
  }

  /// False: enough was looked at.
  bool take(const MotifSeed& seed) {
    Motif motif = motif_of(*search_, seed);
    if (seed.gain < needed_) {
      if (candidates_.size() >= kMostCandidates) return false;
      candidates_.push_back(candidate_of(seed, chance_words(seed.gain, needed_)));
      drop_everywhere(motif, {});
      return true;
    }
    if (is_several(*search_, seed)) {
      if (candidates_.size() < kMostCandidates)
        candidates_.push_back(candidate_of(seed, "repeats within itself: one performance is shorter"));
      return true;
    }
    std::string told;
    if (SelectedMotif* known = same_action(selected_, seed)) {
      told = overlap_words(known->motif);
      join(known->motif, motif);
      saved_ += seed.saved;
    } else if (static_cast<int>(selected_.size()) >= search_->options.max_motifs) {
      candidates_.push_back(candidate_of(
          seed, "more than K = " + std::to_string(selected_.size()) + ": those found are more significant"));
      if (candidates_.size() >= kMostCandidates) return false;
    } else {
      selected_.push_back({motif, {seed.matches.begin() + seed.count, seed.matches.end()}});
      told = overlap_words(motif);
      saved_ += seed.saved;
    }
    drop_everywhere(motif, told);
    return true;
  }

  /// told: why the most significant pattern that this leaves without a second occurrence is no motif.
  void drop_everywhere(const Motif& motif, const std::string& told) {
    MotifSeed lost;
    for (MotifSeed& seed : seeds_) {
      if (seed.count <= 1) continue;
      const bool is_told = !told.empty() && seed.gain >= needed_ && seed.gain > lost.gain;
      MotifSeed before;
      if (is_told) before = seed;
      drop_taken(seed, motif, *search_);
      if (is_told && seed.count <= 1) lost = std::move(before);
    }
    if (lost.count > 1 && candidates_.size() < kMostCandidates) candidates_.push_back(candidate_of(lost, told));
  }

  const MotifSearch* search_;
  double needed_, saved_ = 0;
  std::vector<MotifSeed> seeds_;
  std::vector<SelectedMotif> selected_;
  std::vector<MotifCandidate> candidates_;
};

}  // namespace

void select_motifs(const MotifSearch& search, const std::vector<MotifSeed>& seeds, double needed,
                   std::vector<SelectedMotif>& selected, std::vector<MotifCandidate>& candidates) {
  const auto chosen_without = [&](const std::vector<Motif>& forbidden) {
    Selection selection(search, seeds, needed, selected);
    for (const Motif& motif : forbidden) selection.forbid(motif);
    selection.run();
    return selection;
  };
  std::vector<Motif> forbidden;
  Selection best = chosen_without(forbidden);
  const std::size_t num_before = selected.size();
  for (std::size_t k = num_before; search.options.window == 0 && k < best.selected().size();) {
    search.job.check_cancelled();
    forbidden.push_back(best.selected()[k].motif);
    Selection other = chosen_without(forbidden);
    if (other.saved() > best.saved()) {
      best = std::move(other);
      k = num_before;
    } else {
      forbidden.pop_back();
      ++k;
    }
  }
  selected = std::move(best.selected());
  candidates = std::move(best.candidates());
}

}  // namespace motex
