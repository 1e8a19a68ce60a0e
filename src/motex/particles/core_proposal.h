// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/rng.h"
#include "motex/particles/cable_prior.h"
#include "motex/particles/core_image.h"

namespace motex {

/// A cell of the picture: pixels left … left + width − 1, top … top + height − 1. Births are proposed cell by cell.
struct PictureCell {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Where a core may be, proposed from the image: a distribution that is looked for first (by one of the look functions,
/// which depend on nothing but their arguments), then drawn from or asked for the density of a given state. Reversible
/// moves ask the same distribution in both directions.
class CoreProposal {
 public:
  virtual ~CoreProposal() = default;

  /// For a core of which the other states of its cable say `belief`. image: without that core.
  virtual void look_around(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief) = 0;
  /// For a new core in the cell. False when nothing there could be one.
  virtual bool look_in_cell(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief,
                            const PictureCell& cell) = 0;
  /// For a core that nothing is known of but that it lies within radius pixels of (x, y).
  virtual void look_near(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, double x, double y,
                         double radius) = 0;
  /// The most likely state.
  virtual CoreState best() const = 0;
  virtual CoreState draw(Rng& rng) const = 0;
  virtual double log_density(const CoreState& state) const = 0;
  /// A step from the state whose density is that of the step back.
  virtual CoreState step(BaseKind kind, const CoreState& state, Rng& rng) const = 0;
};

/// The normal approximation of the posterior of one core at its peak: Gauss–Newton steps on image and belief from the
/// expected place, or from the place nearby that explains most where the belief is wide, or in a cell from its
/// strongest pixel; deviations 15 % wider. One fit: 1 – 2 µs for round Gaussians.
class FittedCoreProposal : public CoreProposal {
 public:
  /// The prior must outlive this object.
  explicit FittedCoreProposal(const CablePrior& prior) : prior_(prior) {}

  void look_around(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief) override;
  bool look_in_cell(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief,
                    const PictureCell& cell) override;
  void look_near(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, double x, double y,
                 double radius) override;
  CoreState best() const override { return mean_; }
  CoreState draw(Rng& rng) const override;
  double log_density(const CoreState& state) const override;
  CoreState step(BaseKind kind, const CoreState& state, Rng& rng) const override;

 private:
  using Square = std::array<std::array<double, kNumCoreCoordinates>, kNumCoreCoordinates>;

  void fit(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, CoreState start);
  CoreState best_start(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief) const;
  bool factor(Square& matrix) const;

  const CablePrior& prior_;
  std::size_t num_ = kCoreAngle;  ///< coordinates
  CoreState mean_{};
  Square root_{};  ///< lower Cholesky factor of the precision
  double log_norm_ = 0;
};

}  // namespace motex
