// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/cable_fate.h"
#include "motex/particles/moveton_dynamics.h"
#include "motex/particles/moveton_frame.h"
#include "motex/particles/path_replay.h"
#include "motex/particles/sample_moveton.h"

namespace motex {

/// One coordinate of one element on its way: z_t = a z_{t−1} + b z_{t−2} + c_i + d_i n_t.
struct CoordinateWalk {
  double now = 0, before = 0;
  double constant = 0;  ///< c_i
  double noise = 0;     ///< d_i
  double drift = 0;     ///< velocity beside that of a path which it follows

  void step(const CoordinateDynamics& law, Rng& rng) {
    const double next = law.a * now + law.b * before + constant + noise * rng.normal();
    before = now;
    now = next;
  }
  /// As far as a path goes that was seen, and what wind and gravity (the constant) add, damped as the law damps.
  void follow(const CoordinateDynamics& law, double step) {
    drift = law.persistence() * drift + constant;
    before = now;
    now += step + drift;
  }
};

/// c_i of a cable that was observed, from its posterior: before any step N(c + c_slope (start − start_mean), rest²)
/// as draw_cable_constant() has it, each step tells z_t − a z_{t−1} − b z_{t−2} = c_i + d n. Elements made like this
/// cable then have its drift, as well as the cable shows it.
double draw_constant_like(const CoordinateDynamics& law, std::span<const double> values, bool is_place, Rng& rng);

/// What the noise of a coordinate is beyond [TM02]. d_i² ~ scaled inverse chi-square of so many degrees of freedom
/// around typical² (many: all alike): beside smooth flights others jitter, and one d would be wrong for both.
struct NoiseSpread {
  double typical = 0;
  double freedom = 1e4;
  double correlation = 0;  ///< of a residual with the next; 0 = white
  /// A bird that circles turns on for many frames: no white noise of the second-order law does that. Then elements take
  /// the steps of the cable that they are like, in their order.
  bool is_white() const { return correlation < 0.5; }
};
/// From paths of one coordinate: the likeliest of a grid.
NoiseSpread learn_noise_spread(const CoordinateDynamics& law, const std::vector<std::vector<double>>& places);
/// d_i of a cable that was observed: root of the posterior mean (ν typical² + Σ residuals²)/(ν + n).
double noise_like(const NoiseSpread& spread, const CoordinateDynamics& law, std::span<const double> values);

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
  /// Core and coils of that cable again; where it is too short, forwards and backwards in turn. Frames in which it was
  /// at the border of its picture (width × height), where bases are not well determined, are left out.
  static ElementLooks replay(const Cable& cable, int width, int height);
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
  std::size_t first_ = 0, last_ = 0;  // frames of the cable that are shown: those well inside its picture
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
  std::optional<PathReplay> path;  ///< that x and y follow instead of the law
  double low_log_scale = 0, high_log_scale = 0, low_amplitude = 0, high_amplitude = 0;  ///< what the example had
  std::int64_t age = 0;                                                                 ///< frames since birth
  std::int64_t outside = 0;  ///< frames before it came into the picture
  std::int64_t life = -1;    ///< frames until it vanishes; −1: the death law says
  double frailty = 1;        ///< times the death law
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
