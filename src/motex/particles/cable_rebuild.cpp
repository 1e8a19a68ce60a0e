// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Where elements lie on one another for several frames, no single move leads from a wrong explanation to the right one:
// there the cables are built up anew from what is known before, after and beside.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/particles/cable_moves.h"

namespace motex {
namespace {

constexpr double kLeastRadius = 5, kMostRadius = 12;   // pixels
constexpr int kLongestReach = 6;                       // frames to each side
constexpr int kBeside = 3;                             // frames
constexpr double kTwinOffset = 0.6, kTwinScale = 0.9;  // of the scale
constexpr double kVolumeRadius = 24;                   // pixels: around all that may change
enum RebuildWay : std::uint64_t { kBurn, kDrop, kTwin, kTwinBeside, kFuse, kNumWays };
constexpr int kRounds = 4;
constexpr double kCrowdRadius = 4;  // pixels

}  // namespace

bool CableMoves::is_suspicious(int frame, int idx) {
  const CoreElement& element = state_.element(frame, idx);
  if (element.previous >= 0 && element.next >= 0) return false;
  found_.clear();
  state_.near(frame, element.z[kCoreX], element.z[kCoreY], kCrowdRadius, found_);
  if (found_.size() > 1) return true;
  if (element.previous < 0 && frame > 0) {
    const CablePrior& prior = law_.prior();
    const double x = element.z[kCoreX] - prior.dynamics.x.c0, y = element.z[kCoreY] - prior.dynamics.y.c0;
    if (x > 1 && x < prior.width - 2 && y > 1 && y < prior.height - 2) return true;
  }
  if (element.next < 0 && frame + 1 < state_.num_frames()) {
    const CoreState* before = element.previous < 0 ? nullptr : &state_.element(frame - 1, element.previous).z;
    const CoreState next = law_.expected(before, element.z);
    const CablePrior& prior = law_.prior();
    if (next[kCoreX] > 1 && next[kCoreX] < prior.width - 2 && next[kCoreY] > 1 && next[kCoreY] < prior.height - 2)
      return true;
  }
  return false;
}

void CableMoves::take_away(int frame, int idx) {
  const CoreElement element = state_.element(frame, idx);
  const std::array<CoreState, 1> z{element.z};
  change_ += junction(element.kind, frame, element.previous, {}, -1) +
             junction(element.kind, frame + 1, -1, {}, element.next) -
             junction(element.kind, frame, element.previous, z, element.next);
  if (element.previous >= 0) state_.cut_after(frame - 1, element.previous);
  state_.cut_after(frame, idx);
  state_.remove(frame, idx);
  change_ -= explained(frame, element.kind, z[0]);
}

int CableMoves::put(int frame, BaseKind kind, const CoreState& z, int before) {
  const std::array<CoreState, 1> states{z};
  change_ +=
      explained(frame, kind, z) + junction(kind, frame, before, states, -1) - junction(kind, frame, before, {}, -1);
  const int idx = state_.add(frame, kind, z);
  if (before >= 0) state_.link(frame - 1, before, idx);
  return idx;
}

void CableMoves::join(int frame, int idx, int next) {
  const BaseKind kind = state_.element(frame, idx).kind;
  change_ += junction(kind, frame + 1, idx, {}, next) - junction(kind, frame + 1, idx, {}, -1) -
             junction(kind, frame + 1, -1, {}, next);
  state_.link(frame, idx, next);
}

/// Everything near, over the window.
void CableMoves::burn(FrameRange window) {
  for (int t = window.first; t < window.end; ++t) {
    track_.clear();
    state_.near(t, focus_.x_at(t), focus_.y_at(t), focus_.radius, track_);
    for (const int idx : track_) take_away(t, idx);
  }
}

/// The part of the element's cable that lies in the window: its first frame and its elements.
int CableMoves::strand_in(FrameRange window, int frame, int idx) {
  while (frame > window.first && state_.element(frame, idx).previous >= 0) idx = state_.element(frame--, idx).previous;
  track_.clear();
  for (int t = frame; t < window.end && idx >= 0; ++t) {
    track_.push_back(idx);
    idx = state_.element(t, idx).next;
  }
  return frame;
}

void CableMoves::drop(FrameRange window, int frame, int idx) {
  const int first = strand_in(window, frame, idx);
  for (std::size_t k = 0; k < track_.size(); ++k) take_away(first + static_cast<int>(k), track_[k]);
}

/// Two side by side where there was one.
void CableMoves::twin(FrameRange window, int frame, int idx) {
  const int first = strand_in(window, frame, idx);
  const auto num = static_cast<int>(track_.size());
  for (int k = 0; k < num; ++k)
    if (static_cast<int>(state_.live(first + k).size()) + 1 > law_.prior().max_per_frame) return;
  track_states_.clear();
  for (int k = 0; k < num; ++k)
    track_states_.push_back(state_.element(first + k, track_[static_cast<std::size_t>(k)]).z);
  const BaseKind kind = state_.element(first, track_.front()).kind;
  int before = state_.element(first, track_.front()).previous, other = -1;
  const int after = state_.element(first + num - 1, track_.back()).next;
  const double turn = rng_.uniform(0, 2 * std::numbers::pi), share = rng_.uniform(0.4, 0.6);
  for (int k = 0; k < num; ++k) {
    const CoreState& z = track_states_[static_cast<std::size_t>(k)];
    const double scale = std::exp(z[kCoreLogScale]);
    CoreState left = z, right = z;
    left[kCoreX] -= kTwinOffset * scale * std::cos(turn);
    left[kCoreY] -= kTwinOffset * scale * std::sin(turn);
    right[kCoreX] += kTwinOffset * scale * std::cos(turn);
    right[kCoreY] += kTwinOffset * scale * std::sin(turn);
    left[kCoreLogScale] = right[kCoreLogScale] =
        std::max(z[kCoreLogScale] + std::log(kTwinScale), std::log(law_.prior().min_scale));
    left[kCoreAmplitude] *= share / (kTwinScale * kTwinScale);
    right[kCoreAmplitude] *= (1 - share) / (kTwinScale * kTwinScale);
    take_away(first + k, track_[static_cast<std::size_t>(k)]);
    if (!law_.is_possible(kind, left) || !law_.is_possible(kind, right)) {
      before = other = -1;
      continue;
    }
    before = put(first + k, kind, left, before);
    other = put(first + k, kind, right, other);
  }
  if (after >= 0 && before >= 0) join(first + num - 1, before, after);
}

/// One where there were two on one another.
void CableMoves::fuse(FrameRange window, int frame, int idx) {
  const int partner = pick_near(frame, idx);
  if (partner < 0) return;
  const int first = strand_in(window, frame, idx);
  const std::vector<int> gone = track_;
  const int first_kept = strand_in(window, frame, partner);
  const std::vector<int> kept = track_;
  const BaseKind kind = state_.element(frame, idx).kind;
  for (std::size_t k = 0; k < gone.size(); ++k) {
    const int t = first + static_cast<int>(k), other = t - first_kept;
    if (other < 0 || other >= static_cast<int>(kept.size())) continue;
    const int keeper = kept[static_cast<std::size_t>(other)];
    const CoreState one = state_.element(t, gone[k]).z, two = state_.element(t, keeper).z;
    const double light = one[kCoreAmplitude] * std::exp(2 * one[kCoreLogScale]),
                 share = light / (light + two[kCoreAmplitude] * std::exp(2 * two[kCoreLogScale]));
    CoreState z = two;
    for (const std::size_t c : {std::size_t{kCoreX}, std::size_t{kCoreY}, std::size_t{kCoreLogScale}})
      z[c] += share * (one[c] - two[c]);
    z[kCoreAmplitude] += one[kCoreAmplitude] * std::exp(2 * (one[kCoreLogScale] - z[kCoreLogScale]));
    take_away(t, gone[k]);
    const int before = state_.element(t, keeper).previous, after = state_.element(t, keeper).next;
    take_away(t, keeper);
    const int added = put(t, kind, z, before);
    if (after >= 0) join(t, added, after);
  }
}

void CableMoves::build_up(FrameRange window) {
  const auto repeat = [&](CableMove move, int frame, int times) {
    for (int k = 0; k < times; ++k) propose(move, frame);
  };
  const auto visit = [&](int t, bool forward, int round) {
    repeat(forward ? CableMove::kExtendShrink : CableMove::kExtendShrinkBack, t, 6);
    repeat(CableMove::kSplitMerge, t, 4);
    repeat(CableMove::kRefit, t, 6);
    repeat(CableMove::kDiffuse, t, 3);
    repeat(CableMove::kPair, t, 2);
    repeat(CableMove::kLevel, t, 1);
    repeat(CableMove::kSwap, t, 2);
    if (round < 2) return;
    repeat(CableMove::kPairTie, t, 1);
    repeat(CableMove::kPairFill, t, 1);
    repeat(CableMove::kBridge, t, 2);
    repeat(CableMove::kBirthDeath, t, 4);
    repeat(CableMove::kWhole, t, 2);
  };
  for (int round = 0; round < kRounds; ++round) {
    for (int t = window.first; t < window.end; ++t) visit(t, true, round);
    for (int t = window.end - 1; t >= window.first; --t) visit(t, false, round);
  }
}

/// ln volume of the posterior of one core given its neighbours, with what a core of that size shows in noise.
double CableMoves::log_volume(int frame, int idx) const {
  const CoreElement& element = state_.element(frame, idx);
  const CoreElement* before = element.previous < 0 ? nullptr : &state_.element(frame - 1, element.previous);
  const CoreElement* after = element.next < 0 ? nullptr : &state_.element(frame + 1, element.next);
  const CoreState* before2 =
      before == nullptr || before->previous < 0 ? nullptr : &state_.element(frame - 2, before->previous).z;
  const CoreState* after2 = after == nullptr || after->next < 0 ? nullptr : &state_.element(frame + 2, after->next).z;
  const CoreState prior = law_.belief(element.kind, before2, before == nullptr ? nullptr : &before->z,
                                      after == nullptr ? nullptr : &after->z, after2)
                              .precision;
  const double scale = std::exp(element.z[kCoreLogScale]), peak = element.z[kCoreAmplitude];
  const double factor = coefficient_factor(element.kind), own = 2 * image_weight_ * factor * factor * scale * scale;
  const double place = own * peak * peak / (2 * scale * scale);
  const double ss = 2 * own * peak * peak + prior[kCoreLogScale], aa = own + prior[kCoreAmplitude], sa = own * peak;
  double log_precision =
      std::log(place + prior[kCoreX]) + std::log(place + prior[kCoreY]) + std::log(ss * aa - sa * sa);
  int num = 4;
  if (!is_round(element.kind)) {
    log_precision += std::log(own * peak * peak / 2 + prior[kCoreAngle]);
    ++num;
  }
  return 0.5 * (num * std::log(2 * std::numbers::pi) - log_precision);
}

double CableMoves::log_volume_near() {
  double sum = 0;
  for (int t = range_.first; t < range_.end; ++t) {
    found_.clear();
    state_.near(t, focus_.x_at(t), focus_.y_at(t), kVolumeRadius, found_);
    for (const int idx : found_) sum += log_volume(t, idx);
  }
  return sum;
}

bool CableMoves::rebuild_around(int frame, int idx) {
  const CoreElement element = state_.element(frame, idx);
  const int reach = 1 + static_cast<int>(rng_.below(kLongestReach));
  // links out of the range must stay
  const FrameRange window{std::max(frame - reach, range_.first + (range_.first > 0 ? 1 : 0)),
                          std::min(frame + reach + 1, range_.end - (range_.end < state_.num_frames() ? 1 : 0))};
  if (!window.holds(frame)) return false;
  const FrameRange whole = range_;
  const std::uint64_t way = rng_.below(kNumWays);
  FrameRange scope = window;
  if (way != kBurn) {  // the whole cable, as far as it may be changed
    scope = {whole.first + (whole.first > 0 ? 1 : 0), whole.end - (whole.end < state_.num_frames() ? 1 : 0)};
    const int first = strand_in(scope, frame, idx);
    scope = {first, std::max(first + static_cast<int>(track_.size()), frame + 1)};
  }
  range_ = {std::max(std::min(window.first, scope.first) - kBeside, whole.first),
            std::min(std::max(window.end, scope.end) + kBeside, whole.end)};
  focus_ = {element.z[kCoreX],
            element.z[kCoreY],
            law_.prior().dynamics.x.c0,
            law_.prior().dynamics.y.c0,
            rng_.uniform(kLeastRadius, kMostRadius),
            frame};
  const double before = change_;
  const auto counts = counts_;
  const double volume_before = log_volume_near();
  state_.save(range_.first, range_.end, snapshot_);
  if (way == kBurn) burn(window);
  if (way == kDrop) drop(scope, frame, idx);
  if (way == kTwin) twin(scope, frame, idx);
  if (way == kTwinBeside) twin(window, frame, pick(frame));
  if (way == kFuse) fuse(scope, frame, idx);
  focus_.radius += 3;
  build_up({std::max(window.first - 1, range_.first), std::min(window.end + 1, range_.end)});
  // densities of states of different dimension cannot be compared: their masses can
  const bool is_better = change_ + log_volume_near() > before + volume_before;
  focus_.radius = 0;
  counts_ = counts;
  if (!is_better) {
    change_ = before;
    state_.restore(snapshot_);
  }
  range_ = whole;
  return is_better;
}

}  // namespace motex
