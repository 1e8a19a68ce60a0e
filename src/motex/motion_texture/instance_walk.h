// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "motex/core/rng.h"
#include "motex/motion_texture/synthesize.h"

namespace motex {

/// Random walk over the instances of a model [MT02 5.1]: from instance a (texton i) to b (texton j) with
///
///   p(b) ∝ M_ij · exp(−δ(a, b)/τ) · V(b)⁶ · exp(−0.3 β u_b)
///   V(b) = max(½^(times b was played) · exp(−0.2 β u_b), 0.65 max_c V(c)) over followers c of b
///
/// δ(a, b): distance from where a ends to the key poses of b; τ = nearness × its median over nearest strangers.
/// Followers farther than 1.25 τ are left out where nearer ones exist; but the nearest of a texton that edits prefer
/// stays. V draws the dance towards what it has not shown lately, so that it neither goes in circles nor forgets a
/// corner of the examples. u_b: how much faster b is than the examples' mean, as a share of it (liveliness.h); β: the
/// sum of u · seconds over what was played, at most ± 10: seconds of mean movement that the dance is ahead of its
/// source. It keeps the mean speed over time; in V it also leads out of stretches that hold calm (or lively) instances
/// alone. Where edits make the step from texton i to j r times as frequent as learned, coming to b that way counts as
/// 1/r times played: V does not work against them; and the mean is that of the edited dance.
class InstanceWalk {
 public:
  InstanceWalk(const MotionTexture& model, const SynthesizeOptions& options, std::vector<int> path, bool endless);

  /// A factor of p(b), above 0; V then counts by its square only.
  using Taste = std::function<double(int instance)>;
  /// The instance to play next, or −1 where a path that is not endless is over. The first call gives the first one.
  int next(const Taste& taste = {});
  /// Forgets the last choice; once after each next().
  void take_back();
  /// These textons come next, instead of what is left of the path.
  void lead(std::vector<int> path);
  /// By example, what can come after it in the endless dance.
  std::vector<std::vector<int>> followers() const;

 private:
  struct Follower {
    int instance = 0;
    double weight = 0;  ///< M_ij · exp(−δ/τ)
  };
  std::vector<Follower> followers_of(int instance) const;
  int choose_endless(const Taste& taste);
  int choose_of_texton(int texton);
  void look_ahead();
  void lead_into_every_part();
  bool lead_into(const std::vector<int>& part);
  double distance(int from, int to) const;
  double preference(int from, int to) const;  ///< M against that without the edits' weights
  double fading(int from, int to) const;      ///< of the freshness of `to` when it is played
  double transition(int from, int to) const;  ///< M of their textons

  const MotionTexture& model_;
  KeyPoses key_poses_;
  std::vector<int> path_;
  bool endless_;
  Rng rng_;
  double tau_ = 1;
  std::size_t path_done_ = 0;
  int current_ = -1;
  struct {
    int current = -1;
    std::size_t path_done = 0;
    double balance = 0;
  } before_;                  ///< the last choice
  std::vector<int> allowed_;  ///< instances of the largest connected part
  std::vector<bool> texton_allowed_;
  std::vector<std::vector<Follower>> followers_;  ///< by instance
  std::vector<double> liveliness_;                ///< u
  double balance_ = 0;                            ///< β, s
  std::vector<double> freshness_, value_;         ///< ½^(times played), V
};

}  // namespace motex
