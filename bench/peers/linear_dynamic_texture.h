// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/core/rng.h"
#include "motex/image/planes.h"

namespace motex::peers {

/// Linear dynamic texture, [TM02] eq. 2 [Soatto, Doretto, Wu 2001; Doretto et al. 2003]:
///   x_{t+1} = A x_t + B v_t,   I_t = mean + C x_t
/// C: the first `rank` left singular vectors of the frames minus their mean (all planes together), x: what they leave
/// of each frame, A: least squares, B Bᵀ: covariance of x_{t+1} − A x_t. A is scaled when its spectral radius passes
/// 0.999.
class LinearDynamicTexture {
 public:
  /// rank is cut to the number of frames − 2.
  LinearDynamicTexture(const std::vector<Planes>& frames, int rank);
  int rank() const { return static_cast<int>(transition_.rows()); }
  /// C's own numbers and those of the mean, A and B.
  double num_numbers() const;

  Planes predict(const Planes& last) const;
  void start(std::uint64_t seed);
  /// Endless frames, from a random state of the training frames.
  Planes next();

 private:
  Vector state_of(const Planes& frame) const;
  Planes frame_of(const Vector& state) const;

  Planes mean_;
  Matrix images_;      ///< C, pixels · planes × rank
  Matrix states_;      ///< rank × frames
  Matrix transition_;  ///< A
  Matrix noise_;       ///< B
  Vector state_;
  Rng rng_{1};
};

}  // namespace motex::peers
