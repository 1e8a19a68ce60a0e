// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motifs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/people/activity.h"
#include "motex/people/background_process.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/template_match.h"

namespace motex {
namespace {

constexpr int kShortestWindow = 4;
constexpr double kLengthStep = 1.12;
constexpr int kSeedsALength = 14, kSeedsOfOneLength = 60;
constexpr int kBackgroundFrames = 8000;
constexpr double kLeastCorrelation = 0.85;
constexpr double kLevelSecs = 0.8;
constexpr double kDriftSecs = 5;
constexpr double kLeastActive = 0.3;
constexpr double kLeastActiveSeed = 0.8, kLeastActiveWhole = 0.6;  // of a window whose length was not asked for
constexpr double kLeastActiveCut = 0.6;                            // of a window that cuts what happens in two
constexpr double kWhole = 0.85;
constexpr double kLeastBend = 0.1;
constexpr double kStraight = 0.8;
constexpr double kBow = 0.96;
constexpr double kLeastStep = 0.9;
constexpr double kAmplitudes = 1.9;
constexpr std::size_t kMostOccurrences = 4000;
constexpr std::size_t kMostCandidates = 10;

/// Performances never agree better: where frames fall between moments already makes such differences.
constexpr double kFinest = 2e-3;

double distance_of(double correlation) { return std::sqrt(std::max(0.0, 2 * (1 - correlation))); }

/// Closeness whose tail is exponential: −ln(1 − ρ²).
double closeness(double correlation) { return -std::log(std::max(kFinest, 1 - correlation * correlation)); }

/// ln P(X ≥ c), X ~ Poisson(λ).
double log_poisson_tail(double lambda, int c) {
  if (c <= 0) return 0;
  if (lambda <= 0) return -1e9;
  if (lambda > c) {  // not in the tail
    return -1e-3;
  }
  double term = c * std::log(lambda) - lambda - std::lgamma(c + 1.0), sum = 1, ratio = 1;
  for (int k = c + 1; k < c + 1000; ++k) {
    ratio *= lambda / k;
    sum += ratio;
    if (ratio < 1e-12 * sum) break;
  }
  return term + std::log(sum);
}

/// How often the background comes as close to a pattern, per frame.
class ChanceRate {
 public:
  ChanceRate(const std::vector<Match>& matches, int num_frames) : num_frames_(num_frames) {
    for (const Match& match : matches) closeness_.push_back(closeness(match.correlation));
    constexpr std::size_t kTail = 24;
    if (closeness_.size() < 4) return;
    const std::size_t count = std::min(kTail, closeness_.size() - 1);
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += closeness_[k] - closeness_[count];
    tail_ = static_cast<double>(count);
    from_ = closeness_[count];
    mean_excess_ = std::max(1e-6, sum / tail_) * (1 + 1 / std::sqrt(tail_));  // an error bar to the safe side
  }
  double operator()(double correlation) const {
    const double z = closeness(correlation);
    if (tail_ == 0) return (static_cast<double>(closeness_.size()) + 1) / num_frames_ * std::exp(-2 * z);
    if (z >= from_) return tail_ / num_frames_ * std::exp(-(z - from_) / mean_excess_);
    const auto above = std::partition_point(closeness_.begin(), closeness_.end(), [z](double v) { return v >= z; });
    return static_cast<double>(above - closeness_.begin()) / num_frames_;
  }

 private:
  std::vector<double> closeness_;
  int num_frames_;
  double tail_ = 0, from_ = 0, mean_excess_ = 1;
};

/// A pattern with what it matches, the closest first; the first is where it comes from.
struct Seed {
  int window = 0;
  std::vector<Match> matches;
  std::vector<double> lambda;  ///< expected by chance at each match
  double gain = 0;             ///< nats: −ln P
  int count = 0;               ///< occurrences within R
};

/// Which windows may be an action: enough happens in them, and they hold whatever they touch of what happens between
/// two idle stretches nearly whole or (not whole_only) little idleness beside.
class ActionWindows {
 public:
  ActionWindows(std::vector<unsigned char> active, int shortest_pause) : sums_(active.size() + 1, 0) {
    const int size = static_cast<int>(active.size());
    int last_active = -size;
    for (int t = 0; t < size; ++t) {  // what pauses for less than that goes on
      if (active[at(t)] == 0) continue;
      if (t - last_active <= shortest_pause) std::fill(active.begin() + last_active, active.begin() + t, 1);
      last_active = t;
    }
    for (std::size_t t = 0; t < active.size(); ++t) sums_[t + 1] = sums_[t] + active[t];
    first_.resize(active.size() + 1);
    last_.resize(active.size() + 1);
    for (int t = 0; t < size; ++t) first_[at(t)] = t > 0 && active[at(t - 1)] != 0 ? first_[at(t - 1)] : t;
    for (int t = size; t-- > 0;) last_[at(t)] = t + 1 < size && active[at(t + 1)] != 0 ? last_[at(t + 1)] : t + 1;
    active_ = std::move(active);
  }
  /// Frames from the middle of the window to the middle of what it touches of what happens.
  double off_centre(int start, int length) const {
    const int end = start + length;
    int from = start, to = end;
    while (from < end && active_[at(from)] == 0) ++from;
    while (to > from && active_[at(to - 1)] == 0) --to;
    if (from == to) return 0;
    return (first_[at(from)] + last_[at(to - 1)]) / 2.0 - (start + end) / 2.0;
  }
  bool allow(int start, int length, bool whole_only, double least_active) const {
    const int inside = sums_[at(start + length)] - sums_[at(start)];
    if (inside < least_active * length) return false;
    if (!whole_only && inside >= kLeastActiveCut * length) return true;
    const int from = active_[at(start)] != 0 ? first_[at(start)] : start;
    const int to = active_[at(start + length - 1)] != 0 ? last_[at(start + length - 1)] : start + length;
    return inside >= kWhole * (sums_[at(to)] - sums_[at(from)]);
  }

 private:
  static std::size_t at(int t) { return static_cast<std::size_t>(t); }
  std::vector<unsigned char> active_;
  std::vector<int> sums_, first_, last_;
};

struct Search {
  const FrameMatrix& series;
  const FindMotifsOptions& options;
  const std::vector<FrameSpan>& stretches;
  const JobContext& job;
  Activity activity;
  ActionWindows action;
  bool whole_only = false;
  double least_active(double of_any_length) const {
    return whole_only && options.window == 0 ? of_any_length : kLeastActive;
  }
  double places = 0;  // windows of the length at hand that may be an action
  PatternSearch frames;
  std::vector<PatternSearch> backgrounds;
};

bool overlaps(const Match& a, const Occurrence& b) {
  const int shared = std::min(a.start + a.length, b.start + b.length) - std::max(a.start, b.start);
  return shared > 0.3 * std::min(a.length, b.length);
}

/// The count of least chance among those left.
void rate(Seed& seed, const FindMotifsOptions& options) {
  seed.gain = 0;
  seed.count = 1;
  for (std::size_t k = 1; k < seed.matches.size(); ++k) {
    const double distance = distance_of(seed.matches[k].correlation);
    if (options.radius > 0 && distance > options.radius) break;
    const double gain = -log_poisson_tail(seed.lambda[k], static_cast<int>(k));
    if (gain <= seed.gain && options.radius <= 0) continue;
    seed.gain = gain;
    seed.count = static_cast<int>(k) + 1;
  }
}

/// Windows that hold too little that happens, or hardly more than a straight line, match everything of their kind.
void leave_out_idle(SeriesWindows& windows, const Search& search) {
  const int m = windows.window;
  const double middle = (m - 1) / 2.0, spread = m * (static_cast<double>(m) * m - 1) / 12;
  for (int i = 0; i < windows.num_windows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (windows.usable[k] == 0) continue;
    double straight = 0;
    for (int s = 0; s < windows.num_signals; ++s) {
      double along = 0;
      const double* x = windows.signal(s) + i;
      for (int t = 0; t < m; ++t) along += (t - middle) * x[t];
      straight += along * along / spread;
    }
    if (!search.action.allow(i, m, search.whole_only, search.least_active(kLeastActiveSeed)) ||
        straight > (1 - kLeastBend) * m * windows.deviation(i) * windows.deviation(i)) {
      windows.usable[k] = 0;
      windows.deviations[k] = 0;
    }
  }
}

/// Starts of the closest pairs, half a window apart.
std::vector<int> seeds_of(const MatrixProfile& profile, int most) {
  std::vector<int> order;
  for (std::size_t i = 0; i < profile.distance.size(); ++i)
    if (profile.nearest[i] >= 0) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return profile.distance[static_cast<std::size_t>(a)] < profile.distance[static_cast<std::size_t>(b)];
  });
  std::vector<unsigned char> taken(profile.distance.size(), 0);
  std::vector<int> out;
  const auto take = [&](int i) {
    const int half = profile.window / 2, size = static_cast<int>(taken.size());
    std::fill(taken.begin() + std::max(0, i - half), taken.begin() + std::min(size, i + half + 1), 1);
  };
  for (const int i : order) {
    if (static_cast<int>(out.size()) == most) break;
    if (taken[static_cast<std::size_t>(i)] != 0) continue;
    out.push_back(i);
    take(i);
    take(profile.nearest[static_cast<std::size_t>(i)]);
  }
  return out;
}

std::vector<Match> matches_of(const Search& search, const Pattern& pattern, double amplitude) {
  std::vector<Match> out;
  for (const Match& match : search.frames.matches(pattern, kLeastCorrelation)) {
    if (match.amplitude > kAmplitudes * amplitude || match.amplitude * kAmplitudes < amplitude) continue;
    if (!search.action.allow(match.start, match.length, search.whole_only, search.least_active(kLeastActiveWhole)))
      continue;
    out.push_back(match);
    if (out.size() == kMostOccurrences) break;
  }
  return out;
}

/// Mean of the occurrences, each at the same length.
Pattern mean_pattern(const Search& search, const std::vector<Match>& matches, int count, int window) {
  Pattern sum = Pattern::Zero(window, search.series.cols());
  for (int k = 0; k < count; ++k) {
    const Match& match = matches[static_cast<std::size_t>(k)];
    sum += search.frames.pattern(match.start, match.length, window);
  }
  return stretched(sum, window);
}

void weigh(Seed& seed, const Search& search, const Pattern& pattern) {
  std::vector<ChanceRate> rates;
  for (const PatternSearch& background : search.backgrounds)
    rates.emplace_back(background.matches(pattern, 0.2), background.num_frames());
  seed.lambda.clear();
  for (const Match& match : seed.matches) {
    double most = 0;
    for (const ChanceRate& rate_of : rates) most = std::max(most, rate_of(match.correlation));
    seed.lambda.push_back(most * search.places);
  }
  rate(seed, search.options);
}

/// The members of a mean resemble it because they are in it: against the mean of the others,
/// ρ' = (ρ N − 1) / √(N² − 2 ρ N + 1) with N = Σ ρ, the norm of the sum of the members.
void leave_each_out(std::vector<Match>& matches, const Seed& members) {
  const auto is_member = [&](const Match& match) {
    for (int k = 0; k < members.count; ++k) {
      const Match& other = members.matches[static_cast<std::size_t>(k)];
      if (std::abs(2 * match.start + match.length - 2 * other.start - other.length) < match.length) return true;
    }
    return false;
  };
  double norm = 0;
  for (const Match& match : matches)
    if (is_member(match)) norm += match.correlation;
  for (Match& match : matches) {
    if (!is_member(match)) continue;
    const double along = match.correlation * norm;
    match.correlation = (along - 1) / std::sqrt(std::max(1e-12, norm * norm - 2 * along + 1));
  }
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.correlation > b.correlation; });
}

/// Share of the pattern that a straight line (degree 1) or a parabola (2) explains.
double explained_by_polynomial(const Pattern& pattern, int degree) {
  const auto m = static_cast<double>(pattern.rows());
  double sum = 0;
  for (Index s = 0; s < pattern.cols(); ++s) {
    double line = 0, bow = 0, line_norm = 0, bow_norm = 0;
    for (Index t = 0; t < pattern.rows(); ++t) {
      const double u = static_cast<double>(t) - (m - 1) / 2, v = u * u - (m * m - 1) / 12;
      line += u * pattern(t, s);
      bow += v * pattern(t, s);
      line_norm += u * u;
      bow_norm += v * v;
    }
    sum += line * line / line_norm + (degree > 1 ? bow * bow / bow_norm : 0);
  }
  return pattern.squaredNorm() > 0.5 ? sum : 1;
}

bool is_drift(const Pattern& pattern) {
  return explained_by_polynomial(pattern, 1) > kStraight || explained_by_polynomial(pattern, 2) > kBow;
}

Seed grow(const Search& search, int start, int window) {
  Seed seed;
  seed.window = window;
  Pattern pattern = search.frames.pattern(start, window, window);
  seed.matches = matches_of(search, pattern, search.frames.amplitude(start, window));
  weigh(seed, search, pattern);
  for (int round = 0; round < 2 && seed.count > 1; ++round) {
    Seed better = seed;
    pattern = mean_pattern(search, seed.matches, seed.count, window);
    if (is_drift(pattern)) {
      seed.count = 1;
      break;
    }
    double amplitude = 0;
    for (int k = 0; k < seed.count; ++k) {
      const Match& match = seed.matches[static_cast<std::size_t>(k)];
      amplitude += search.frames.amplitude(match.start, match.length) / seed.count;
    }
    better.matches = matches_of(search, pattern, amplitude);
    leave_each_out(better.matches, seed);
    weigh(better, search, pattern);
    if (better.gain <= seed.gain) break;
    seed = std::move(better);
  }
  return seed;
}

/// The pattern repeats within itself: a shorter one tells more.
bool is_several(const Search& search, const Seed& seed) {
  if (search.options.window > 0) return false;
  std::vector<double> rivals, starts, steps;
  for (int k = 0; k < seed.count; ++k) {
    rivals.push_back(seed.matches[static_cast<std::size_t>(k)].rival);
    starts.push_back(seed.matches[static_cast<std::size_t>(k)].start);
  }
  std::sort(starts.begin(), starts.end());
  for (std::size_t k = 1; k < starts.size(); ++k) steps.push_back(starts[k] - starts[k - 1]);
  const double least = seed.matches[static_cast<std::size_t>(seed.count - 1)].correlation;
  return quantile(std::move(rivals), 0.5) >= least || quantile(std::move(steps), 0.5) < kLeastStep * seed.window;
}

std::vector<int> lengths(const FindMotifsOptions& options, int longest) {
  if (options.window > 0) return {options.window};
  std::vector<int> out;
  const double least = std::max<double>(kShortestWindow, options.min_secs * options.frames_per_sec);
  const double most = std::min<double>(longest / 2.0, options.max_secs * options.frames_per_sec);
  for (double length = least; length <= most + 0.5; length *= kLengthStep)
    out.push_back(static_cast<int>(std::lround(length)));
  return out;
}

/// Patterns of every length, in the frames that are not taken yet.
std::vector<Seed> seeds_of_all_lengths(Search& search, const std::vector<int>& lengths,
                                       const std::vector<FrameSpan>& active, double& num_patterns) {
  std::vector<Seed> seeds;
  for (const int window : lengths) {
    SeriesWindows windows = series_windows(search.series, window, search.stretches);
    leave_out_idle(windows, search);
    const MatrixProfile profile = matrix_profile(windows, window / 2, search.job);
    const std::vector<int> starts = seeds_of(profile, search.options.window > 0 ? kSeedsOfOneLength : kSeedsALength);
    search.places = static_cast<double>(std::count(windows.usable.begin(), windows.usable.end(), 1));
    num_patterns += search.places / (window / 2.0);
    search.backgrounds.clear();
    for (const bool differenced : {false, true})
      search.backgrounds.emplace_back(background_series(search.series, active, window, differenced, kBackgroundFrames),
                                      std::vector<FrameSpan>{});
    const std::size_t first = seeds.size();
    seeds.resize(first + starts.size());
    parallel_for(search.job.jobs, static_cast<int>(starts.size()), [&](int k) {
      search.job.check_cancelled();
      seeds[first + static_cast<std::size_t>(k)] = grow(search, starts[static_cast<std::size_t>(k)], window);
    });
  }
  return seeds;
}

/// Where whole actions stand in their windows is open as far as idle frames reach: in the middle.
int centring(const Search& search, const Seed& seed) {
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

Motif motif_of(const Search& search, const Seed& seed) {
  const int shift = centring(search, seed);
  Motif motif;
  motif.window = seed.window;
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    motif.occurrences.push_back({match.start + shift, match.length, distance_of(match.correlation)});
  }
  motif.exemplar = motif.occurrences[0].start;
  motif.distance = motif.occurrences[1].distance;
  motif.radius = motif.occurrences.back().distance;
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
  return motif;
}

/// What overlaps an occurrence of the motif is no longer there to be matched.
void drop_taken(Seed& seed, const Motif& motif, const FindMotifsOptions& options) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < seed.matches.size(); ++k) {
    const bool is_taken = std::any_of(motif.occurrences.begin(), motif.occurrences.end(),
                                      [&](const Occurrence& o) { return overlaps(seed.matches[k], o); });
    if (is_taken) continue;
    seed.matches[kept] = seed.matches[k];
    seed.lambda[kept++] = seed.lambda[k];
  }
  if (kept == seed.matches.size()) return;
  seed.matches.resize(kept);
  seed.lambda.resize(kept);
  rate(seed, options);
}

std::string chance_words(double gain, double needed) {
  const double times = std::exp(needed - gain);
  return times >= 100 ? "100 times as often as allowed or more"
                      : std::to_string(std::lround(std::ceil(times))) + " times as often as allowed";
}

/// A motif that was found, with the pattern's other matches.
struct Accepted {
  Motif motif;
  std::vector<Match> others;
};

/// The motif that most occurrences of the seed lie within 2R of: it is no other action. [PT04] section 2.2
Accepted* same_action(std::vector<Accepted>& accepted, const Seed& seed) {
  for (Accepted& known : accepted) {
    int near = 0;
    for (int k = 0; k < seed.count; ++k) {
      const Match& match = seed.matches[static_cast<std::size_t>(k)];
      const Occurrence place{match.start, match.length, 0};
      near += std::any_of(known.others.begin(), known.others.end(), [&](const Match& other) {
        return distance_of(other.correlation) <= 2 * known.motif.radius && overlaps(other, place);
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

MotifCandidate candidate_of(const Seed& seed, std::string reason) {
  MotifCandidate out;
  out.window = seed.window;
  out.distance = distance_of(seed.matches[1].correlation);
  for (int k = 0; k < seed.count; ++k) out.starts.push_back(seed.matches[static_cast<std::size_t>(k)].start);
  std::sort(out.starts.begin(), out.starts.end());
  out.reason = std::move(reason);
  return out;
}

/// The most significant first; each takes its frames.
void select(const Search& search, std::vector<Seed>& seeds, double needed, std::vector<Accepted>& accepted,
            std::vector<MotifCandidate>& candidates) {
  const auto drop_everywhere = [&](const Motif& motif) {
    for (Seed& seed : seeds)
      if (seed.count > 1) drop_taken(seed, motif, search.options);
  };
  for (const Accepted& known : accepted) drop_everywhere(known.motif);
  while (true) {
    Seed* best = nullptr;
    for (Seed& seed : seeds)
      if (seed.count > 1 && (best == nullptr || seed.gain > best->gain)) best = &seed;
    if (best == nullptr) return;
    const Seed seed = *best;
    best->count = 1;  // looked at
    Motif motif = motif_of(search, seed);
    if (seed.gain < needed) {
      if (candidates.size() >= kMostCandidates) return;
      candidates.push_back(candidate_of(seed, "chance brings as much " + chance_words(seed.gain, needed)));
      drop_everywhere(motif);
      continue;
    }
    if (is_several(search, seed)) continue;
    if (Accepted* known = same_action(accepted, seed)) {
      join(known->motif, motif);
    } else if (static_cast<int>(accepted.size()) >= search.options.max_motifs) {
      candidates.push_back(
          candidate_of(seed, "there are " + std::to_string(accepted.size()) + " motifs of more weight"));
      if (candidates.size() >= kMostCandidates) return;
    } else {
      accepted.push_back({motif, {seed.matches.begin() + seed.count, seed.matches.end()}});
    }
    drop_everywhere(motif);
  }
}

/// Less the best straight line of each signal: what only rises repeats nothing.
FrameMatrix without_line(const FrameMatrix& given) {
  FrameMatrix out = given;
  for (Index s = 0; s < given.cols(); ++s) {
    double count = 0, mean_t = 0, mean_x = 0, along = 0, spread = 0;
    for (Index t = 0; t < given.rows(); ++t) {
      if (!std::isfinite(given(t, s))) continue;
      count += 1;
      mean_t += (static_cast<double>(t) - mean_t) / count;
      mean_x += (given(t, s) - mean_x) / count;
    }
    for (Index t = 0; t < given.rows(); ++t) {
      if (!std::isfinite(given(t, s))) continue;
      const double u = static_cast<double>(t) - mean_t;
      along += u * (given(t, s) - mean_x);
      spread += u * u;
    }
    if (spread <= 0) continue;
    for (Index t = 0; t < given.rows(); ++t) out(t, s) -= mean_x + along / spread * (static_cast<double>(t) - mean_t);
  }
  return out;
}

}  // namespace

std::string motif_letter(int idx) {
  std::string out;
  for (int rest = idx; rest >= 0; rest = rest / 26 - 1) out.insert(out.begin(), static_cast<char>('A' + rest % 26));
  return out;
}

MotifReport find_motifs(const FrameMatrix& given, const FindMotifsOptions& options,
                        const std::vector<FrameSpan>& stretches, const JobContext& job) {
  check_options(options);
  FrameMatrix series = without_line(given);
  MotifReport report;
  report.windows = lengths(options, static_cast<int>(series.rows()));
  if (report.windows.empty()) return report;
  const int level_window = std::clamp(static_cast<int>(std::lround(kLevelSecs * options.frames_per_sec)),
                                      kShortestWindow, static_cast<int>(series.rows()));
  const Activity activity = find_activity(
      series, level_window, static_cast<int>(std::lround(kDriftSecs * options.frames_per_sec)), stretches);
  if (series.cols() > 1)  // made comparable, so that one deviation a window will do
    for (Index s = 0; s < series.cols(); ++s)
      if (const double scale = activity.scale[static_cast<std::size_t>(s)]; scale > 0) series.col(s) /= scale;
  Search search{series, options, stretches,           job, activity, ActionWindows(activity.active, level_window),
                false,  0,       {series, stretches}, {}};
  std::vector<FrameSpan> active;
  for (std::size_t t = 0; t < activity.active.size(); ++t) {
    if (activity.active[t] == 0) continue;
    if (active.empty() || active.back().end() != static_cast<int>(t)) active.push_back({static_cast<int>(t), 0});
    ++active.back().length;
  }
  report.set.idle = activity.idle;
  std::vector<Accepted> accepted;
  for (const bool whole_only : {true, false}) {
    if (whole_only && !activity.two_levels) continue;
    search.whole_only = whole_only;
    double num_patterns = 1;
    std::vector<Seed> seeds = seeds_of_all_lengths(search, report.windows, active, num_patterns);
    report.candidates.clear();
    select(search, seeds, std::log(num_patterns / options.false_motifs), accepted, report.candidates);
  }
  for (Accepted& known : accepted) report.set.motifs.push_back(std::move(known.motif));
  std::stable_sort(report.set.motifs.begin(), report.set.motifs.end(),
                   [](const Motif& a, const Motif& b) { return a.occurrences.size() > b.occurrences.size(); });
  for (std::size_t k = 0; k < report.set.motifs.size(); ++k)
    report.set.motifs[k].letter = motif_letter(static_cast<int>(k));
  return report;
}

}  // namespace motex
