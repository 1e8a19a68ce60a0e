// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "motex/core/rng.h"
#include "motex/image/planes.h"
#include "motex/particles/flow_field.h"

namespace motex {

struct StarOptions {
  int past_frames = 2;  ///< δt = −1 … −past_frames
  int past_radius = 2;  ///< of the square of neighbours in frame t − 1; one less each frame further back
  int same_radius =
      2;  ///< of the half square of neighbours above and left in the same frame; 0 = none: the paper's way
};

/// Spatio-temporal autoregression, [TM02] eq. 1 [Cliff and Ord 1976, Szummer and Picard 1996]:
///   z(x, y, t) = Σ a_i z(x + δx_i, y + δy_i, t + δt_i) + N(0, σ²),   z = (I − mean) / deviation at that pixel.
/// Two things differ from the paper: z is relative to what each pixel does (falling water stands beside still rock),
/// and neighbours in the past lie upstream, at x + δx + δt · flow(x), so that a few of them suffice where water is
/// fast.
struct StarModel {
  struct Neighbour {
    int dx = 0, dy = 0, dt = 0;  ///< dt ≤ 0; dt = 0: above or left
    double weight = 0;           ///< a_i
  };
  std::vector<Neighbour> neighbours;
  Plane mean, deviation;  ///< grey levels
  double noise = 1;       ///< σ, of z
  FlowField flow;         ///< without planes: none
};

/// Least squares over the pixels of all frames (every few of them), each weighted by its deviation: still places say
/// nothing. The weights of the past are shrunk until a simulated run neither grows nor fades, and σ is set so that its
/// deviation is that of the frames.
/// Throws InvalidInput (fewer than past_frames + 2 frames, sizes), NumericalFailure (frames that are all alike are
/// fine: weights 0).
StarModel fit_star(const std::vector<Plane>& frames, const FlowField& flow, const StarOptions& options = {});

/// E[I(t) | frames before t]; past: the last frames in order, ≥ the number the model looks back. Neighbours in the same
/// frame take their own expectation.
Plane predict_star(const StarModel& model, const std::vector<Plane>& past);

class StarGrid;

/// Endless frames of the model.
class StarSampler {
 public:
  StarSampler(StarModel model, std::uint64_t seed);
  ~StarSampler();
  StarSampler(StarSampler&&) noexcept;
  StarSampler& operator=(StarSampler&&) noexcept;
  /// mean + deviation · z, clipped nowhere.
  const Plane& next();

 private:
  StarModel model_;
  std::unique_ptr<StarGrid> grid_;
  Rng rng_;
  std::vector<std::vector<float>> past_;  ///< z of the last frames with a margin, newest first
  Plane shown_;
};

}  // namespace motex
