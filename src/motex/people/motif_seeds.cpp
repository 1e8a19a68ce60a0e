// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_seeds.h"

#include <cstddef>
#include <iterator>
#include <utility>

#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/people/background_process.h"
#include "motex/people/chance_rate.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/trend.h"

namespace motex {
namespace {

constexpr std::size_t kSeedsALength = 12, kSeedsOfOneLength = 60, kNewSeeds = 10;
constexpr int kBackgroundFrames = 8000;
constexpr double kLeastActive = 0.3;
constexpr double kLeastActiveSeed = 0.8, kLeastActiveWhole = 0.6;  // of a window whose length was not asked for
constexpr double kLeastBend = 0.1;
constexpr double kLeastStep = 0.9;
constexpr std::size_t kMostOccurrences = 4000;

double least_active(const MotifSearch& search, double of_any_length) {
  return search.whole_only && search.options.window == 0 ? of_any_length : kLeastActive;
}

/// Windows that hold too little that happens, or hardly more than a straight line, match everything of their kind.
void leave_out_idle(SeriesWindows& windows, const MotifSearch& search) {
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
    if (!search.action.allow(i, m, search.whole_only, least_active(search, kLeastActiveSeed)) ||
        straight > (1 - kLeastBend) * m * windows.deviation(i) * windows.deviation(i)) {
      windows.usable[k] = 0;
      windows.deviations[k] = 0;
    }
  }
}

/// Starts of the closest pairs, one after another, none within half a window of what was found before.
class SeedStarts {
 public:
  explicit SeedStarts(const MatrixProfile& profile) : half_(profile.window / 2), taken_(profile.distance.size(), 0) {
    for (std::size_t i = 0; i < profile.distance.size(); ++i)
      if (profile.nearest[i] >= 0) order_.push_back(static_cast<int>(i));
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
      return profile.distance[static_cast<std::size_t>(a)] < profile.distance[static_cast<std::size_t>(b)];
    });
  }
  /// −1: none is left.
  int next() {
    for (; at_ < order_.size(); ++at_)
      if (taken_[static_cast<std::size_t>(order_[at_])] == 0) return order_[at_];
    return -1;
  }
  void take(int start) {
    const int size = static_cast<int>(taken_.size());
    const int from = std::clamp(start - half_, 0, size), to = std::clamp(start + half_ + 1, 0, size);
    std::fill(taken_.begin() + from, taken_.begin() + std::max(from, to), 1);
  }

 private:
  int half_;
  std::size_t at_ = 0;
  std::vector<int> order_;
  std::vector<unsigned char> taken_;
};

std::vector<Match> matches_of(const MotifSearch& search, const Pattern& pattern, double amplitude) {
  std::vector<Match> out;
  for (const Match& match : search.frames.matches(pattern, kAgree)) {
    if (!is_as_strong(match.amplitude, amplitude)) continue;
    if (!search.action.allow(match.start, match.length, search.whole_only, least_active(search, kLeastActiveWhole)))
      continue;
    out.push_back(match);
    if (out.size() == kMostOccurrences) break;
  }
  return out;
}

/// Mean of the occurrences, each at the same length.
Pattern mean_pattern(const MotifSearch& search, const std::vector<Match>& matches, int count, int window) {
  Pattern sum = Pattern::Zero(window, search.series.cols());
  for (int k = 0; k < count; ++k) {
    const Match& match = matches[static_cast<std::size_t>(k)];
    sum += search.frames.pattern(match.start, match.length, window);
  }
  return stretched(sum, window);
}

void weigh(MotifSeed& seed, const MotifSearch& search, const Pattern& pattern) {
  const ChanceRates rate_of(search.backgrounds, pattern);
  seed.lambda.clear();
  for (const Match& match : seed.matches) seed.lambda.push_back(rate_of(match.correlation) * search.places);
  rate(seed, search);
}

/// The members of a mean resemble it because they are in it: against the mean of the others,
/// ρ' = (ρ N − 1) / √(N² − 2 ρ N + 1) with N = Σ ρ, the norm of the sum of the members.
void leave_each_out(std::vector<Match>& matches, const MotifSeed& members) {
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

MotifSeed grow(const MotifSearch& search, int start, int window) {
  MotifSeed seed;
  seed.window = window;
  Pattern pattern = search.frames.pattern(start, window, window);
  seed.matches = matches_of(search, pattern, search.frames.amplitude(start, window));
  weigh(seed, search, pattern);
  for (int round = 0; round < 2 && seed.count > 1; ++round) {
    MotifSeed better = seed;
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

}  // namespace

std::vector<PatternSearch> backgrounds_of(const FrameMatrix& series, const std::vector<FrameSpan>& active, int window) {
  std::vector<PatternSearch> backgrounds;
  for (const bool differenced : {false, true})
    backgrounds.emplace_back(background_series(series, active, window, differenced, kBackgroundFrames),
                             std::vector<FrameSpan>{});
  return backgrounds;
}

void rate(MotifSeed& seed, const MotifSearch& search) {
  const FindMotifsOptions& options = search.options;
  seed.gain = 0;
  seed.saved = 0;
  seed.count = 1;
  for (std::size_t k = 1; k < seed.matches.size(); ++k) {
    const double distance = correlation_distance(seed.matches[k].correlation);
    if (options.radius > 0 && distance > options.radius) break;
    const double gain = -log_poisson_tail(seed.lambda[k], static_cast<int>(k));
    if (gain <= seed.gain && options.radius <= 0) continue;
    seed.gain = gain;
    seed.count = static_cast<int>(k) + 1;
  }
  while (options.radius <= 0 && seed.count > 1 && seed.count < static_cast<int>(seed.matches.size())) {
    const Match& next = seed.matches[static_cast<std::size_t>(seed.count)];
    if (seed.lambda[static_cast<std::size_t>(seed.count)] > kStray ||
        search.code.saved(next.start, next.length, next.correlation) <= 0)
      break;
    ++seed.count;
  }
  for (int k = 1; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    seed.saved += std::max(0.0, search.code.saved(match.start, match.length, match.correlation));
  }
}

bool is_several(const MotifSearch& search, const MotifSeed& seed) {
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

namespace {

void take_matches(SeedStarts& starts, const MotifSeed& seed) {
  for (std::size_t k = 0; k < seed.matches.size() && static_cast<int>(k) < seed.count; ++k)
    starts.take(seed.matches[k].start);
}

/// Those of one length; `search` is this length's own.
std::vector<MotifSeed> seeds_of_length(MotifSearch& search, int window, const std::vector<FrameSpan>& active,
                                       const JobContext& job) {
  SeriesWindows windows = series_windows(search.series, window, search.stretches);
  leave_out_idle(windows, search);
  const MatrixProfile profile = matrix_profile(windows, window / 2, job);
  search.places = static_cast<double>(std::count(windows.usable.begin(), windows.usable.end(), 1));
  search.backgrounds = backgrounds_of(search.series, active, window);
  search.frames.prepare(window);
  for (PatternSearch& background : search.backgrounds) background.prepare(window);
  std::vector<MotifSeed> seeds;
  SeedStarts starts(profile);
  const auto grow_until = [&](std::size_t most, bool new_only) {
    for (int start = starts.next(); start >= 0 && seeds.size() < most; start = starts.next()) {
      job.check_cancelled();
      seeds.push_back(grow(search, start, window));
      starts.take(start);
      starts.take(profile.nearest[static_cast<std::size_t>(start)]);
      if (new_only) take_matches(starts, seeds.back());
    }
  };
  const std::size_t most = search.options.window > 0 ? kSeedsOfOneLength : kSeedsALength;
  grow_until(most, false);
  for (const MotifSeed& seed : seeds) take_matches(starts, seed);
  grow_until(most + kNewSeeds, true);
  return seeds;
}

}  // namespace

std::vector<MotifSeed> motif_seeds(const MotifSearch& search, const std::vector<int>& lengths,
                                   const std::vector<FrameSpan>& active, double& num_patterns) {
  std::vector<std::vector<MotifSeed>> found(lengths.size());
  std::vector<double> places(lengths.size());
  JobContext inner = search.job;
  if (lengths.size() > 1) inner.jobs = 1;
  parallel_for(search.job.jobs, static_cast<int>(lengths.size()), [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    MotifSearch own = search;
    found[at] = seeds_of_length(own, lengths[at], active, inner);
    places[at] = own.places;
  });
  std::vector<MotifSeed> seeds;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    num_patterns += places[k] / (lengths[k] / 2.0);
    seeds.insert(seeds.end(), std::make_move_iterator(found[k].begin()), std::make_move_iterator(found[k].end()));
  }
  return seeds;
}

}  // namespace motex
