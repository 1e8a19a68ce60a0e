// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/matrix.h"
#include "motex/core/rng.h"
#include "motex/lds/statistics.h"

namespace motex {

/// x_t = A₁ x_{t−1} + A₂ x_{t−2} + D + B v_t,  v_t ~ N(0, I),  noise covariance B Bᵀ  [MT02 eq. 10, with BBᵀ for its
/// BᵀB].
struct Lds {
  Matrix transition;   ///< [A₁ A₂], d × 2d
  Vector offset;       ///< D, d
  Matrix noise_cov;    ///< B Bᵀ, d × d
  Matrix noise_chol;   ///< B, lower triangular
  double log_det = 0;  ///< log |B Bᵀ|

  Index state_size() const { return offset.size(); }
  /// Sets noise_cov and what follows from it. Throws NumericalFailure unless it is positive definite.
  void set_noise(const Matrix& covariance);
};

/// What is believed of (A, BBᵀ) before a texton's frames are seen: `frames` pseudo-frames with the moments of the
/// corpus, moved to the texton's own means (D has a flat prior).
struct LdsPrior {
  Vector mean;        ///< 3d: of u without its 1; gives D where a texton has no frame
  Matrix covariance;  ///< 3d × 3d: scatter per frame
  double frames = 0;  ///< κ
};
/// From the statistics of a corpus. A ridge of 1e-9 of the mean variance keeps it positive definite.
LdsPrior make_prior(const LdsStatistics& corpus, double frames);

/// Maximum a posteriori [MT02 eq. 13 without its misprint]: S = S_texton + κ S_prior, A = S_{0,12} S_{12,12}⁻¹,
/// D = m₀ − A m₁₂, BBᵀ = (S₀₀ − A S_{12,0}) / (n + κ). Cost O(n d²) was paid by the statistics; here O(d³).
Lds fit_lds(const LdsStatistics& statistics, const LdsPrior& prior);
/// The same with A given: D and BBᵀ alone are fitted.
Lds fit_noise(const LdsStatistics& statistics, const LdsPrior& prior, const Matrix& transition);

/// Log density of the frames that the statistics hold, nats.
double log_likelihood(const Lds& lds, const LdsStatistics& statistics);
/// Log of the prior density of (A, BBᵀ), 0 at its mode, else negative.
double log_prior(const Lds& lds, const LdsPrior& prior);
/// Log evidence ∫ p(frames | A, D, BBᵀ) p(A, D, BBᵀ) under the conjugate matrix-normal-inverse-Wishart prior with the
/// moments of κ corpus frames: closed form in |Λ| and |Ψ|, both read off one Cholesky factor. Cost O(d³).
class LdsEvidence {
 public:
  LdsEvidence(const LdsStatistics& corpus, double prior_frames);
  double operator()(const LdsStatistics& statistics) const;
  /// Of two groups taken together.
  double operator()(const LdsStatistics& a, const LdsStatistics& b) const;

 private:
  double evaluate(Matrix& joint, double count) const;
  Index d_;
  double nu0_, log_det_lambda0_, log_det_psi0_;
  Matrix prior_;  ///< κ/n · corpus moments, ordered [x_{t−1}, x_{t−2}, 1, x_t]
};

/// B⁻¹ [I, −A₁, −A₂, −D], d × (3d + 1): times u_t it gives the whitened residual of a frame.
Matrix whitening(const Lds& lds);

/// Largest modulus of the system's eigenvalues; ≥ 1 is unstable.
double spectral_radius(const Lds& lds);

/// Rows 2 … of `states` by the dynamics, B v added where rng is given [MT02 Figure 4]. Rows 0, 1 are the start.
void simulate(const Lds& lds, Eigen::Ref<FrameMatrix> states, Rng* rng = nullptr, double noise = 1);

}  // namespace motex
