// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/element_shapes.h"

namespace motex {

/// One frame explained by elements of known shapes together: each in turn against what the others leave, in all of its
/// shapes, by Levenberg–Marquardt of place, ln scale and amplitude. Minimises Σ (image − Σ elements)² / noise² +
/// priors.
class ShapeFitter {
 public:
  /// image: frame minus background; it and the shapes must outlive this.
  ShapeFitter(const Plane& image, const ElementShapes& shapes, double noise);

  void add(const ShapedElement& element, const ShapedPrior& prior);
  void remove(std::size_t idx);
  void fit(int num_sweeps);

  /// Fits one to what is left, in the likeliest shape; nothing is added. Returns how much of Σ (…)² / noise² it saves.
  double try_one(ShapedElement& element, const ShapedPrior& prior) const;
  /// The same in the shape that it has.
  double try_shape(ShapedElement& element, const ShapedPrior& prior) const { return -solve(element, prior, 8); }
  /// What taking it away would cost.
  double gain(std::size_t idx) const;
  /// Share of the light under the element (image minus all others) that it explains, 0 … 1.
  double agreement(std::size_t idx) const;
  /// Σ element² / noise².
  double energy(std::size_t idx) const;
  /// Σ left² / noise².
  double error() const;
  const ShapedPrior& prior(std::size_t idx) const { return priors_[idx]; }
  /// Mean square of what is left under it.
  double misfit(std::size_t idx) const;

  const std::vector<ShapedElement>& elements() const { return elements_; }
  double noise() const { return noise_; }
  const Plane& left() const { return left_; }  ///< image − Σ elements

 private:
  struct Box {
    int left, top, right, bottom;
  };
  Box box_of(const ShapedElement& element) const;
  /// visit(x, y, u, v, what the shape is there) at every pixel that the element may touch, in every row_step-th row.
  template <typename Visit>
  void for_each_pixel(const ShapedElement& element, const Visit& visit, int row_step = 1) const;
  void paint(const ShapedElement& element, float sign);
  struct UnderOne {
    double light = 0, left = 0, num = 0;
  };
  UnderOne look_under(const ShapedElement& element) const;
  struct Slopes;
  Slopes slopes_at(const ShapedElement& element, const ShapedPrior& prior) const;
  double rough_cost(const ShapedElement& element, const ShapedPrior& prior) const;
  double solve(ShapedElement& element, const ShapedPrior& prior, int num_steps) const;
  void unsettle_near(const ShapedElement& element);

  const ElementShapes* shapes_;
  double noise_;
  Plane left_;
  std::vector<ShapedElement> elements_;
  std::vector<ShapedPrior> priors_;
  std::vector<char> is_settled_;
};

}  // namespace motex
