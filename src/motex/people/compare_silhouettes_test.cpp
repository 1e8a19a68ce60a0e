// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/compare_silhouettes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/people/test_actor.h"

namespace motex {
namespace {

using test_actor::draw;
using test_actor::Pose;

SilhouettePictures pictures_of(const std::vector<Sprite>& sprites) {
  SilhouettePictures pictures(static_cast<int>(sprites.size()));
  for (std::size_t f = 0; f < sprites.size(); ++f)
    pictures.set(static_cast<int>(f), sprites[f], measure_silhouette(sprites[f]));
  return pictures;
}

TEST(SilhouettePictures, DifferenceOfFlatRectanglesIsThatOfTheirColours) {
  const auto flat = [](int left, int width, int height, PremultipliedRgba colour) {
    return Sprite{left, 4, width, height,
                  std::vector<PremultipliedRgba>(static_cast<std::size_t>(width * height), colour)};
  };
  const SilhouettePictures pictures =
      pictures_of({flat(3, 64, 64, {100, 50, 20, 255}), flat(70, 96, 160, {140, 50, 20, 255}), Sprite{},
                   flat(0, 20, 11, {100, 50, 20, 255})});
  EXPECT_NEAR(pictures.difference(0, 1), std::sqrt(40.0 * 40 / 4), 0.01);
  EXPECT_NEAR(pictures.difference(0, 3), 0, 1.0) << "fewer pixels than cells";
  EXPECT_EQ(pictures.difference(0, 2), 255);
  EXPECT_EQ(pictures.difference(2, 2), 0);
  EXPECT_TRUE(pictures.empty(2));
}

TEST(SilhouettePictures, PlaceDoesNotMatterAndPoseDoes) {
  const SilhouettePictures pictures =
      pictures_of({draw({}), draw({0, 0, 0, 40}), draw({0.1, 0, 0, 48}), draw({1, 0, 0, 48}), draw({0, 1, 0, 48})});
  EXPECT_LT(pictures.difference(0, 1), 0.5);
  EXPECT_LT(pictures.difference(0, 1), pictures.difference(0, 2));
  EXPECT_LT(pictures.difference(0, 2), pictures.difference(0, 3));
  EXPECT_GT(pictures.difference(3, 4), 30);
}

TEST(SilhouettePictures, SameOutlineInOtherColoursDiffers) {
  Sprite sprite = draw({});
  const Sprite before = sprite;
  for (PremultipliedRgba& pixel : sprite.pixels) std::swap(pixel[0], pixel[2]);
  EXPECT_GT(pictures_of({before, sprite}).difference(0, 1), 10);
}

TEST(CompareSilhouettes, MatrixHoldsEveryPairAndItsDiagonalFindsTheSameMovement) {
  std::vector<Sprite> sprites;
  for (int take = 0; take < 2; ++take)
    for (int t = 0; t < 70; ++t) sprites.push_back(draw({0.5 - 0.5 * std::cos(0.09 * (t + 5 * take)), 0, 0, 48}));
  const SilhouettePictures pictures = pictures_of(sprites);
  const FrameMatrixF matrix = compare_silhouettes(pictures, {0, 70}, {70, 70}, 2);
  ASSERT_EQ(matrix.rows(), 70);
  for (int f = 0; f < 70; f += 9)
    for (int g = 0; g < 70; g += 11) EXPECT_EQ(matrix(f, g), static_cast<float>(pictures.difference(f, 70 + g)));
  const FrameMatrixF pairs = two_frame_differences(matrix);
  ASSERT_EQ(pairs.rows(), 69);
  // The arm at 12 rises as it does five frames earlier in the other take; where it sinks through the same pose the
  // two consecutive frames tell it apart.
  Index best = -1;
  pairs.row(12).minCoeff(&best);
  EXPECT_EQ(best, 7);
  EXPECT_NEAR(pairs(3, 4), std::sqrt((matrix(3, 4) * matrix(3, 4) + matrix(4, 5) * matrix(4, 5)) / 2), 1e-4);
}

TEST(CompareSilhouettes, RefusesFramesThatAreNotThere) {
  const SilhouettePictures pictures(5);
  EXPECT_THROW(compare_silhouettes(pictures, {0, 6}, {0, 1}), InvalidInput);
  EXPECT_THROW(compare_silhouettes(pictures, {-1, 2}, {0, 1}), InvalidInput);
  EXPECT_THROW(two_frame_differences(FrameMatrixF::Zero(1, 4)), InvalidInput);
}

TEST(ComparableFrames, ReadsEveryFrameOnce) {
  const test_actor::Footage footage = test_actor::make_footage({"A"});
  MemorySprites source(footage.sprites);
  const ComparableFrames frames = comparable_frames(footage.texture, source);
  ASSERT_EQ(frames.pictures.num_frames(), footage.texture.num_frames());
  EXPECT_EQ(frames.masks[30], mask_bits(footage.sprites[30], footage.texture.silhouettes[30]));
  EXPECT_FALSE(frames.pictures.empty(77));
  MemorySprites fewer({footage.sprites[0]});
  EXPECT_THROW(comparable_frames(footage.texture, fewer), InvalidInput);
}

}  // namespace
}  // namespace motex
