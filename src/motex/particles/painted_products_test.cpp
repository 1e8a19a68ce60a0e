// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/painted_products.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/rng.h"
#include "motex/particles/joint_fit.h"

namespace motex {
namespace {

constexpr int kWidth = 61, kHeight = 47;

/// So many bases of all kinds, some beyond the picture's edges.
std::vector<Base> scattered(int num, double spread) {
  Rng rng(3);
  std::vector<Base> bases;
  for (int k = 0; k < num; ++k)
    bases.push_back({static_cast<BaseKind>(k % static_cast<int>(kNumBaseKinds)),
                     kWidth / 2.0 + spread * kWidth * (rng.uniform(0, 1) - 0.5),
                     kHeight / 2.0 + spread * kHeight * (rng.uniform(0, 1) - 0.5),
                     rng.uniform(0.7, 3),
                     rng.uniform(0, 3),
                     {}});
  return bases;
}

std::vector<BasePatch> patches_of(const std::vector<Base>& bases) {
  std::vector<BasePatch> out;
  for (const Base& base : bases) out.push_back(render_patch(base, kWidth, kHeight));
  return out;
}

TEST(PaintedProducts, AreThoseOfTheGramMatrix) {
  const std::vector<BasePatch> patches = patches_of(scattered(40, 1.3));
  const PaintedProducts painted(patches);
  std::vector<double> in, out(patches.size());
  for (std::size_t j = 0; j < patches.size(); ++j) in.push_back(std::sin(static_cast<double>(j)));
  std::vector<float> canvas;
  for (int time = 0; time < 2; ++time) {  // the buffer is left as it was
    painted.multiply(in, out, canvas);
    for (std::size_t j = 0; j < patches.size(); ++j) {
      double expected = 0;
      for (std::size_t k = 0; k < patches.size(); ++k) expected += inner_product(patches[j], patches[k]) * in[k];
      ASSERT_NEAR(out[j], expected, 1e-5) << j;
    }
  }
}

TEST(PaintedProducts, OfNothingIsNothing) {
  std::vector<double> out(2, 7);
  std::vector<float> canvas;
  PaintedProducts(std::vector<BasePatch>(2)).multiply({1, 2}, out, canvas);
  EXPECT_EQ(out, std::vector<double>(2, 0));
}

TEST(JointFit, ACrowdIsFittedAsWellAsFew) {
  for (const int num : {6, 400}) {  // the many have more overlaps than inner products are kept for
    const std::vector<Base> bases = scattered(num, 0.8);
    Plane image(kWidth, kHeight);
    for (std::size_t j = 0; j < bases.size(); ++j)
      add_patch(image, render_patch(bases[j], kWidth, kHeight), 50 + 10 * static_cast<float>(j % 7));
    const double before = sum_of_squares(image);
    const JointFit fit(bases, kWidth, kHeight, 0.02);
    const std::vector<float> alpha = fit.solve(image, std::vector<float>(bases.size(), 0));
    for (std::size_t j = 0; j < bases.size(); ++j) add_patch(image, fit.patches()[j], -alpha[j]);
    EXPECT_LT(sum_of_squares(image), 1e-3 * before) << num;
  }
}

}  // namespace
}  // namespace motex
