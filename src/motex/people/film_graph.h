// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/markov/graph.h"
#include "motex/people/people_texture.h"

namespace motex {

/// What frame a film can show after which: the next of the take, or the one that a cut leads to. After a cut at least
/// `min_shot` frames of the take are played before the next one.
class FilmGraph {
 public:
  /// texture.cuts must have been found. Of a cut counts how smooth its transition of that many frames will be
  /// (transition_smoothness), where that is worse than the cut by itself. Throws InvalidInput when a cut or a take does
  /// not fit the frames.
  explicit FilmGraph(const PeopleTexture& texture, int min_shot, int transition_frames = 0);

  struct Jump {
    int to = 0;
    int cut = 0;      ///< index in texture.cuts.cuts
    double cost = 0;  ///< cost_of_cut()
  };
  int num_frames() const { return static_cast<int>(last_of_take_.size()); }
  int min_shot() const { return min_shot_; }
  /// Cuts from a frame after which min_shot frames can be played.
  std::span<const Jump> jumps(int frame) const {
    const auto i = static_cast<std::size_t>(frame);
    return std::span(jumps_).subspan(jump_begin_[i], jump_begin_[i + 1] - jump_begin_[i]);
  }
  /// The last frame of the take that the frame is in.
  int last_of_take(int frame) const { return last_of_take_[static_cast<std::size_t>(frame)]; }
  bool goes_on(int frame) const { return frame < last_of_take(frame); }

  /// Whether film can go on for ever from this frame and come back to it: the largest set of frames that all reach one
  /// another; what lies outside ends sooner or later at the end of a take. [Schödl et al. 2000, section 3.1]
  bool is_endless(int frame) const { return endless_[static_cast<std::size_t>(frame)] != 0; }
  /// Share of all frames.
  double endless_share() const;
  /// What going on costs, later cuts counting less (future_costs, α = .995); infinite where every way ends.
  double future_cost(int frame) const { return future_cost_[static_cast<std::size_t>(frame)]; }

 private:
  int min_shot_;
  std::vector<int> last_of_take_;
  std::vector<std::size_t> jump_begin_;
  std::vector<Jump> jumps_;
  std::vector<char> endless_;
  std::vector<double> future_cost_;
};

/// 1 + (difference / d)² + smoothness², d = half the natural difference, 8 grey levels at least: 1 for being a cut at
/// all, as much again for pictures that differ as movement does, and for a jolt as in the most sudden twentieth of the
/// footage; 40 for each unit of smoothness above 1.2, so that such a cut is made only where there is no other way.
double cost_of_cut(const Cut& cut, double natural_difference);

}  // namespace motex
