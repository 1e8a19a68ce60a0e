// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/cable_state.h"
#include "motex/particles/core_proposal.h"

namespace motex {

/// Reversible-jump moves over whole cables; each is paired with its reverse, which the same function proposes.
enum class CableMove {
  kBirthDeath,        ///< a cable of length one appears in a cell of the picture, or goes
  kExtendShrink,      ///< one frame more or less at the end of a cable
  kExtendShrinkBack,  ///< and at its beginning
  kSwap,              ///< two near cables exchange what follows a frame (one of them may end there): "mutate" of [TM02]
  kExchange,          ///< two near cables exchange their cores of one frame
  kSplitMerge,        ///< one cable is cut in two, or two that follow each other become one
  kBridge,            ///< the gap of one to three frames between two cables is filled, or opened
  kWhole,             ///< a cable of 2 – 6 frames appears at once, or goes
  kRefit,             ///< one core is drawn again: "diffuse" of [TM02], from the fit to the image
  kBlock,             ///< two to four cores in a row are drawn again
  kLevel,             ///< scale and amplitude of a whole cable change together
  kDiffuse,           ///< a random step of one core
  kPair,              ///< one to four cores in a row of two near cables are drawn again together, ends swapped or not
  kPairFill,          ///< extend, bridge and their reverses, with the cores of a near cable drawn again
  kPairTie            ///< merge and split, with the core at the seam and one beside it drawn again
};
constexpr int kNumCableMoves = 15;

/// The two directions of each move are counted apart.
enum class CableJump {
  kBirth,
  kDeath,
  kExtend,
  kShrink,
  kSwap,
  kExchange,
  kSplit,
  kMerge,
  kBridge,
  kCut,
  kWholeBirth,
  kWholeKill,
  kRefit,
  kBlock,
  kLevel,
  kDiffuse,
  kPairRedraw,
  kPairSwap,
  kPairExtend,
  kPairShrink,
  kPairBridge,
  kPairCut,
  kPairMerge,
  kPairSplit
};
constexpr int kNumCableJumps = 24;
const char* name_of(CableJump jump);

struct JumpCount {
  std::int64_t proposed = 0, accepted = 0;
};

/// Frames first … end − 1.
struct FrameRange {
  int first = 0, end = 0;
  bool holds(int frame) const { return frame >= first && frame < end; }
};

/// Proposes and decides. Target: log_posterior of cable_state.h.
class CableMoves {
 public:
  /// All must outlive this object. Only elements of the frames of `range` and links among them are changed; two
  /// frames on each side are read.
  CableMoves(CableState& state, const CableLaw& law, CoreProposal& proposal, FrameRange range, Rng rng);

  /// One proposal that begins in that frame; often there is nothing that could be proposed.
  void propose(CableMove move, int frame);

  /// Search, not sampling: what lies around the end of a cable (or a cable of length one) is taken away over some
  /// frames, built up again by the moves above, and put back as it was unless the posterior is higher then.
  /// Returns whether something was changed.
  bool rebuild_around(int frame, int idx);
  /// Whether the element begins or ends a cable where none should.
  bool is_suspicious(int frame, int idx);

  const std::array<JumpCount, kNumCableJumps>& counts() const { return counts_; }
  double log_posterior_change() const { return change_; }

 private:
  static constexpr int kMaxPath = 6;

  void birth_or_death(int frame);
  void birth(int frame, int cell);
  void death(int frame, int cell);
  void extend_or_shrink(int frame, int direction);
  void extend(int frame, int idx, int direction);
  void shrink(int frame, int idx, int direction);
  void swap(int frame);
  void exchange(int frame);
  void split_or_merge(int frame);
  void bridge_or_cut(int frame);
  void bridge(int frame, int idx, int gap);
  void cut(int frame, int idx, int gap);
  void whole(int frame);
  void whole_birth(int frame, int cell, int length);
  void whole_kill(int frame, int cell, int length);
  void redraw(CableJump jump, int frame, int num);
  void diffuse(int frame);
  void level(int frame);
  void pair(int frame);
  void pair_fill(int frame);
  void pair_tie(int frame);

  /// The cores of one cable in some frames; before and after: those they are joined to, −1 = none.
  struct Strand {
    int before = -1, after = -1;
    std::array<int, kMaxPath> indices{};  ///< of the elements, where there are any
    std::array<CoreState, kMaxPath> states{};
  };
  struct Window {
    BaseKind kind;
    int frame, num;
    int direction;        ///< of drawing: +1 from the first frame on, −1 from the last back
    double x = 0, y = 0;  ///< where to look for cores that are joined to nothing
  };
  struct PairDraw {
    double log_density = 0, explained = 0;
  };
  CoreBelief strand_belief(const Window& window, const Strand& strand, int k) const;
  void look(const Window& window, const Strand& strand, int k);
  /// As draw_path, for one strand or two at once; image without them. The second may be null.
  PairDraw draw_strands(const Window& window, Strand& one, Strand* two, bool is_given);
  void settle_pair(const Window& window, const Strand& one, const Strand& two, int k, CoreState& best_two);
  double junction(const Window& window, const Strand& strand) const;
  bool follow(const Window& window, int anchor, Strand& strand) const;
  void show(const Window& window, const Strand& strand, float sign);
  void settle(const Window& window, Strand& strand, const std::array<CoreState, kMaxPath>& states);
  void fill_with_partner(Window window, Strand partner, int anchor, bool to_other_side);
  void cut_with_partner(Window window, Strand partner, int anchor, bool to_other_side);
  struct Tie;
  double tie_share(const Tie& tie, int candidate, int* chosen);
  int tie_partners(const Tie& tie, int candidate, int* chosen, int wanted);
  struct LevelStep;
  double log_of_track(BaseKind kind, int frame, std::span<const CoreState> z) const;
  LevelStep level_step(BaseKind kind, int frame, std::span<const CoreState> states) const;

  bool accept(CableJump jump, double change, double log_hastings);
  int pick(int frame);
  int pick_cell(int frame);
  void take_away(int frame, int idx);
  int put(int frame, BaseKind kind, const CoreState& z, int before);
  void join(int frame, int idx, int next);
  double log_volume(int frame, int idx) const;
  double log_volume_near();
  void burn(FrameRange window);
  int strand_in(FrameRange window, int frame, int idx);
  void drop(FrameRange window, int frame, int idx);
  void twin(FrameRange window, int frame, int idx);
  void fuse(FrameRange window, int frame, int idx);
  void build_up(FrameRange window);
  int pick_near(int frame, int idx);
  bool has_room(int frame) const;
  double explained(int frame, BaseKind kind, const CoreState& z) const;
  /// Terms of ln p(W) that depend on the states between two elements that are joined through them: before (in
  /// frame − 1), the given states from `frame` on, after; −1 = the cable begins or ends there.
  double junction(BaseKind kind, int frame, int before, std::span<const CoreState> states, int after) const;

  struct Path {
    BaseKind kind;
    int frame;
    const CoreState *before2, *before, *after, *after2;
  };
  Path path_between(BaseKind kind, int frame, int before, int num, int after) const;
  /// Draws the states frame by frame (or weighs those given), each from the fit given the one before it; the ln
  /// density.
  double draw_path(const Path& path, std::span<CoreState> states, bool is_given);
  bool are_possible(BaseKind kind, std::span<const CoreState> states) const;

  /// Beginnings in `frame` that could follow the element, with weights; their sum.
  void find_followers(int frame, int idx, int gap);
  double log_share(int follower) const;
  int choose_follower();

  int count_whole(int frame, int cell, int length, std::vector<int>* found) const;
  void show(int frame, std::span<const int> indices, float sign);

  CableState& state_;
  const CableLaw& law_;
  CoreProposal& proposal_;
  FrameRange range_;
  Rng rng_;
  double image_weight_;
  double change_ = 0;
  std::array<JumpCount, kNumCableJumps> counts_{};
  /// Moves are made near a place that goes with the flow, where radius > 0.
  struct Focus {
    double x = 0, y = 0, vx = 0, vy = 0, radius = 0;
    int frame = 0;
    double x_at(int t) const { return x + vx * (t - frame); }
    double y_at(int t) const { return y + vy * (t - frame); }
  };
  Focus focus_;
  CableState::Snapshot snapshot_;
  std::vector<int> found_;
  std::vector<int> track_;
  std::vector<CoreState> track_states_, moved_states_;
  std::vector<int> followers_;
  std::vector<double> follower_weights_;
  double follower_sum_ = 0;
};

}  // namespace motex
