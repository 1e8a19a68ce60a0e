// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// What the moves share, and the moves that change links or states alone; those that change how many elements there
// are: cable_jumps.cpp.
#include "motex/particles/cable_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motex {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr double kSwapRadius = 9;        // pixels
constexpr double kMaxFollowRadius = 30;  // pixels
constexpr double kFollowWidening = 2;    // of the deviation of a step

}  // namespace

const char* name_of(CableJump jump) {
  constexpr std::array<const char*, kNumCableJumps> kNames{
      "birth",       "death",     "extend",      "shrink",      "swap",        "exchange", "split",      "merge",
      "bridge",      "cut",       "whole_birth", "whole_kill",  "refit",       "block",    "level",      "diffuse",
      "pair_redraw", "pair_swap", "pair_extend", "pair_shrink", "pair_bridge", "pair_cut", "pair_merge", "pair_split"};
  return kNames[static_cast<std::size_t>(jump)];
}

CableMoves::CableMoves(CableState& state, const CableLaw& law, CoreProposal& proposal, FrameRange range, Rng rng)
    : state_(state),
      law_(law),
      proposal_(proposal),
      range_(range),
      rng_(rng),
      image_weight_(1 / (2 * law.prior().noise * law.prior().noise)) {}

void CableMoves::propose(CableMove move, int frame) {
  switch (move) {
    case CableMove::kBirthDeath:
      return birth_or_death(frame);
    case CableMove::kExtendShrink:
      return extend_or_shrink(frame, 1);
    case CableMove::kExtendShrinkBack:
      return extend_or_shrink(frame, -1);
    case CableMove::kSwap:
      return swap(frame);
    case CableMove::kExchange:
      return exchange(frame);
    case CableMove::kSplitMerge:
      return split_or_merge(frame);
    case CableMove::kBridge:
      return bridge_or_cut(frame);
    case CableMove::kWhole:
      return whole(frame);
    case CableMove::kRefit:
      return redraw(CableJump::kRefit, frame, 1);
    case CableMove::kBlock:
      return redraw(CableJump::kBlock, frame, 2 + static_cast<int>(rng_.below(3)));
    case CableMove::kLevel:
      return level(frame);
    case CableMove::kDiffuse:
      return diffuse(frame);
    case CableMove::kPair:
      return pair(frame);
    case CableMove::kPairFill:
      return pair_fill(frame);
    case CableMove::kPairTie:
      return pair_tie(frame);
  }
}

bool CableMoves::accept(CableJump jump, double change, double log_hastings) {
  JumpCount& count = counts_[static_cast<std::size_t>(jump)];
  ++count.proposed;
  const double log_ratio = change + log_hastings;
  if (!(log_ratio >= 0) && !(std::log(rng_.uniform()) < log_ratio)) return false;
  ++count.accepted;
  change_ += change;
  return true;
}

int CableMoves::pick(int frame) {
  if (focus_.radius > 0) {
    found_.clear();
    state_.near(frame, focus_.x_at(frame), focus_.y_at(frame), focus_.radius, found_);
    return found_.empty() ? -1 : found_[rng_.below(found_.size())];
  }
  const std::vector<int>& live = state_.live(frame);
  return live.empty() ? -1 : live[rng_.below(live.size())];
}

int CableMoves::pick_cell(int frame) {
  if (focus_.radius <= 0) return static_cast<int>(rng_.below(static_cast<std::uint64_t>(state_.num_cells())));
  CoreState z{};
  z[kCoreX] = focus_.x_at(frame) + rng_.uniform(-1, 1) * focus_.radius;
  z[kCoreY] = focus_.y_at(frame) + rng_.uniform(-1, 1) * focus_.radius;
  return state_.cell_of(z);
}

int CableMoves::pick_near(int frame, int idx) {
  const CoreElement& element = state_.element(frame, idx);
  found_.clear();
  state_.near(frame, element.z[kCoreX], element.z[kCoreY], kSwapRadius, found_);
  std::erase_if(found_, [&](int other) { return other == idx || state_.element(frame, other).kind != element.kind; });
  return found_.empty() ? -1 : found_[rng_.below(found_.size())];
}

bool CableMoves::has_room(int frame) const {
  return static_cast<int>(state_.live(frame).size()) < law_.prior().max_per_frame;
}

double CableMoves::explained(int frame, BaseKind kind, const CoreState& z) const {
  return image_weight_ * explained_by(state_.image(frame), kind, z);
}

double CableMoves::junction(BaseKind kind, int frame, int before, std::span<const CoreState> states, int after) const {
  std::array<const CoreState*, kMaxPath + 4> z{};
  std::size_t n = 0;
  const int num_states = static_cast<int>(states.size());
  if (before >= 0) {
    const CoreElement& element = state_.element(frame - 1, before);
    if (element.previous >= 0) z[n++] = &state_.element(frame - 2, element.previous).z;
    z[n++] = &element.z;
  }
  const std::size_t from = n;
  for (const CoreState& state : states) z[n++] = &state;
  const std::size_t to = n;
  if (after >= 0) {
    const CoreElement& element = state_.element(frame + num_states, after);
    z[n++] = &element.z;
    if (element.next >= 0) z[n++] = &state_.element(frame + num_states + 1, element.next).z;
  }
  const int first_frame = frame - static_cast<int>(from);
  double sum = 0;
  for (std::size_t k = from; k < std::min(to + 2, n); ++k) {
    if (k == 0) sum += law_.log_birth(*z[0], first_frame);
    if (k == 1) sum += law_.log_first_step(kind, *z[0], *z[1]);
    if (k >= 2) sum += law_.log_step(kind, *z[k - 2], *z[k - 1], *z[k]);
  }
  for (std::size_t k = from > 0 ? from - 1 : 0; k < std::min(to + 1, n); ++k)
    sum += law_.log_end(k > 0 ? z[k - 1] : nullptr, *z[k], first_frame + static_cast<int>(k), k + 1 < n);
  return sum;
}

CableMoves::Path CableMoves::path_between(BaseKind kind, int frame, int before, int num, int after) const {
  Path path{kind, frame, nullptr, nullptr, nullptr, nullptr};
  if (before >= 0) {
    const CoreElement& element = state_.element(frame - 1, before);
    path.before = &element.z;
    if (element.previous >= 0) path.before2 = &state_.element(frame - 2, element.previous).z;
  }
  if (after >= 0) {
    const CoreElement& element = state_.element(frame + num, after);
    path.after = &element.z;
    if (element.next >= 0) path.after2 = &state_.element(frame + num + 1, element.next).z;
  }
  return path;
}

double CableMoves::draw_path(const Path& path, std::span<CoreState> states, bool is_given) {
  double log_density = 0;
  const CoreState *before2 = path.before2, *before = path.before;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const std::size_t ahead = states.size() - k;  // steps to `after`
    CoreBelief belief =
        law_.belief(path.kind, before2, before, ahead == 1 ? path.after : nullptr, ahead == 1 ? path.after2 : nullptr);
    if (ahead > 1 && path.after != nullptr && before != nullptr) {  // a straight line pulls towards the other side
      for (const int c : {kCoreX, kCoreY}) {
        const auto i = static_cast<std::size_t>(c);
        const double deviation = 2 * law_.step_deviation(c, false) * static_cast<double>(ahead);
        const double mean = (*before)[i] + ((*path.after)[i] - (*before)[i]) / static_cast<double>(ahead + 1);
        const double precision = 1 / (deviation * deviation);
        belief.mean[i] = (belief.mean[i] * belief.precision[i] + mean * precision) / (belief.precision[i] + precision);
        belief.precision[i] += precision;
      }
    }
    proposal_.look_around(state_.image(path.frame + static_cast<int>(k)), path.kind, belief);
    if (!is_given) states[k] = proposal_.draw(rng_);
    log_density += proposal_.log_density(states[k]);
    if (!is_given && !law_.is_possible(path.kind, states[k])) return kNever;
    before2 = before;
    before = &states[k];
  }
  return log_density;
}

bool CableMoves::are_possible(BaseKind kind, std::span<const CoreState> states) const {
  return std::all_of(states.begin(), states.end(), [&](const CoreState& z) { return law_.is_possible(kind, z); });
}

void CableMoves::swap(int frame) {
  if (!range_.holds(frame) || !range_.holds(frame + 1)) return;
  const int a = pick(frame), b = a < 0 ? -1 : pick_near(frame, a);
  if (b < 0) return;
  const CoreElement &one = state_.element(frame, a), &two = state_.element(frame, b);
  const int after_a = one.next, after_b = two.next;
  if (after_a < 0 && after_b < 0) return;
  const BaseKind kind = one.kind;
  const double change = junction(kind, frame + 1, a, {}, after_b) + junction(kind, frame + 1, b, {}, after_a) -
                        junction(kind, frame + 1, a, {}, after_a) - junction(kind, frame + 1, b, {}, after_b);
  if (!accept(CableJump::kSwap, change, 0)) return;
  state_.cut_after(frame, a);
  state_.cut_after(frame, b);
  if (after_b >= 0) state_.link(frame, a, after_b);
  if (after_a >= 0) state_.link(frame, b, after_a);
}

void CableMoves::exchange(int frame) {
  const int a = pick(frame), b = a < 0 ? -1 : pick_near(frame, a);
  if (b < 0) return;
  const CoreElement &one = state_.element(frame, a), &two = state_.element(frame, b);
  const std::array<CoreState, 1> za{one.z}, zb{two.z};
  const BaseKind kind = one.kind;
  const double change =
      junction(kind, frame, one.previous, zb, one.next) + junction(kind, frame, two.previous, za, two.next) -
      junction(kind, frame, one.previous, za, one.next) - junction(kind, frame, two.previous, zb, two.next);
  if (!accept(CableJump::kExchange, change, 0)) return;
  state_.place(frame, a, zb[0]);
  state_.place(frame, b, za[0]);
}

void CableMoves::find_followers(int frame, int idx, int gap) {
  const CoreElement& element = state_.element(frame, idx);
  const CoreState* before2 = element.previous < 0 ? nullptr : &state_.element(frame - 1, element.previous).z;
  CoreState earlier = element.z, now = law_.expected(before2, element.z);
  for (int k = 0; k < gap; ++k) {
    const CoreState next = law_.expected(&earlier, now);
    earlier = now;
    now = next;
  }
  const double widening = kFollowWidening * (1 + gap);
  const double dx = widening * law_.step_deviation(kCoreX, before2 == nullptr) + 0.5,
               dy = widening * law_.step_deviation(kCoreY, before2 == nullptr) + 0.5;
  found_.clear();
  state_.near(frame + gap + 1, now[kCoreX], now[kCoreY], std::min(3 * std::max(dx, dy), kMaxFollowRadius), found_);
  followers_.clear();
  follower_weights_.clear();
  follower_sum_ = 0;
  for (const int other : found_) {
    const CoreElement& start = state_.element(frame + gap + 1, other);
    if (start.previous >= 0 || start.kind != element.kind) continue;
    const double u = (start.z[kCoreX] - now[kCoreX]) / dx, v = (start.z[kCoreY] - now[kCoreY]) / dy;
    followers_.push_back(other);
    follower_weights_.push_back(std::exp(-0.5 * (u * u + v * v)));
    follower_sum_ += follower_weights_.back();
  }
}

double CableMoves::log_share(int follower) const {
  for (std::size_t k = 0; k < followers_.size(); ++k)
    if (followers_[k] == follower) return std::log(follower_weights_[k] / follower_sum_);
  return kNever;
}

int CableMoves::choose_follower() {
  if (followers_.empty()) return -1;
  double left = rng_.uniform() * follower_sum_;
  for (std::size_t k = 0; k + 1 < followers_.size(); ++k) {
    left -= follower_weights_[k];
    if (left < 0) return followers_[k];
  }
  return followers_.back();
}

void CableMoves::split_or_merge(int frame) {
  if (!range_.holds(frame) || !range_.holds(frame + 1)) return;
  const int a = pick(frame);
  if (a < 0) return;
  const BaseKind kind = state_.element(frame, a).kind;
  const int after = state_.element(frame, a).next;
  const auto gain = [&](int c) {  // of joining
    return junction(kind, frame + 1, a, {}, c) - junction(kind, frame + 1, a, {}, -1) -
           junction(kind, frame + 1, -1, {}, c);
  };
  if (after >= 0) {
    const double change = -gain(after);
    state_.cut_after(frame, a);
    find_followers(frame, a, 0);
    if (!accept(CableJump::kSplit, change, log_share(after))) state_.link(frame, a, after);
    return;
  }
  find_followers(frame, a, 0);
  const int c = choose_follower();
  if (c >= 0 && accept(CableJump::kMerge, gain(c), -log_share(c))) state_.link(frame, a, c);
}

void CableMoves::redraw(CableJump jump, int frame, int num) {
  if (!range_.holds(frame) || !range_.holds(frame + num - 1)) return;
  std::array<int, kMaxPath> indices{};
  std::array<CoreState, kMaxPath> old_states{}, new_states{};
  const auto n = static_cast<std::size_t>(num);
  int idx = pick(frame);
  if (idx < 0) return;
  const int before = state_.element(frame, idx).previous;
  const BaseKind kind = state_.element(frame, idx).kind;
  for (int k = 0; k < num; ++k) {
    if (idx < 0) return;
    const CoreElement& element = state_.element(frame + k, idx);
    indices[static_cast<std::size_t>(k)] = idx;
    old_states[static_cast<std::size_t>(k)] = element.z;
    idx = element.next;
  }
  if (before < 0 && (num > 1 || idx < 0)) return;  // nothing says where they should be
  const std::span old_span(old_states.data(), n), new_span(new_states.data(), n);
  const std::span<const int> members(indices.data(), n);
  show(frame, members, 1);
  const Path path = path_between(kind, frame, before, num, idx);
  const double log_back = draw_path(path, old_span, true), log_there = draw_path(path, new_span, false);
  bool accepted = false;
  if (log_there > kNever) {
    double change = junction(kind, frame, before, new_span, idx) - junction(kind, frame, before, old_span, idx);
    for (std::size_t k = 0; k < n; ++k)
      change += explained(frame + static_cast<int>(k), kind, new_states[k]) -
                explained(frame + static_cast<int>(k), kind, old_states[k]);
    accepted = accept(jump, change, log_back - log_there);
  } else {
    accept(jump, kNever, 0);
  }
  if (accepted)
    for (std::size_t k = 0; k < n; ++k) state_.place(frame + static_cast<int>(k), indices[k], new_states[k]);
  show(frame, members, -1);
}

void CableMoves::diffuse(int frame) {
  const int idx = pick(frame);
  if (idx < 0) return;
  const CoreElement element = state_.element(frame, idx);
  const std::array<CoreState, 1> before{element.z}, after{proposal_.step(element.kind, element.z, rng_)};
  if (!law_.is_possible(element.kind, after[0])) {
    accept(CableJump::kDiffuse, kNever, 0);
    return;
  }
  state_.paint(frame, idx, 1);
  const double change = explained(frame, element.kind, after[0]) - explained(frame, element.kind, before[0]) +
                        junction(element.kind, frame, element.previous, after, element.next) -
                        junction(element.kind, frame, element.previous, before, element.next);
  if (accept(CableJump::kDiffuse, change, 0)) state_.place(frame, idx, after[0]);
  state_.paint(frame, idx, -1);
}

void CableMoves::show(int frame, std::span<const int> indices, float sign) {
  for (std::size_t k = 0; k < indices.size(); ++k) state_.paint(frame + static_cast<int>(k), indices[k], sign);
}

}  // namespace motex
