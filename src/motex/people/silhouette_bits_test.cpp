// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/silhouette_bits.h"

#include <gtest/gtest.h>

#include <bit>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/people/measure_silhouette.h"

namespace motex {
namespace {

Sprite rectangle(int left, int top, int width, int height) {
  return {left, top, width, height,
          std::vector<PremultipliedRgba>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                         {90, 90, 90, 255})};
}

std::vector<MaskBits> random_masks(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<MaskBits> masks(count);
  for (MaskBits& mask : masks)
    for (std::uint64_t& word : mask) word = rng.next_u64() & rng.next_u64();
  return masks;
}

int num_set(const MaskBits& bits) { return mask_distance(bits, MaskBits{}); }

TEST(MaskBits, NobodySetsNothingAndAFullBoxAll) {
  EXPECT_EQ(num_set(mask_bits({}, {})), 0);
  const Sprite sprite = rectangle(7, 3, 50, 90);
  EXPECT_EQ(num_set(mask_bits(sprite, measure_silhouette(sprite))), kMaskBits);
}

TEST(MaskBits, BoxTakesAwayPlaceAndScale) {
  Sprite small = rectangle(0, 0, 32, 64), large = rectangle(40, 9, 96, 192);
  for (int y = 0; y < 192; ++y)
    for (int x = 0; x < 96; ++x)
      if (x < 48 && y > 95) {
        large.at(x, y) = {};
        small.at(x / 3, y / 3) = {};
      }
  const MaskBits a = mask_bits(small, measure_silhouette(small)), b = mask_bits(large, measure_silhouette(large));
  EXPECT_EQ(a, b);
  EXPECT_EQ(num_set(a), kMaskBits * 3 / 4);
}

TEST(MaskBits, PinnedCornerStandsStillWhenTheOtherSideGrows) {
  const Sprite narrow = rectangle(10, 10, 32, 64), wide = rectangle(10, 10, 48, 64);
  const auto distance = [&](MaskAlignment alignment) {
    return mask_distance(mask_bits(narrow, measure_silhouette(narrow), alignment, 2, 2),
                         mask_bits(wide, measure_silhouette(wide), alignment, 2, 2));
  };
  EXPECT_EQ(distance(MaskAlignment::kBox), 0);
  EXPECT_EQ(distance(MaskAlignment::kLeftTop), 8 * 32);
  EXPECT_EQ(distance(MaskAlignment::kRightBottom), 8 * 32);
  EXPECT_THROW(mask_bits(narrow, measure_silhouette(narrow), MaskAlignment::kLeftTop), InvalidInput);
}

TEST(MaskSet, EveryKindOfInstructionCountsTheSame) {
  const std::vector<MaskBits> masks = random_masks(40, 3);
  const MaskSet set(masks);
  for (int a = 0; a < 40; ++a)
    for (int b = 0; b < 40; ++b)
      EXPECT_EQ(set.distance(a, b),
                mask_distance(masks[static_cast<std::size_t>(a)], masks[static_cast<std::size_t>(b)]));
  std::vector<HammingKernels::Count> kernels{HammingKernels::portable};
#if defined(__x86_64__)
  if (HammingKernels::has_avx2()) kernels.push_back(HammingKernels::avx2);
  if (HammingKernels::has_avx512()) kernels.push_back(HammingKernels::avx512);
#endif
  std::vector<HammingBlock> blocks(3);
  for (std::size_t f = 0; f < 24; ++f)
    for (std::size_t w = 0; w < kMaskWords; ++w)
      blocks[f / 8].words[w][f % 8] = f == 5 ? ~std::uint64_t{0} : f == 6 ? 0 : masks[f][w];
  for (const HammingKernels::Count count : kernels) {
    std::vector<std::uint16_t> distances(8 * 16);
    count(blocks.data(), blocks.data() + 1, 2, distances.data(), 16);
    for (std::size_t r = 0; r < 8; ++r)
      for (std::size_t c = 0; c < 16; ++c) {
        int expected = 0;
        for (std::size_t w = 0; w < kMaskWords; ++w)
          expected += std::popcount(blocks[0].words[w][r] ^ blocks[1 + c / 8].words[w][c % 8]);
        EXPECT_EQ(distances[r * 16 + c], expected) << r << " " << c;
      }
  }
}

TEST(MaskSet, NearestAndPairsAreThoseOfADoubleLoop) {
  std::vector<MaskBits> masks = random_masks(1100, 5);
  masks[1050] = masks[3];
  masks[700] = masks[620];
  const MaskSet set(masks);
  const int apart = 30;
  const std::vector<NearestMask> nearest = set.nearest(apart, 2);
  std::vector<NearestMask> expected(masks.size());
  std::vector<MaskPair> expected_pairs;
  for (int a = 0; a < 1100; ++a)
    for (int b = 0; b < 1100; ++b) {
      if (std::abs(a - b) < apart) continue;
      const int distance = mask_distance(masks[static_cast<std::size_t>(a)], masks[static_cast<std::size_t>(b)]);
      NearestMask& best = expected[static_cast<std::size_t>(a)];
      if (distance < best.distance) best = {b, distance};
      if (a < b && distance <= 690) expected_pairs.push_back({a, b, distance});
    }
  for (std::size_t a = 0; a < masks.size(); ++a) {
    EXPECT_EQ(nearest[a].frame, expected[a].frame) << a;
    EXPECT_EQ(nearest[a].distance, expected[a].distance) << a;
  }
  EXPECT_EQ(nearest[3].frame, 1050);
  const std::vector<MaskPair> pairs = set.pairs_within(690, apart, 1);
  ASSERT_EQ(pairs.size(), expected_pairs.size());
  ASSERT_GT(pairs.size(), 100U);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].a, expected_pairs[i].a);
    EXPECT_EQ(pairs[i].b, expected_pairs[i].b);
    EXPECT_EQ(pairs[i].distance, expected_pairs[i].distance);
  }
}

TEST(MaskSet, OfSeveralAlignmentsTheLeastDistanceCounts) {
  const std::vector<MaskBits> one = random_masks(20, 1), other = random_masks(20, 2);
  const MaskSet both(std::vector<std::vector<MaskBits>>{one, other});
  for (const MaskPair& pair : both.pairs_within(kMaskBits)) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    EXPECT_EQ(pair.distance, std::min(mask_distance(one[a], one[b]), mask_distance(other[a], other[b])));
  }
  EXPECT_THROW(MaskSet(std::vector<std::vector<MaskBits>>{one, {}}), InvalidInput);
  EXPECT_THROW(MaskSet(std::vector<std::vector<MaskBits>>{}), InvalidInput);
}

TEST(MaskSet, NoFrames) {
  const MaskSet set(std::vector<MaskBits>{});
  EXPECT_TRUE(set.nearest().empty());
  EXPECT_TRUE(set.pairs_within(2048).empty());
}

}  // namespace
}  // namespace motex
