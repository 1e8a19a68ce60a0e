// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "motex/core/rng.h"
#include "motex/particles/cable_fate.h"
#include "motex/particles/moveton_dynamics.h"
#include "motex/particles/moveton_frame.h"
#include "motex/particles/sample_moveton.h"

namespace motex {

/// One coordinate of one element on its way: z_t = a z_{t−1} + b z_{t−2} + c_i + d n.
struct CoordinateWalk {
  double now = 0, before = 0;
  double constant = 0;  ///< c_i
  double noise = 0;     ///< d

  void step(const CoordinateDynamics& law, Rng& rng) {
    const double next = law.a * now + law.b * before + constant + noise * rng.normal();
    before = now;
    now = next;
  }
};

/// c_i of a cable that was observed, from its posterior: before any step N(c + c_slope (start − start_mean), rest²)
/// as draw_cable_constant() has it, each step tells z_t − a z_{t−1} − b z_{t−2} = c_i + d n. Elements made like this
/// cable then have its drift, as well as the cable shows it.
double draw_constant_like(const CoordinateDynamics& law, std::span<const double> values, bool is_place, Rng& rng);

/// Edits that change how everything moves.
struct MotionEdit {
  double wind_x = 0, wind_y = 0;  ///< added to the mean velocity, pixels a frame
  double gravity = 0;             ///< added to the velocity downwards in each frame, pixels a frame²
  double speed = 1;               ///< times as fast
};

/// How an element looks in each frame of its life.
class ElementLooks {
 public:
  ElementLooks() = default;
  /// Core and coils of that cable again; where it is too short, forwards and backwards in turn.
  static ElementLooks replay(const Cable& cable);
  /// A moveton drawn from the template. The template must outlive it.
  static ElementLooks sampled(const MovetonTemplate& of, int num_planes, Rng& rng);

  bool is_replay() const { return cable_ != nullptr; }
  void advance(Rng& rng) {
    if (moveton_) moveton_->advance(rng);
  }
  int pose(std::int64_t age) const;
  /// Appends core and coils to `bases` at (x, y), all coefficients times strength. scale, angle and amplitude (luma)
  /// are those of sampled looks; a replay has its own.
  void append(double x, double y, double scale, double angle, double amplitude, std::int64_t age, double strength,
              std::vector<Base>& bases) const;
  /// Pixels that it covers around its place.
  double reach() const { return reach_; }

 private:
  std::size_t frame_at(std::int64_t age) const;

  const Cable* cable_ = nullptr;
  std::optional<SampledMoveton> moveton_;
  double reach_ = 0;
};

/// One element of a synthesis.
struct Element {
  Rng rng{0}, looks_rng{0};
  std::int64_t track = -1;
  int species = -1;
  const MovetonDynamics* law = nullptr;
  CoordinateWalk x, y, log_scale, angle, amplitude;
  double low_log_scale = 0, high_log_scale = 0, low_amplitude = 0, high_amplitude = 0;  ///< what the example had
  std::int64_t age = 0;                                                                 ///< frames since birth
  std::int64_t outside = 0;  ///< frames before it came into the picture
  std::int64_t life = -1;    ///< frames until it vanishes; −1: the death law says
  std::int64_t fading = -1;  ///< frames since it died
  bool fades_in = false;
  bool came_in = false;  ///< has been inside
  bool is_burst = false;
  ElementLooks looks;

  double strength() const;
};

/// Frames in which elements that are born or die inside the picture come and go, lest they pop.
constexpr std::int64_t kFadeFrames = 3;

}  // namespace motex
