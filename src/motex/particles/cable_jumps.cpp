// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// The moves of cable_moves.h that change how many elements there are.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "motex/particles/cable_moves.h"

namespace motex {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr int kMaxGap = 3;
constexpr int kShortestWhole = 2;
constexpr std::uint64_t kCutOneIn = 16;  // ends are rare, and most cuts are hopeless: proposed so much less often
const double kLogBridgesPerCut = std::log(static_cast<double>(kCutOneIn - 1));

bool is_single(const CoreElement& element) { return element.previous < 0 && element.next < 0; }

}  // namespace

void CableMoves::birth_or_death(int frame) {
  if (!range_.holds(frame)) return;
  const int cell = pick_cell(frame);
  if (rng_.below(2) == 0)
    birth(frame, cell);
  else
    death(frame, cell);
}

void CableMoves::birth(int frame, int cell) {
  const BaseKind kind = law_.prior().kind;
  if (!has_room(frame) ||
      !proposal_.look_in_cell(state_.image(frame), kind, law_.belief(kind, nullptr, nullptr, nullptr, nullptr),
                              state_.cell(cell)))
    return;
  const std::array<CoreState, 1> z{proposal_.draw(rng_)};
  int num_single = 1;
  for (const int idx : state_.in_cell(frame, cell)) {
    const CoreElement& element = state_.element(frame, idx);
    num_single += is_single(element) && element.kind == kind ? 1 : 0;
  }
  const bool is_possible = law_.is_possible(kind, z[0]) && state_.cell_of(z[0]) == cell;
  const double change = is_possible ? explained(frame, kind, z[0]) + junction(kind, frame, -1, z, -1) : kNever;
  if (accept(CableJump::kBirth, change, is_possible ? -proposal_.log_density(z[0]) - std::log(num_single) : 0))
    state_.add(frame, kind, z[0]);
}

void CableMoves::death(int frame, int cell) {
  const BaseKind kind = law_.prior().kind;
  found_.clear();
  for (const int idx : state_.in_cell(frame, cell)) {
    const CoreElement& element = state_.element(frame, idx);
    if (is_single(element) && element.kind == kind) found_.push_back(idx);
  }
  if (found_.empty()) return;
  const int idx = found_[rng_.below(found_.size())];
  const auto num_single = static_cast<double>(found_.size());
  const std::array<CoreState, 1> z{state_.element(frame, idx).z};
  state_.paint(frame, idx, 1);
  const bool has_peak = proposal_.look_in_cell(
      state_.image(frame), kind, law_.belief(kind, nullptr, nullptr, nullptr, nullptr), state_.cell(cell));
  const double change = -explained(frame, kind, z[0]) - junction(kind, frame, -1, z, -1);
  const bool accepted =
      accept(CableJump::kDeath, change, has_peak ? proposal_.log_density(z[0]) + std::log(num_single) : kNever);
  state_.paint(frame, idx, -1);
  if (accepted) state_.remove(frame, idx);
}

void CableMoves::extend_or_shrink(int frame, int direction) {
  if (!range_.holds(frame) || !range_.holds(frame + direction)) return;
  const int idx = pick(frame);
  if (idx < 0) return;
  const CoreElement& element = state_.element(frame, idx);
  const int beyond = direction > 0 ? element.next : element.previous;
  if (beyond < 0) return extend(frame, idx, direction);
  const CoreElement& last = state_.element(frame + direction, beyond);
  if ((direction > 0 ? last.next : last.previous) < 0) shrink(frame, idx, direction);
}

void CableMoves::extend(int frame, int idx, int direction) {
  const int new_frame = frame + direction;
  if (!has_room(new_frame)) return;
  const BaseKind kind = state_.element(frame, idx).kind;
  const int before = direction > 0 ? idx : -1, after = direction > 0 ? -1 : idx;
  std::array<CoreState, 1> z{};
  const double log_density = draw_path(path_between(kind, new_frame, before, 1, after), z, false);
  if (log_density == kNever) {
    accept(CableJump::kExtend, kNever, 0);
    return;
  }
  const double change = explained(new_frame, kind, z[0]) + junction(kind, new_frame, before, z, after) -
                        (direction > 0 ? junction(kind, new_frame, idx, {}, -1) : junction(kind, frame, -1, {}, idx));
  if (!accept(CableJump::kExtend, change, -log_density)) return;
  const int added = state_.add(new_frame, kind, z[0]);
  if (direction > 0)
    state_.link(frame, idx, added);
  else
    state_.link(new_frame, added, idx);
}

void CableMoves::shrink(int frame, int idx, int direction) {
  const int old_frame = frame + direction;
  const CoreElement& element = state_.element(frame, idx);
  const BaseKind kind = element.kind;
  const int end = direction > 0 ? element.next : element.previous;
  const int before = direction > 0 ? idx : -1, after = direction > 0 ? -1 : idx;
  std::array<CoreState, 1> z{state_.element(old_frame, end).z};
  state_.paint(old_frame, end, 1);
  const double log_density = draw_path(path_between(kind, old_frame, before, 1, after), z, true);
  const double change = (direction > 0 ? junction(kind, old_frame, idx, {}, -1) : junction(kind, frame, -1, {}, idx)) -
                        explained(old_frame, kind, z[0]) - junction(kind, old_frame, before, z, after);
  const bool accepted = accept(CableJump::kShrink, change, log_density);
  state_.paint(old_frame, end, -1);
  if (!accepted) return;
  state_.cut_after(std::min(frame, old_frame), direction > 0 ? idx : end);
  state_.remove(old_frame, end);
}

void CableMoves::bridge_or_cut(int frame) {
  const int gap = 1 + static_cast<int>(rng_.below(kMaxGap));
  if (!range_.holds(frame) || !range_.holds(frame + gap + 1)) return;
  const int idx = pick(frame);
  if (idx < 0) return;
  const bool is_cut = rng_.below(kCutOneIn) == 0;
  if (state_.element(frame, idx).next < 0) {
    if (!is_cut) bridge(frame, idx, gap);
  } else if (is_cut) {
    cut(frame, idx, gap);
  }
}

void CableMoves::bridge(int frame, int idx, int gap) {
  for (int k = 1; k <= gap; ++k)
    if (!has_room(frame + k)) return;
  find_followers(frame, idx, gap);
  const int after = choose_follower();
  if (after < 0) return;
  const BaseKind kind = state_.element(frame, idx).kind;
  std::array<CoreState, kMaxGap> states{};
  const std::span filled(states.data(), static_cast<std::size_t>(gap));
  const double log_density = draw_path(path_between(kind, frame + 1, idx, gap, after), filled, false);
  if (log_density == kNever) {
    accept(CableJump::kBridge, kNever, 0);
    return;
  }
  double change = junction(kind, frame + 1, idx, filled, after) - junction(kind, frame + 1, idx, {}, -1) -
                  junction(kind, frame + gap + 1, -1, {}, after);
  for (int k = 0; k < gap; ++k) change += explained(frame + 1 + k, kind, filled[static_cast<std::size_t>(k)]);
  if (!accept(CableJump::kBridge, change, -log_density - log_share(after) - kLogBridgesPerCut)) return;
  int last = idx;
  for (int k = 0; k < gap; ++k) {
    const int added = state_.add(frame + 1 + k, kind, filled[static_cast<std::size_t>(k)]);
    state_.link(frame + k, last, added);
    last = added;
  }
  state_.link(frame + gap, last, after);
}

void CableMoves::cut(int frame, int idx, int gap) {
  std::array<int, kMaxGap> indices{};
  std::array<CoreState, kMaxGap> states{};
  int at = state_.element(frame, idx).next;
  for (int k = 0; k < gap; ++k) {
    if (at < 0) return;
    indices[static_cast<std::size_t>(k)] = at;
    states[static_cast<std::size_t>(k)] = state_.element(frame + 1 + k, at).z;
    at = state_.element(frame + 1 + k, at).next;
  }
  if (at < 0) return;
  const BaseKind kind = state_.element(frame, idx).kind;
  const std::span filled(states.data(), static_cast<std::size_t>(gap));
  const std::span<const int> members(indices.data(), static_cast<std::size_t>(gap));
  show(frame + 1, members, 1);
  double change = junction(kind, frame + 1, idx, {}, -1) + junction(kind, frame + gap + 1, -1, {}, at) -
                  junction(kind, frame + 1, idx, filled, at);
  for (int k = 0; k < gap; ++k) change -= explained(frame + 1 + k, kind, filled[static_cast<std::size_t>(k)]);
  const double log_density = draw_path(path_between(kind, frame + 1, idx, gap, at), filled, true);
  state_.cut_after(frame, idx);
  state_.cut_after(frame + gap, members.back());
  find_followers(frame, idx, gap);
  const bool accepted = accept(CableJump::kCut, change, log_density + log_share(at) + kLogBridgesPerCut);
  show(frame + 1, members, -1);
  if (!accepted) {
    state_.link(frame, idx, members.front());
    state_.link(frame + gap, members.back(), at);
    return;
  }
  for (int k = 0; k < gap; ++k) {
    state_.cut_after(frame + 1 + k, indices[static_cast<std::size_t>(k)]);
    state_.remove(frame + 1 + k, indices[static_cast<std::size_t>(k)]);
  }
}

int CableMoves::count_whole(int frame, int cell, int length, std::vector<int>* found) const {
  int num = 0;
  for (const int idx : state_.in_cell(frame, cell)) {
    const CoreElement& start = state_.element(frame, idx);
    if (start.previous >= 0 || start.kind != law_.prior().kind) continue;
    int steps = 1, at = start.next;
    for (; at >= 0 && steps < length; ++steps) at = state_.element(frame + steps, at).next;
    if (steps != length || at >= 0) continue;
    ++num;
    if (found != nullptr) found->push_back(idx);
  }
  return num;
}

void CableMoves::whole(int frame) {
  const int length = kShortestWhole + static_cast<int>(rng_.below(kMaxPath - kShortestWhole + 1));
  if (!range_.holds(frame) || !range_.holds(frame + length - 1)) return;
  const int cell = pick_cell(frame);
  if (rng_.below(2) == 0)
    whole_birth(frame, cell, length);
  else
    whole_kill(frame, cell, length);
}

void CableMoves::whole_birth(int frame, int cell, int length) {
  for (int k = 0; k < length; ++k)
    if (!has_room(frame + k)) return;
  const BaseKind kind = law_.prior().kind;
  if (!proposal_.look_in_cell(state_.image(frame), kind, law_.belief(kind, nullptr, nullptr, nullptr, nullptr),
                              state_.cell(cell)))
    return;
  std::array<CoreState, kMaxPath> states{};
  const std::span all(states.data(), static_cast<std::size_t>(length));
  states[0] = proposal_.draw(rng_);
  double log_density = proposal_.log_density(states[0]);
  if (law_.is_possible(kind, states[0]) && state_.cell_of(states[0]) == cell)
    log_density += draw_path({kind, frame + 1, nullptr, &states[0], nullptr, nullptr}, all.subspan(1), false);
  else
    log_density = kNever;
  if (log_density == kNever) {
    accept(CableJump::kWholeBirth, kNever, 0);
    return;
  }
  double change = junction(kind, frame, -1, all, -1);
  for (int k = 0; k < length; ++k) change += explained(frame + k, kind, all[static_cast<std::size_t>(k)]);
  const double num = count_whole(frame, cell, length, nullptr) + 1;
  if (!accept(CableJump::kWholeBirth, change, -log_density - std::log(num))) return;
  int last = -1;
  for (int k = 0; k < length; ++k) {
    const int added = state_.add(frame + k, kind, all[static_cast<std::size_t>(k)]);
    if (k > 0) state_.link(frame + k - 1, last, added);
    last = added;
  }
}

void CableMoves::whole_kill(int frame, int cell, int length) {
  found_.clear();
  const double num = count_whole(frame, cell, length, &found_);
  if (found_.empty()) return;
  std::array<int, kMaxPath> indices{};
  std::array<CoreState, kMaxPath> states{};
  int at = found_[rng_.below(found_.size())];
  for (int k = 0; k < length; ++k) {
    indices[static_cast<std::size_t>(k)] = at;
    states[static_cast<std::size_t>(k)] = state_.element(frame + k, at).z;
    at = state_.element(frame + k, at).next;
  }
  const BaseKind kind = law_.prior().kind;
  const std::span all(states.data(), static_cast<std::size_t>(length));
  const std::span<const int> members(indices.data(), static_cast<std::size_t>(length));
  show(frame, members, 1);
  double change = -junction(kind, frame, -1, all, -1), log_density = kNever;
  for (int k = 0; k < length; ++k) change -= explained(frame + k, kind, all[static_cast<std::size_t>(k)]);
  if (proposal_.look_in_cell(state_.image(frame), kind, law_.belief(kind, nullptr, nullptr, nullptr, nullptr),
                             state_.cell(cell))) {
    log_density = proposal_.log_density(states[0]);
    log_density += draw_path({kind, frame + 1, nullptr, &states[0], nullptr, nullptr}, all.subspan(1), true);
  }
  const bool accepted = accept(CableJump::kWholeKill, change, log_density + std::log(num));
  show(frame, members, -1);
  if (!accepted) return;
  for (int k = 0; k < length; ++k) {
    state_.cut_after(frame + k, indices[static_cast<std::size_t>(k)]);
    state_.remove(frame + k, indices[static_cast<std::size_t>(k)]);
  }
}

}  // namespace motex
