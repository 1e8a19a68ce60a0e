// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "motex/core/error.h"
#include "motex/markov/sliding_maximum.h"

namespace motex {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr float kLargestFloat = std::numeric_limits<float>::max();

double sum_scored_frames(const SegmentationInput& input, const Segment& segment) {
  double sum = 0;
  for (Index t = segment.start + input.options.num_start_frames; t < segment.start + segment.length; ++t) {
    sum += static_cast<double>(input.emissions(t, segment.state));
  }
  return sum;
}

double start_density(const SegmentationInput& input, Index frame) {
  return input.start_log_density.empty() ? 0 : input.start_log_density[static_cast<std::size_t>(frame)];
}

double start_density(const SegmentationInput& input, Index frame, int state) {
  const auto& own = input.state_start_log_density;
  return start_density(input, frame) + (own.size() == 0 ? 0 : static_cast<double>(own(frame, state)));
}

[[noreturn]] void throw_not_a_density(const char* what, Index frame) {
  throw NumericalFailure("segmentation: " + std::string(what) + " at frame " + std::to_string(frame) +
                         " is NaN or +infinity; a log-likelihood is a number or -infinity");
}

// A sequence too short for the recursion is one segment of the best state.
SegmentationReport segment_as_one(const SegmentationInput& input) {
  SegmentationReport report;
  const Segment whole{0, 0, input.emissions.rows()};
  for (Index i = 0; i < input.emissions.cols(); ++i) {
    Segment candidate = whole;
    candidate.state = static_cast<int>(i);
    const double score = segment_score(input, candidate);
    if (!(score < std::numeric_limits<double>::infinity())) throw_not_a_density("the likelihood of a segment", 0);
    if (score > report.score) {
      report.score = score;
      report.segments = {candidate};
    }
  }
  return report;
}

// The forward pass. Rows of N numbers, one a state; in formulas the letters of the header.
class Recursion {
 public:
  explicit Recursion(const SegmentationInput& input);
  SegmentationReport run();

 private:
  struct BestEnd {
    double score = kImpossible;
    std::int32_t state = -1;
  };
  void find_best_ends(Index b);
  // A start that is best reached by a counted transition.
  struct Winner {
    std::int32_t state;
    std::int32_t predecessor;
  };
  void find_best_uncounted(Index b);
  bool improve_by_counted(double uncounted, double* E);
  void keep_winners();
  int predecessor(Index b, int state) const;
  void open_candidates(Index b);
  void add_frame(Index t);
  void add_odd_frame(Index t, const float* F);
  void admit_candidates(Index b);
  void close_frame(Index t);
  SegmentationReport trace_back() const;
  double* candidates(Index b) { return &candidates_[static_cast<std::size_t>(b % min_length_ * num_states_)]; }

  const SegmentationInput& input_;
  const LogTransitions transitions_;
  const Index num_frames_, num_states_, min_length_, num_start_frames_;
  const bool has_prior_;
  std::vector<double> sums_, ends_;  // N: S_i and G_i after the last frame
  std::vector<double> candidates_;   // T_min × N ring of E_i(b) + init(b) − S_i(b+s−1) that are still too short
  SlidingMaximum openings_;          // H_i and the b that gives it
  std::unique_ptr<std::int32_t[]> starts_;   // T × N: start of the best last segment that ends at t
  std::vector<double> largest_counted_;      // N: largest log M_lj of a counted transition from l
  std::vector<BestEnd> best_uncounted_;      // T: of E_i(t)
  std::vector<Winner> winners_;              // of all t; those of t begin at winners_begin_[t]
  std::vector<std::size_t> winners_begin_;   // T + 1
  std::vector<std::int32_t> improved_from_;  // N: predecessors while one t is worked on, −1 elsewhere
  std::vector<Index> last_impossible_;       // N, empty while every emission is finite
};

Index window_of(const SegmentationInput& input) {
  const SegmentOptions& options = input.options;
  const bool limited = options.max_length > 0 && options.max_length < input.emissions.rows();
  return limited ? options.max_length - options.min_length + 1 : 0;
}

Recursion::Recursion(const SegmentationInput& input)
    : input_(input),
      transitions_(input.transitions.log_transitions()),
      num_frames_(input.emissions.rows()),
      num_states_(input.emissions.cols()),
      min_length_(input.options.min_length),
      num_start_frames_(input.options.num_start_frames),
      has_prior_(input.transitions.prior_count() > 0),
      openings_(num_states_, window_of(input)) {
  const auto n = static_cast<std::size_t>(num_states_), frames = static_cast<std::size_t>(num_frames_);
  sums_.assign(n, 0);
  ends_.assign(n, kImpossible);
  candidates_.resize(static_cast<std::size_t>(min_length_) * n);
  starts_ = std::make_unique_for_overwrite<std::int32_t[]>(frames * n);
  best_uncounted_.resize(frames);
  winners_begin_.assign(frames + 1, 0);
  improved_from_.assign(n, -1);
  if (!has_prior_) winners_.reserve(frames * n);  // nearly all are; pages count only when they are written
  for (int l = 0; l < num_states_; ++l) {
    double largest = kImpossible;
    for (const auto& entry : transitions_.row(l)) largest = std::max(largest, entry.log_prob);
    largest_counted_.push_back(largest);
  }
}

SegmentationReport Recursion::run() {
  for (Index t = 0; t < num_frames_; ++t) {
    find_best_ends(t);
    if (num_start_frames_ == 0) open_candidates(t);
    add_frame(t);
    if (num_start_frames_ > 0 && t + 1 >= num_start_frames_) open_candidates(t + 1 - num_start_frames_);
    if (t + 1 >= min_length_) admit_candidates(t + 1 - min_length_);
    close_frame(t);
  }
  return trace_back();
}

// E_i(b) into candidates(b): one value for all states but those that a counted transition wins.
void Recursion::find_best_ends(Index b) {
  const auto k = static_cast<std::size_t>(b);
  double* E = candidates(b);
  if (b == 0) {
    std::fill_n(E, num_states_, 0.0);
  } else {
    if (has_prior_) find_best_uncounted(b);
    std::fill_n(E, num_states_, best_uncounted_[k].score);
    if (improve_by_counted(best_uncounted_[k].score, E)) keep_winners();
  }
  winners_begin_[k + 1] = winners_.size();
}

bool Recursion::improve_by_counted(double uncounted, double* E) {
  bool any = false;
  for (int l = 0; l < num_states_; ++l) {
    const double G = ends_[static_cast<std::size_t>(l)];
    if (G + largest_counted_[static_cast<std::size_t>(l)] <= uncounted) continue;  // most rows, when there is a prior
    any = true;
    for (const auto& entry : transitions_.row(l)) {
      const double end = G + entry.log_prob;
      std::int32_t& from = improved_from_[static_cast<std::size_t>(entry.to)];
      const bool larger = end > E[entry.to];
      from = larger ? l : from;
      E[entry.to] = larger ? end : E[entry.to];
    }
  }
  return any;
}

void Recursion::keep_winners() {
  std::size_t count = winners_.size();
  winners_.resize(count + static_cast<std::size_t>(num_states_));
  for (std::int32_t i = 0; i < num_states_; ++i) {
    std::int32_t& from = improved_from_[static_cast<std::size_t>(i)];
    winners_[count] = {i, from};
    count += from >= 0 ? 1 : 0;
    from = -1;
  }
  winners_.resize(count);
}

// max_l [G_l(b−1) + base_l] is the same for every state.
void Recursion::find_best_uncounted(Index b) {
  constexpr Index kLanes = 8;  // independent maxima, which vectorise
  const double* G = ends_.data();
  const double* base = transitions_.base.data();
  std::array<double, kLanes> lanes;
  lanes.fill(kImpossible);
  Index i = 0;
  for (; i + kLanes <= num_states_; i += kLanes) {
    for (Index k = 0; k < kLanes; ++k) {
      const double end = G[i + k] + base[i + k];
      const auto lane = static_cast<std::size_t>(k);
      lanes[lane] = end > lanes[lane] ? end : lanes[lane];
    }
  }
  double best = *std::max_element(lanes.begin(), lanes.end());
  for (; i < num_states_; ++i) best = std::max(best, G[i] + base[i]);
  Index l = 0;
  while (l + 1 < num_states_ && G[l] + base[l] != best) ++l;
  best_uncounted_[static_cast<std::size_t>(b)] = {best, static_cast<std::int32_t>(l)};
}

// E_i(b) + init(b) + init_i(b) − S_i(b+s−1), once that sum is known.
void Recursion::open_candidates(Index b) {
  const double init = start_density(input_, b);
  if (!(init < std::numeric_limits<double>::infinity())) throw_not_a_density("the start density", b);
  double* __restrict row = candidates(b);
  const double* __restrict S = sums_.data();
  for (Index i = 0; i < num_states_; ++i) row[i] = row[i] + init - S[i];
  const auto& own_init = input_.state_start_log_density;
  if (own_init.size() == 0) return;
  const float* __restrict own = own_init.data() + b * own_init.outerStride();
  for (Index i = 0; i < num_states_; ++i) {
    if (!(own[i] <= kLargestFloat)) throw_not_a_density("the start density of a state", b);
    row[i] += static_cast<double>(own[i]);
  }
}

void Recursion::add_frame(Index t) {
  const float* __restrict F = input_.emissions.data() + t * input_.emissions.outerStride();
  int num_odd = 0;
  for (Index i = 0; i < num_states_; ++i) num_odd += std::abs(F[i]) <= kLargestFloat ? 0 : 1;
  if (num_odd > 0) return add_odd_frame(t, F);
  double* __restrict S = sums_.data();
  for (Index i = 0; i < num_states_; ++i) S[i] += static_cast<double>(F[i]);
}

// −∞ stays out of the sums, which could not be undone; it ends all that the state had begun instead.
void Recursion::add_odd_frame(Index t, const float* F) {
  if (last_impossible_.empty()) last_impossible_.assign(static_cast<std::size_t>(num_states_), -1);
  for (Index i = 0; i < num_states_; ++i) {
    if (!(F[i] <= kLargestFloat)) throw_not_a_density("the emission", t);
    const auto k = static_cast<std::size_t>(i);
    if (F[i] >= -kLargestFloat) {
      sums_[k] += static_cast<double>(F[i]);
    } else {
      openings_.forget(i);
      last_impossible_[k] = t;
    }
  }
}

// Segments from b are now long enough to end.
void Recursion::admit_candidates(Index b) {
  double* row = candidates(b);
  if (!last_impossible_.empty()) {
    for (Index i = 0; i < num_states_; ++i) {
      if (b + num_start_frames_ <= last_impossible_[static_cast<std::size_t>(i)]) row[i] = kImpossible;
    }
  }
  openings_.push(row);
}

void Recursion::close_frame(Index t) {
  const double* __restrict S = sums_.data();
  const double* __restrict H = openings_.values().data();
  double* __restrict G = ends_.data();
  for (Index i = 0; i < num_states_; ++i) G[i] = S[i] + H[i];
  std::copy(openings_.positions().begin(), openings_.positions().end(),
            &starts_[static_cast<std::size_t>(t * num_states_)]);
}

int Recursion::predecessor(Index b, int state) const {
  const auto k = static_cast<std::size_t>(b);
  const auto first = winners_.begin() + static_cast<std::ptrdiff_t>(winners_begin_[k]);
  const auto last = winners_.begin() + static_cast<std::ptrdiff_t>(winners_begin_[k + 1]);
  const auto place = std::find_if(first, last, [&](const Winner& w) { return w.state == state; });
  return place != last ? place->predecessor : best_uncounted_[k].state;
}

SegmentationReport Recursion::trace_back() const {
  SegmentationReport report;
  const auto best = std::max_element(ends_.begin(), ends_.end());
  if (*best == kImpossible) return report;
  report.score = *best;
  auto state = static_cast<int>(best - ends_.begin());
  for (Index end = num_frames_;;) {
    const Index b = starts_[static_cast<std::size_t>((end - 1) * num_states_ + state)];
    report.segments.push_back({state, b, end - b});
    if (b == 0) break;
    state = predecessor(b, state);
    end = b;
  }
  std::reverse(report.segments.begin(), report.segments.end());
  return report;
}

}  // namespace

void check_segmentation_input(const SegmentationInput& input) {
  const SegmentOptions& options = input.options;
  const Index T = input.emissions.rows(), N = input.emissions.cols();
  const auto fail = [](const std::string& message) { throw InvalidInput("segmentation: " + message); };
  if (options.min_length < 1) fail("min_length must be at least 1 frame");
  if (options.max_length != 0 && options.max_length < options.min_length) fail("max_length is less than min_length");
  if (options.num_start_frames < 0 || options.num_start_frames > options.min_length) {
    fail("num_start_frames must lie in 0 … min_length");
  }
  if (N < 1 || input.transitions.num_states() != N) {
    fail(std::to_string(N) + " columns of emissions, but " + std::to_string(input.transitions.num_states()) +
         " states in the transition matrix");
  }
  if (!input.start_log_density.empty() && static_cast<Index>(input.start_log_density.size()) != T) {
    fail(std::to_string(T) + " frames of emissions, but " + std::to_string(input.start_log_density.size()) +
         " start densities");
  }
  const auto& own = input.state_start_log_density;
  if (own.size() > 0 && (own.rows() != T || own.cols() != N)) {
    fail("start densities of states for " + std::to_string(own.rows()) + " frames and " + std::to_string(own.cols()) +
         " states, but " + std::to_string(T) + " and " + std::to_string(N) + " in the emissions");
  }
  if (T <= options.num_start_frames) {
    fail("a sequence of " + std::to_string(T) + " frames is too short; it needs at least " +
         std::to_string(options.num_start_frames + 1));
  }
  if (T > std::numeric_limits<std::int32_t>::max()) fail("a sequence may have at most 2147483647 frames");
}

SegmentationReport segment_sequence(const SegmentationInput& input) {
  check_segmentation_input(input);
  if (input.emissions.rows() < input.options.min_length) return segment_as_one(input);
  return Recursion(input).run();
}

double segment_score(const SegmentationInput& input, const Segment& segment) {
  return start_density(input, segment.start, segment.state) + sum_scored_frames(input, segment);
}

double score_segmentation(const SegmentationInput& input, std::span<const Segment> segments) {
  check_segmentation_input(input);
  const SegmentOptions& options = input.options;
  const Index T = input.emissions.rows();
  double score = 0;
  Index end = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Segment& segment = segments[k];
    const std::string where = "segmentation: segment " + std::to_string(k);
    if (segment.start != end) throw InvalidInput(where + " does not start where the one before it ends");
    if (segment.state < 0 || segment.state >= input.emissions.cols()) throw InvalidInput(where + " has no such state");
    const bool is_short = segment.length < std::min(options.min_length, T);
    const bool is_long = options.max_length > 0 && segment.length > options.max_length;
    if (is_short || is_long || segment.length > T - end) {
      throw InvalidInput(where + " is " + std::to_string(segment.length) + " frames long, which is not allowed");
    }
    score += segment_score(input, segment);
    if (k > 0) score += input.transitions.log_prob(segments[k - 1].state, segment.state);
    end += segment.length;
  }
  if (end != T)
    throw InvalidInput("segmentation: segments end at frame " + std::to_string(end) + " of " + std::to_string(T));
  return score;
}

}  // namespace motex
