// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/unmix.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

constexpr LevelTriple kGreen{40, 180, 60}, kSkin{200, 150, 120}, kBlue{40, 60, 150}, kLeaf{90, 150, 70};

LevelTriple mixed(const LevelTriple& front, const LevelTriple& back, float alpha) {
  LevelTriple out{};
  for (std::size_t c = 0; c < 3; ++c) out[c] = alpha * front[c] + (1 - alpha) * back[c];
  return out;
}

FourTriple four(const LevelTriple& colour) { return {four_of(colour[0]), four_of(colour[1]), four_of(colour[2])}; }

/// Of four pixels alike.
float unmixed(const LevelTriple& pixel, const FrontColours& fronts, int inside) {
  const Four alpha = unmixed_alpha(four(pixel), four(kGreen), fronts, 2, inside);
  EXPECT_EQ(alpha[0], alpha[3]);
  return alpha[1];
}

float spill(const LevelTriple& colour, const LevelTriple& inner) {
  return spill_share(four(colour), inner, four(kGreen), 1)[2];
}

TEST(UnmixedAlpha, IsTheShareOfTheFront) {
  const FrontColours fronts{kSkin, kSkin, true};
  EXPECT_NEAR(unmixed(mixed(kSkin, kGreen, 0.5F), fronts, 0), 0.5, 0.03);
  EXPECT_EQ(unmixed(mixed(kSkin, kGreen, 0.99F), fronts, 1), 1);
  EXPECT_EQ(unmixed(mixed(kSkin, kGreen, 0.01F), fronts, 0), 0);
}

TEST(UnmixedAlpha, TakesTheMaterialThatThePixelIsMixedOf) {
  const FrontColours fronts{kBlue, kSkin, true};
  EXPECT_NEAR(unmixed(mixed(kBlue, kGreen, 0.6F), fronts, 0), 0.62, 0.03);
  EXPECT_NEAR(unmixed(mixed(kSkin, kGreen, 0.6F), fronts, 0), 0.62, 0.03);
}

TEST(UnmixedAlpha, AnotherMaterialInsideIsOpaque) {
  const FrontColours fronts{kSkin, kSkin, true};
  EXPECT_EQ(unmixed(kBlue, fronts, 2), 1);
  EXPECT_LT(unmixed(kBlue, fronts, 0), 1);
}

TEST(UnmixedAlpha, TheRimMayLieInTheShade) {
  const FrontColours fronts{kSkin, kSkin, true};
  const LevelTriple shaded{0.85F * kSkin[0], 0.85F * kSkin[1], 0.85F * kSkin[2]};
  EXPECT_NEAR(unmixed(mixed(shaded, kGreen, 0.6F), fronts, 0), 0.625, 0.02);
  EXPECT_EQ(unmixed({0.9F * kGreen[0], 0.9F * kGreen[1], 0.9F * kGreen[2]}, fronts, 0), 0) << "the screen too";
}

TEST(SpillShare, IsWhatWasMixedIn) {
  EXPECT_NEAR(spill(mixed(kGreen, kSkin, 0.1F), kSkin), 0.1, 0.01);
  EXPECT_NEAR(spill(kSkin, kSkin), 0, 0.001);
}

TEST(SpillShare, LeavesGreenClothesGreen) {
  EXPECT_NEAR(spill(kLeaf, kLeaf), 0, 0.001);
  EXPECT_GT(spill({90, 150, 70}, {130, 60, 170}), 0.1) << "green beside violet is spill";
}

}  // namespace
}  // namespace motex
