// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Merge and split where two elements lie on one another: the core at the seam and one beside it are drawn again.
#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/particles/cable_moves.h"

namespace motex {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr double kTieRadius = 7;   // pixels around the expected place
constexpr double kTieWidth = 2.5;  // deviation of the weights of those that may be tied

}  // namespace

/// The element whose cable is to go on into `frame`, and where it is expected there.
struct CableMoves::Tie {
  BaseKind kind;
  int frame, direction;
  double x, y;
};

/// Share of the candidate among the loose ends of the frame (or, with `chosen`, draws one).
double CableMoves::tie_share(const Tie& tie, int candidate, int* chosen) {
  found_.clear();
  state_.near(tie.frame, tie.x, tie.y, kTieRadius, found_);
  followers_.clear();
  follower_weights_.clear();
  follower_sum_ = 0;
  for (const int idx : found_) {
    const CoreElement& element = state_.element(tie.frame, idx);
    if (element.kind != tie.kind || (tie.direction > 0 ? element.previous : element.next) >= 0) continue;
    const double dx = element.z[kCoreX] - tie.x, dy = element.z[kCoreY] - tie.y;
    followers_.push_back(idx);
    follower_weights_.push_back(std::exp(-(dx * dx + dy * dy) / (2 * kTieWidth * kTieWidth)));
    follower_sum_ += follower_weights_.back();
  }
  if (chosen != nullptr) candidate = *chosen = choose_follower();
  return log_share(candidate);
}

/// Number of those beside the candidate, 0 when `wanted` is not among them; with `chosen`, draws one.
int CableMoves::tie_partners(const Tie& tie, int candidate, int* chosen, int wanted) {
  found_.clear();
  state_.near(tie.frame, tie.x, tie.y, kTieRadius, found_);
  std::erase_if(found_, [&](int idx) { return idx == candidate || state_.element(tie.frame, idx).kind != tie.kind; });
  if (found_.empty()) return 0;
  if (chosen != nullptr) wanted = *chosen = found_[rng_.below(found_.size())];
  return std::find(found_.begin(), found_.end(), wanted) == found_.end() ? 0 : static_cast<int>(found_.size());
}

void CableMoves::pair_tie(int frame) {
  const int direction = rng_.below(2) == 0 ? 1 : -1, anchor_frame = frame - direction;
  if (!range_.holds(frame) || !range_.holds(anchor_frame)) return;
  const int anchor = pick(anchor_frame);
  if (anchor < 0) return;
  const CoreElement& element = state_.element(anchor_frame, anchor);
  int at = direction > 0 ? element.next : element.previous;
  const bool is_tied = at >= 0;
  Window window{element.kind, frame, 1, direction};
  Strand probe;
  (direction > 0 ? probe.before : probe.after) = anchor;
  const CoreBelief expected = strand_belief(window, probe, 0);
  const Tie tie{element.kind, frame, direction, expected.mean[kCoreX], expected.mean[kCoreY]};
  window.x = tie.x;
  window.y = tie.y;
  double log_choice = is_tied ? 0 : tie_share(tie, -1, &at);
  if (at < 0) return;
  int beside = -1;
  const int num_before = tie_partners(tie, at, &beside, -1);
  if (num_before == 0) return;

  const auto strand_of = [&](int idx) {
    const CoreElement& e = state_.element(frame, idx);
    Strand strand;
    strand.before = e.previous;
    strand.after = e.next;
    strand.indices[0] = idx;
    strand.states[0] = e.z;
    return strand;
  };
  Strand one = strand_of(at), two = strand_of(beside), new_one = one, new_two = two;
  (direction > 0 ? new_one.before : new_one.after) = is_tied ? -1 : anchor;
  show(window, one, 1);
  show(window, two, 1);
  const PairDraw back = draw_strands(window, one, &two, true), there = draw_strands(window, new_one, &new_two, false);
  if (there.log_density == kNever) {
    accept(is_tied ? CableJump::kPairSplit : CableJump::kPairMerge, kNever, 0);
    show(window, one, -1);
    show(window, two, -1);
    return;
  }
  // with the anchor's own end
  const auto loose = direction > 0 ? junction(window.kind, frame, anchor, {}, -1)
                                   : junction(window.kind, anchor_frame, -1, {}, anchor);
  const double change = there.explained - back.explained + junction(window, new_one) + junction(window, new_two) -
                        junction(window, one) - junction(window, two) + (is_tied ? loose : -loose);
  state_.place(frame, at, new_one.states[0]);
  state_.place(frame, beside, new_two.states[0]);
  const auto set_tie = [&](bool tied) {
    const int first = std::min(frame, anchor_frame), left = direction > 0 ? anchor : at,
              right = direction > 0 ? at : anchor;
    if (tied)
      state_.link(first, left, right);
    else
      state_.cut_after(first, left);
  };
  if (is_tied) set_tie(false);
  if (is_tied) log_choice = -tie_share(tie, at, nullptr);
  const int num_after = tie_partners(tie, at, nullptr, beside);
  const double log_hastings = num_after == 0 ? kNever
                                             : back.log_density - there.log_density - log_choice +
                                                   std::log(static_cast<double>(num_before) / num_after);
  if (accept(is_tied ? CableJump::kPairSplit : CableJump::kPairMerge, change, log_hastings)) {
    if (!is_tied) set_tie(true);
  } else {
    state_.place(frame, at, one.states[0]);
    state_.place(frame, beside, two.states[0]);
    if (is_tied) set_tie(true);
  }
  show(window, one, -1);
  show(window, two, -1);
}

}  // namespace motex
