// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "motex/core/options.h"
#include "motex/motion_texture/synthesize.h"

namespace motex {

struct SteerOptions {
  double max_turn = 75;
  double pull = 4;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"max_turn", "°/s", "the dance is turned about the standing foot by at most this"}, self.max_turn,
          Range{0, 720});
    visit(Field{"pull", "",
                "how much an example that goes the wanted way is preferred; 0: examples are not chosen by it"},
          self.pull, Range{0, 100});
  }
};

/// Where the dance is to go. What is not set is left to the dance.
struct Steering {
  std::optional<double> direction;  ///< rad, of the way over the floor in the world: 0 = +Z, π/2 = +X
  std::optional<double> facing;     ///< rad, of the body's heading; where both are set, the dance turns by direction
  std::optional<double> speed;      ///< m/s over the floor
  double pace = 1;                  ///< examples are played so much faster; 0.8 … 1.25
};

/// An example's way from its first to its last frame, in the heading frame of the first.
struct Excursion {
  double x = 0, z = 0;  ///< units of the skeleton
  double turn = 0;      ///< rad
  double secs = 0;
};
Excursion excursion(const MotionTexture& model, int instance);

/// The endless dance of Synthesizer, steered while it is played.
///
/// Examples: the walk's p(b) is multiplied by exp(pull · u(b)), u from −2 to 2: with Δ(b)/T(b) the mean velocity of the
/// example, turned to the world where it would begin and then towards the wanted direction by what max_turn allows in
/// half its time, and v₀ the 90th percentile of speeds of all examples,
///
///   direction:          u = (velocity along it) / v₀
///   speed s:            u = −(|velocity| − s)² / v₀²;  with direction, of the vectors
///   facing (alone):     u = −(angle left / 45°)²
///
/// Turn: each frame the whole figure is turned about the foot that stands, by at most max_turn, such that the rest of
/// this example and the next lead in the wanted direction. A command that comes with more than 0.5 s of an example left
/// has it replaced from where it is: its rest then leads to another. Frames come out late by the foot pass (0.4 s).
class SteeredSynthesizer {
 public:
  /// The model must outlive it. Throws InvalidInput for options out of range.
  SteeredSynthesizer(const MotionTexture& model, const SynthesizeOptions& options, const SteerOptions& steer = {});
  ~SteeredSynthesizer();
  SteeredSynthesizer(SteeredSynthesizer&&) noexcept;

  /// From the next frame made on. Throws InvalidInput for numbers that are not finite or a pace out of range.
  void steer(const Steering& steering);
  /// The texton is played as soon as the likeliest transitions lead there (from this example, if it is in the same
  /// largest connected part; else by a jump). Throws InvalidInput when there is no such texton.
  void request(int texton);

  /// Writes the next frame into row `frame` of a clip made with make_output_clip.
  void next(Clip& out, Index frame);
  /// Textons begun since the last call.
  std::vector<PlayedTexton> take_played();
  /// Frames by which next() is behind what steer() acts on.
  Index delay() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace motex
