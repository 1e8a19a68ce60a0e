// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "motex/motion_texture/model.h"

namespace motex {

/// Where the travelling joint stands and looks, seen from another frame: x, z in cm, heading in radians.
using RootStep = Eigen::Vector3d;
/// The root at `there` as seen from `here`; cm, the turn taken as it is.
RootStep root_step(const FeatureSpace& space, const RootPlace& here, const RootPlace& there);
/// The place that lies `step` from `here`.
RootPlace place_after(const FeatureSpace& space, const RootPlace& here, const RootStep& step);

/// A gap of num_frames frames of which num_before frames before it and num_after frames after it are known (≥ 1).
struct GapShape {
  Index num_frames = 0;
  Index num_before = 0, num_after = 0;
  bool is_end_placed = true;  ///< it is known where the body stands after the gap
};

/// What leads over a gap: rows t = −1 … num_frames + 2 in which row 0 is the last frame before the gap.
struct GapPath {
  FrameMatrix features;  ///< (num_frames + 4) × D; the channels of steps and turn say nothing
  FrameMatrix root;      ///< (num_frames + 4) × 3: RootStep from row 0
};

/// All stretches of a model's examples in which such a gap could lie, to be combined into a path over a given gap.
///
/// What is seen of a gap is one vector z in cm: the states (in the global subspace) of the frames on both sides, the
/// changes over 1/30, 1/15, 2/15, 1/5 and 3/10 s before and after, and the root's step over the gap. Given ẑ, example k
/// (seen side z_k, path y_k) gets the weight a_k of
///
///   y = f(ẑ) + β Σ_{k ∈ nearest} w_k (y_k − f(z_k)),   w_k ∝ exp(−(δ_k² − δ²_min)/(¼ δ²_min)),  δ_k = ‖ẑ − z_k‖
///
/// with f the affine least-squares prediction of paths from what is seen, over all examples, with a ridge of 0.003 n.
/// Both terms are sums of paths, so y = Σ a_k y_k with Σ a_k = 1. f is the mean of a path under one Gaussian of the
/// whole stretch; the second term follows those examples that look most like the gap.
class GapExamples {
 public:
  /// Throws InvalidInput when fewer than 50 stretches of the examples are long enough. Cost of the first use:
  /// 2 n s² for n ≤ 12,000 stretches and s ≈ 13 d numbers seen.
  GapExamples(const MotionTexture& model, const GapShape& shape);
  ~GapExamples();
  GapExamples(GapExamples&&) noexcept;

  /// before: its last num_before rows count, after: its first ones; features. step: from the last frame before the gap
  /// to the first after it.
  Vector seen(const FrameMatrix& before, const FrameMatrix& after, const RootStep& step) const;

  struct Weights {
    Vector weights;            ///< a
    std::vector<int> nearest;  ///< indices of the examples that are followed, nearest first
    double distance = 0;       ///< δ of the nearest, per number seen (root mean square), cm
  };
  /// Follows the `examples` nearest ones with strength β.
  Weights weigh(const Vector& seen, int examples, double strength) const;
  /// Least distance as in Weights.
  double nearest_distance(const Vector& seen) const;

  GapPath mix(const Vector& weights) const;
  /// Corpus row of example k's last frame before the gap.
  Index row(int example) const;
  int size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace motex
