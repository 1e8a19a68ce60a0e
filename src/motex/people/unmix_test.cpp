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

TEST(UnmixedAlpha, IsTheShareOfTheFront) {
  const FrontColours fronts{kSkin, kSkin, true};
  EXPECT_NEAR(unmixed_alpha(mixed(kSkin, kGreen, 0.5F), kGreen, fronts, 2, 0), 0.5, 0.03);
  EXPECT_EQ(unmixed_alpha(mixed(kSkin, kGreen, 0.99F), kGreen, fronts, 2, 1), 1);
  EXPECT_EQ(unmixed_alpha(mixed(kSkin, kGreen, 0.01F), kGreen, fronts, 2, 0), 0);
}

TEST(UnmixedAlpha, TakesTheMaterialThatThePixelIsMixedOf) {
  const FrontColours fronts{kBlue, kSkin, true};
  EXPECT_NEAR(unmixed_alpha(mixed(kBlue, kGreen, 0.6F), kGreen, fronts, 2, 0), 0.62, 0.03);
  EXPECT_NEAR(unmixed_alpha(mixed(kSkin, kGreen, 0.6F), kGreen, fronts, 2, 0), 0.62, 0.03);
}

TEST(UnmixedAlpha, AnotherMaterialInsideIsOpaque) {
  const FrontColours fronts{kSkin, kSkin, true};
  EXPECT_EQ(unmixed_alpha(kBlue, kGreen, fronts, 2, 2), 1);
  EXPECT_LT(unmixed_alpha(kBlue, kGreen, fronts, 2, 0), 1);
}

TEST(SpillShare, IsWhatWasMixedIn) {
  EXPECT_NEAR(spill_share(mixed(kGreen, kSkin, 0.1F), kSkin, kGreen, 1), 0.1, 0.01);
  EXPECT_NEAR(spill_share(kSkin, kSkin, kGreen, 1), 0, 0.001);
}

TEST(SpillShare, LeavesGreenClothesGreen) {
  EXPECT_NEAR(spill_share(kLeaf, kLeaf, kGreen, 1), 0, 0.001);
  EXPECT_GT(spill_share({90, 150, 70}, {130, 60, 170}, kGreen, 1), 0.1) << "green beside violet is spill";
}

}  // namespace
}  // namespace motex
