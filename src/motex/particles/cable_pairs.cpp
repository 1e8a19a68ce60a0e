// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Drawing the cores of two near cables again together: what they share of the image can change hands.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motex/particles/cable_moves.h"

namespace motex {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr int kLongestPair = 4;    // frames
constexpr double kFreeRadius = 5;  // pixels
constexpr int kSettlingRounds = 2;

}  // namespace

CoreBelief CableMoves::strand_belief(const Window& window, const Strand& strand, int k) const {
  const CoreElement* before = strand.before < 0 ? nullptr : &state_.element(window.frame - 1, strand.before);
  const CoreElement* after = strand.after < 0 ? nullptr : &state_.element(window.frame + window.num, strand.after);
  // the states at k − 2, k − 1, k + 1, k + 2 as far as they are known
  const auto state_at = [&](int i) -> const CoreState* {
    if (i >= 0 && i < window.num) {
      const bool is_drawn = window.direction > 0 ? i < k : i > k;
      return is_drawn ? &strand.states[static_cast<std::size_t>(i)] : nullptr;
    }
    if (i == -1) return before == nullptr ? nullptr : &before->z;
    if (i == window.num) return after == nullptr ? nullptr : &after->z;
    if (i == -2)
      return before == nullptr || before->previous < 0 ? nullptr
                                                       : &state_.element(window.frame - 2, before->previous).z;
    return after == nullptr || after->next < 0 ? nullptr
                                               : &state_.element(window.frame + window.num + 1, after->next).z;
  };
  const CoreState *b1 = state_at(k - 1), *b2 = b1 == nullptr ? nullptr : state_at(k - 2);
  const CoreState *a1 = state_at(k + 1), *a2 = a1 == nullptr ? nullptr : state_at(k + 2);
  CoreBelief belief = law_.belief(window.kind, b2, b1, a1, a2);
  const bool forward = window.direction > 0;
  const int ahead = forward ? window.num - k : k + 1;  // steps to the other side
  const CoreElement* far = forward ? after : before;
  const CoreState* near_state = forward ? b1 : a1;
  if (ahead > 1 && far != nullptr && near_state != nullptr)
    for (const std::size_t i : {std::size_t{kCoreX}, std::size_t{kCoreY}}) {
      const double deviation = 2 * law_.step_deviation(static_cast<int>(i), false) * ahead;
      const double mean = (*near_state)[i] + (far->z[i] - (*near_state)[i]) / (ahead + 1),
                   precision = 1 / (deviation * deviation);
      belief.mean[i] = (belief.mean[i] * belief.precision[i] + mean * precision) / (belief.precision[i] + precision);
      belief.precision[i] += precision;
    }
  return belief;
}

void CableMoves::look(const Window& window, const Strand& strand, int k) {
  const CoreBelief belief = strand_belief(window, strand, k);
  const ResidualFrame& image = state_.image(window.frame + k);
  if (belief.precision[kCoreX] > 0)
    proposal_.look_around(image, window.kind, belief);
  else
    proposal_.look_near(image, window.kind, belief, window.x, window.y, kFreeRadius);
}

/// Where the second core would be if both were where they fit best, found by turns from nothing but image and beliefs.
void CableMoves::settle_pair(const Window& window, const Strand& one, const Strand& two, int k, CoreState& best_two) {
  ResidualFrame& image = state_.image(window.frame + k);
  for (int round = 0; round < kSettlingRounds; ++round) {
    if (round > 0) paint_core(image, window.kind, best_two, -1);
    look(window, one, k);
    if (round > 0) paint_core(image, window.kind, best_two, 1);
    const CoreState best_one = proposal_.best();
    paint_core(image, window.kind, best_one, -1);
    look(window, two, k);
    paint_core(image, window.kind, best_one, 1);
    best_two = proposal_.best();
  }
}

CableMoves::PairDraw CableMoves::draw_strands(const Window& window, Strand& one, Strand* two, bool is_given) {
  PairDraw result;
  for (int step = 0; step < window.num; ++step) {
    const int k = window.direction > 0 ? step : window.num - 1 - step, frame = window.frame + k;
    const auto i = static_cast<std::size_t>(k);
    ResidualFrame& image = state_.image(frame);
    CoreState best_two{};
    if (two != nullptr) {
      settle_pair(window, one, *two, k, best_two);
      paint_core(image, window.kind, best_two, -1);
    }
    look(window, one, k);
    if (two != nullptr) paint_core(image, window.kind, best_two, 1);
    if (!is_given) one.states[i] = proposal_.draw(rng_);
    result.log_density += proposal_.log_density(one.states[i]);
    if (!law_.is_possible(window.kind, one.states[i])) return {kNever, 0};
    result.explained += explained(frame, window.kind, one.states[i]);
    if (two == nullptr) continue;
    paint_core(image, window.kind, one.states[i], -1);
    look(window, *two, k);
    if (!is_given) two->states[i] = proposal_.draw(rng_);
    result.log_density += proposal_.log_density(two->states[i]);
    result.explained += explained(frame, window.kind, two->states[i]);
    paint_core(image, window.kind, one.states[i], 1);
    if (!law_.is_possible(window.kind, two->states[i])) return {kNever, 0};
  }
  return result;
}

double CableMoves::junction(const Window& window, const Strand& strand) const {
  return junction(window.kind, window.frame, strand.before,
                  std::span(strand.states.data(), static_cast<std::size_t>(window.num)), strand.after);
}

/// The strand that leads from an element beside the window through it. False when it ends inside.
bool CableMoves::follow(const Window& window, int anchor, Strand& strand) const {
  const bool forward = window.direction > 0;
  int frame = forward ? window.frame - 1 : window.frame + window.num, idx = anchor;
  (forward ? strand.before : strand.after) = anchor;
  for (int step = 0; step < window.num; ++step) {
    const CoreElement& element = state_.element(frame, idx);
    idx = forward ? element.next : element.previous;
    if (idx < 0) return false;
    frame += window.direction;
    const auto k = static_cast<std::size_t>(frame - window.frame);
    strand.indices[k] = idx;
    strand.states[k] = state_.element(frame, idx).z;
  }
  const CoreElement& last = state_.element(frame, idx);
  (forward ? strand.after : strand.before) = forward ? last.next : last.previous;
  return true;
}

void CableMoves::show(const Window& window, const Strand& strand, float sign) {
  show(window.frame, std::span<const int>(strand.indices.data(), static_cast<std::size_t>(window.num)), sign);
}

void CableMoves::settle(const Window& window, Strand& strand, const std::array<CoreState, kMaxPath>& states) {
  for (int k = 0; k < window.num; ++k) {
    const auto i = static_cast<std::size_t>(k);
    state_.place(window.frame + k, strand.indices[i], states[i]);
  }
}

void CableMoves::pair(int frame) {
  const int num = 1 + static_cast<int>(rng_.below(kLongestPair));
  const int direction = rng_.below(2) == 0 ? 1 : -1;
  const bool swaps = rng_.below(2) == 0;
  const int anchor_frame = direction > 0 ? frame - 1 : frame + num, far_frame = direction > 0 ? frame + num : frame - 1;
  if (anchor_frame < 0 || anchor_frame >= state_.num_frames() || !range_.holds(frame) ||
      !range_.holds(frame + num - 1) || (swaps && !range_.holds(far_frame)))
    return;
  const int a = pick(anchor_frame), b = a < 0 ? -1 : pick_near(anchor_frame, a);
  if (b < 0) return;
  const Window window{state_.element(anchor_frame, a).kind, frame, num, direction};
  Strand one, two;
  if (!follow(window, a, one) || !follow(window, b, two)) return;
  Strand new_one = one, new_two = two;
  if (swaps) {
    int &far_one = direction > 0 ? new_one.after : new_one.before,
        &far_two = direction > 0 ? new_two.after : new_two.before;
    if (far_one < 0 && far_two < 0) return;
    std::swap(far_one, far_two);
  }
  show(window, one, 1);
  show(window, two, 1);
  const PairDraw back = draw_strands(window, one, &two, true), there = draw_strands(window, new_one, &new_two, false);
  const double change = there.log_density == kNever
                            ? kNever
                            : there.explained - back.explained + junction(window, new_one) + junction(window, new_two) -
                                  junction(window, one) - junction(window, two);
  if (accept(swaps ? CableJump::kPairSwap : CableJump::kPairRedraw, change, back.log_density - there.log_density)) {
    settle(window, one, new_one.states);
    settle(window, two, new_two.states);
    if (swaps) {
      const int last = frame + num - 1;
      const auto end = static_cast<std::size_t>(num - 1);
      if (direction > 0) {
        state_.cut_after(last, one.indices[end]);
        state_.cut_after(last, two.indices[end]);
        if (new_one.after >= 0) state_.link(last, one.indices[end], new_one.after);
        if (new_two.after >= 0) state_.link(last, two.indices[end], new_two.after);
      } else {
        if (one.before >= 0) state_.cut_after(frame - 1, one.before);
        if (two.before >= 0) state_.cut_after(frame - 1, two.before);
        if (new_one.before >= 0) state_.link(frame - 1, new_one.before, one.indices[0]);
        if (new_two.before >= 0) state_.link(frame - 1, new_two.before, two.indices[0]);
      }
    }
  }
  show(window, one, -1);
  show(window, two, -1);
}

void CableMoves::pair_fill(int frame) {
  const bool to_other_side = rng_.below(2) == 0;
  const int direction = to_other_side || rng_.below(2) == 0 ? 1 : -1;
  const int num = 1 + static_cast<int>(rng_.below(kLongestPair - 1));
  const int anchor_frame = direction > 0 ? frame - 1 : frame + num;
  if (!range_.holds(anchor_frame) || !range_.holds(frame) || !range_.holds(frame + num - 1) ||
      (to_other_side && !range_.holds(frame + num)))
    return;
  const int a = pick(anchor_frame), b = a < 0 ? -1 : pick_near(anchor_frame, a);
  if (b < 0) return;
  const CoreElement& anchor = state_.element(anchor_frame, a);
  const Window window{anchor.kind, frame, num, direction};
  Strand partner;
  if (!follow(window, b, partner)) return;
  if ((direction > 0 ? anchor.next : anchor.previous) < 0)
    fill_with_partner(window, partner, a, to_other_side);
  else
    cut_with_partner(window, partner, a, to_other_side);
}

void CableMoves::fill_with_partner(Window window, Strand partner, int anchor, bool to_other_side) {
  for (int k = 0; k < window.num; ++k)
    if (!has_room(window.frame + k)) return;
  const bool forward = window.direction > 0;
  Strand fresh, moved = partner;
  (forward ? fresh.before : fresh.after) = anchor;
  double log_choice = 0;
  if (to_other_side) {
    find_followers(window.frame - 1, anchor, window.num);
    fresh.after = choose_follower();
    if (fresh.after < 0 || fresh.after == partner.after) return;
    log_choice = log_share(fresh.after);
  }
  Strand empty;
  (forward ? empty.before : empty.after) = anchor;
  show(window, partner, 1);
  const PairDraw back = draw_strands(window, partner, nullptr, true),
                 there = draw_strands(window, fresh, &moved, false);
  double change = kNever;
  if (there.log_density > kNever) {
    const int last = window.frame + window.num;
    change = there.explained - back.explained + junction(window, moved) - junction(window, partner) +
             junction(window, fresh);
    if (forward) change -= junction(window.kind, window.frame, anchor, {}, -1);
    if (!forward) change -= junction(window.kind, last, -1, {}, anchor);
    if (to_other_side) change -= junction(window.kind, last, -1, {}, fresh.after);
  }
  const bool accepted = accept(to_other_side ? CableJump::kPairBridge : CableJump::kPairExtend, change,
                               back.log_density - there.log_density - log_choice);
  if (accepted) settle(window, partner, moved.states);
  show(window, partner, -1);
  if (!accepted) return;
  int before = fresh.before;
  for (int k = 0; k < window.num; ++k) {
    const int added = state_.add(window.frame + k, window.kind, fresh.states[static_cast<std::size_t>(k)]);
    if (before >= 0) state_.link(window.frame + k - 1, before, added);
    before = added;
  }
  if (fresh.after >= 0) state_.link(window.frame + window.num - 1, before, fresh.after);
}

void CableMoves::cut_with_partner(Window window, Strand partner, int anchor, bool to_other_side) {
  const bool forward = window.direction > 0;
  Strand gone, moved = partner;
  if (!follow(window, anchor, gone)) return;
  const int far = forward ? gone.after : gone.before;
  if (to_other_side != (far >= 0)) return;
  show(window, partner, 1);
  show(window, gone, 1);
  const PairDraw back = draw_strands(window, gone, &partner, true), there = draw_strands(window, moved, nullptr, false);
  double change = kNever, log_choice = 0;
  if (there.log_density > kNever) {
    const int last = window.frame + window.num;
    change =
        there.explained - back.explained + junction(window, moved) - junction(window, partner) - junction(window, gone);
    if (forward) change += junction(window.kind, window.frame, anchor, {}, -1);
    if (!forward) change += junction(window.kind, last, -1, {}, anchor);
    if (to_other_side) change += junction(window.kind, last, -1, {}, far);
  }
  const auto end = static_cast<std::size_t>(window.num - 1);
  if (to_other_side) {
    state_.cut_after(window.frame - 1, anchor);
    state_.cut_after(window.frame + window.num - 1, gone.indices[end]);
    find_followers(window.frame - 1, anchor, window.num);
    log_choice = log_share(far);
  }
  const bool accepted = accept(to_other_side ? CableJump::kPairCut : CableJump::kPairShrink, change,
                               back.log_density + log_choice - there.log_density);
  if (accepted) settle(window, partner, moved.states);
  show(window, partner, -1);
  show(window, gone, -1);
  if (!accepted) {
    if (to_other_side) {
      state_.link(window.frame - 1, anchor, gone.indices[0]);
      state_.link(window.frame + window.num - 1, gone.indices[end], far);
    }
    return;
  }
  if (!to_other_side && forward) state_.cut_after(window.frame - 1, anchor);
  for (int k = 0; k < window.num; ++k) {
    const int idx = gone.indices[static_cast<std::size_t>(k)];
    state_.cut_after(window.frame + k, idx);
    state_.remove(window.frame + k, idx);
  }
}

}  // namespace motex
