// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/synthetic.h"

#include <cmath>

namespace motex {

Vector normal_vector(Rng& rng, Index n) {
  Vector v(n);
  for (Index i = 0; i < n; ++i) v[i] = rng.normal();
  return v;
}

Lds random_lds(Rng& rng, Index d) {
  // Each dimension a damped oscillator r e^{±iω}, mixed by a random, well-conditioned matrix.
  Matrix mix = Matrix::Identity(d, d);
  for (Index i = 0; i < d; ++i) mix.col(i) += 0.3 / std::sqrt(static_cast<double>(d)) * normal_vector(rng, d);
  Vector a1(d), a2(d);
  for (Index i = 0; i < d; ++i) {
    const double radius = rng.uniform(0.9, 0.97), omega = rng.uniform(0.05, 0.5);
    a1[i] = 2 * radius * std::cos(omega);
    a2[i] = -radius * radius;
  }
  Lds lds;
  lds.transition.resize(d, 2 * d);
  // T⁻¹ by Newton iteration from I, which converges as ‖T − I‖ < 1.
  Matrix inverse = Matrix::Identity(d, d);
  for (int i = 0; i < 60; ++i) inverse = inverse * (2 * Matrix::Identity(d, d) - mix * inverse);
  lds.transition.leftCols(d) = mix * a1.asDiagonal() * inverse;
  lds.transition.rightCols(d) = mix * a2.asDiagonal() * inverse;
  lds.offset = 0.1 * normal_vector(rng, d);
  Matrix noise = Matrix::Zero(d, d);
  for (Index i = 0; i < d; ++i) {
    noise(i, i) = rng.uniform(0.2, 1);
    for (Index j = 0; j < i; ++j) noise(i, j) = 0.1 * rng.normal();
  }
  lds.set_noise(noise * noise.transpose());
  return lds;
}

FrameMatrix sample_states(const Lds& lds, Rng& rng, Index num_frames) {
  constexpr Index kWarmUp = 200;
  FrameMatrix states = FrameMatrix::Zero(num_frames + kWarmUp, lds.state_size());
  simulate(lds, states, &rng);
  return states.bottomRows(num_frames);
}

}  // namespace motex
