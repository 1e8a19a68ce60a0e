// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// A Gaussian spot A e^{−q/2}, q = (p − p₀)ᵀ P (p − p₀), P = e^{−E} / s² with E the symmetric traceless matrix
/// (e₁ e₂; e₂ −e₁) and e = √(e₁² + e₂²): deviation s e^{e/2} along its axis (at angle ½ atan2(e₂, e₁)), s e^{−e/2}
/// across.
struct Blob {
  double x = 0, y = 0;      ///< pixels
  double log_scale = 0;     ///< ln s
  double e1 = 0, e2 = 0;    ///< 0 = round
  double amplitude = 0;     ///< A, grey levels
  double place_spread = 0;  ///< deviation of x and y that the noise brings about in the joint fit, pixels
  double log_scale_spread = 0, amplitude_spread = 0;
  double seen_x = 0, seen_y = 0, seen_spread = 0;  ///< place and deviation by the picture alone, without the prior
  double turn = 0;  ///< of an element with parts: from the pictures of its shapes (element_shapes.h), radians

  double scale() const;
  double aspect() const;       ///< e^e ≥ 1: length by breadth
  double angle() const;        ///< of its long axis, radians in [0, π)
  double energy_root() const;  ///< of the sum of its squares, |A| s √π
};

/// What is known of a blob before the picture is looked at: independent normal distributions of x, y, ln s, e₁, e₂, A.
struct BlobPrior {
  std::array<double, 6> mean{};
  std::array<double, 6> precision{};  ///< 1 / variance; 0 = nothing is known
};

struct FitBlobsOptions {
  double noise = 1;       ///< deviation of a pixel, grey levels
  bool oriented = false;  ///< e₁, e₂ are fitted too
  double min_scale = 0.6, max_scale = 10;
  /// Most that a blob adds to a pixel, wherever in it its centre lies, grey levels. Two of opposite sign in one place
  /// would grow without end, and undo one another as long as both are painted.
  double max_light = std::numeric_limits<double>::infinity();
};

class BlobCluster;

/// Fits blobs to an image together: clusters of near ones by Levenberg–Marquardt in all their parameters, one cluster
/// after the other against what the rest leaves. Minimises Σ (image − Σ blobs)² / noise² + the priors.
class BlobFitter {
 public:
  BlobFitter(const Plane& image, const FitBlobsOptions& options);
  ~BlobFitter();
  BlobFitter(const BlobFitter&) = delete;
  BlobFitter& operator=(const BlobFitter&) = delete;

  void add(const Blob& blob, const BlobPrior& prior = {});
  void remove(std::size_t idx);
  /// Fits every cluster with a member that is not settled (added, or next to one that moved).
  void fit(int num_sweeps);

  /// Puts two in the place of one, along the direction in which it leaves most, when Σ residual² / noise² falls by
  /// min_gain or more; the second is added at the end.
  bool split(std::size_t idx, double min_gain);

  /// Adds blobs that may share the light of idx, whose prior is dropped; undone (false) when the sum that fit()
  /// minimises rises by more than max_loss.
  bool add_beside(std::size_t idx, const std::vector<std::pair<Blob, BlobPrior>>& added, double max_loss);

  const std::vector<Blob>& blobs() const { return blobs_; }
  double noise() const { return options_.noise; }
  const Plane& residual() const { return residual_; }  ///< image − Σ blobs
  /// Mean of residual² within two deviations of the blob's centre; 0 when it lies outside the image.
  double misfit(std::size_t idx) const;

 private:
  std::vector<std::vector<int>> clusters() const;
  double cost_near(const Blob& blob) const;
  double cost() const;
  bool fit_cluster(const std::vector<int>& members);
  void unsettle_near(const Blob& blob);
  void paint(const Blob& blob, float sign);

  FitBlobsOptions options_;
  Plane residual_;
  std::vector<Blob> blobs_;
  std::vector<BlobPrior> priors_;
  std::vector<char> is_settled_;
  std::vector<float> painted_;  // buffer of paint()
  std::unique_ptr<BlobCluster> cluster_;
};

}  // namespace motex
