// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/particles/cable.h"
#include "motex/particles/moveton_dynamics.h"
#include "motex/particles/moveton_template.h"

namespace motex {

/// State ξ of a core in one frame.
enum CoreCoordinate : int { kCoreX, kCoreY, kCoreLogScale, kCoreAmplitude, kCoreAngle, kNumCoreCoordinates };
/// x, y (pixels), ln scale, peak (grey levels, sign kept), angle (radians, unwrapped).
using CoreState = std::array<double, kNumCoreCoordinates>;

/// How cables come, go and move, before the pictures are looked at: p(W) of [TM02] eq. 8 with all constants.
///
/// Births are a Poisson process over frames and places; a cable that is there in the first frame began earlier. After
/// each frame a cable dies with a probability that depends on where its dynamics lead it next, or takes a step. Cables
/// that are there in the last frame go on unseen: no death counts there. Places are followed up to `margin` beyond the
/// picture, where what an element still shows of itself is explained.
struct CablePrior {
  int width = 0, height = 0;            ///< of the picture
  double margin = 4;                    ///< pixels beyond the picture
  BaseKind kind = BaseKind::kGaussian;  ///< of new cables
  double noise = 4;                     ///< deviation of a pixel from background + bases, grey levels
  double min_coefficient = 25;          ///< least |α_j| of any core: the square root of the minimum energy
  double sign = 1;                      ///< of every amplitude: +1 bright, −1 dark; 0: either
  double min_scale = 0.6, max_scale = 10;

  double density_first = 1e-3;  ///< elements in the first frame, a pixel
  double births_inside = 1e-6;  ///< a pixel and frame, everywhere
  double births_edge = 1e-4;    ///< a pixel and frame, in the band where elements enter, in addition
  double death_inside = 0.01;   ///< probability a frame where the next place would lie in the picture
  double death_outside = 0.7;   ///< and where it would lie outside
  /// Depth of the band of births along each edge of the grown picture, pixels.
  double band_left = 4, band_right = 4, band_top = 4, band_bottom = 4;

  Spread log_scale{0.4, 0.3};  ///< over new cables
  Spread amplitude{80, 30};    ///< grey levels, sign kept
  MovetonDynamics dynamics;
  int max_per_frame = 1 << 20;  ///< more elements are not possible
};

struct EstimatePriorOptions {
  double noise = 4;              ///< grey levels
  double margin = 4;             ///< pixels
  int num_frames = 0;            ///< of the clip
  double max_birth_share = 0.1;  ///< births inside a frame are at most this share of the elements there
  double max_death_inside = 0.1;
};

/// Rates, spreads and dynamics from cables: a sample of the chain, or linked detections to begin with. Rates are
/// capped, since every broken path adds a false birth and a false death. Dynamics of places: velocity
/// v_t = φ v_{t−1} + c + d n regressed on all pairs of steps; scale and amplitude: random walks.
/// Throws InvalidInput when there is no cable.
CablePrior estimate_prior(const std::vector<Cable>& cables, int width, int height, const EstimatePriorOptions& options);

/// Mean and precision of each coordinate, independent and normal; precision 0 = nothing is known.
struct CoreBelief {
  CoreState mean{};
  CoreState precision{};
};

/// The terms of log p(W).
class CableLaw {
 public:
  CableLaw(const CablePrior& prior, int num_frames);

  const CablePrior& prior() const { return prior_; }
  int num_frames() const { return num_frames_; }

  /// Whether the state can be: inside the grown picture, scale and amplitude within their bounds.
  bool is_possible(BaseKind kind, const CoreState& state) const;
  /// ln density of a cable that begins so.
  double log_birth(const CoreState& state, int frame) const;
  /// ln density of its second state, and of each later one.
  double log_first_step(BaseKind kind, const CoreState& before, const CoreState& state) const;
  double log_step(BaseKind kind, const CoreState& before2, const CoreState& before, const CoreState& state) const;
  /// ln probability to go on, or not, after `frame`. before: null for a cable of length one.
  double log_end(const CoreState* before, const CoreState& state, int frame, bool goes_on) const;

  /// What the other states of a cable say about one of them (null where there is none); exact but for the deaths.
  CoreBelief belief(BaseKind kind, const CoreState* before2, const CoreState* before, const CoreState* after,
                    const CoreState* after2) const;
  /// Mean of the next state.
  CoreState expected(const CoreState* before2, const CoreState& before) const;
  double step_deviation(int coordinate, bool is_first) const;
  int num_coordinates(BaseKind kind) const;

 private:
  struct Line {
    double a, b, c, inverse, log_norm, a0, c0, inverse0, log_norm0;
  };

  CablePrior prior_;
  int num_frames_;
  std::array<Line, kNumCoreCoordinates> lines_;
  double log_first_, log_inside_, log_edge_;
  double log_go_inside_, log_go_outside_, log_die_inside_, log_die_outside_;
  double log_birth_norm_;
};

/// |coefficient| of a base of unit norm / (|peak| · scale), over unbounded pixels.
double coefficient_factor(BaseKind kind);
bool is_round(BaseKind kind);
CoreState core_state(const Base& base);
/// The base of that state; plane 0 alone has a coefficient.
Base core_base(BaseKind kind, const CoreState& state);

}  // namespace motex
