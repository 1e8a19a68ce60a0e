// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/detect_cores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/blob_fit.h"
#include "motex/particles/cable.h"

namespace motex {
namespace {

void paint(Plane& image, const Blob& blob) {
  const double c = std::cos(blob.angle()), s = std::sin(blob.angle()), stretch = std::sqrt(blob.aspect());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double dx = x - blob.x, dy = y - blob.y;
      const double u = (dx * c + dy * s) / (blob.scale() * stretch), v = (dy * c - dx * s) * stretch / blob.scale();
      image.at(x, y) += static_cast<float>(blob.amplitude * std::exp(-0.5 * (u * u + v * v)));
    }
}

Plane noise_plane(int width, int height, double deviation, std::uint64_t seed) {
  Plane image(width, height);
  Rng rng(seed);
  for (float& value : image.values) value = static_cast<float>(deviation * rng.normal());
  return image;
}

const Blob& nearest(const std::vector<Blob>& blobs, double x, double y) {
  return *std::min_element(blobs.begin(), blobs.end(), [&](const Blob& a, const Blob& b) {
    return std::hypot(a.x - x, a.y - y) < std::hypot(b.x - x, b.y - y);
  });
}

DetectOptions round_and_bright() {
  DetectOptions options;
  options.sign = CoreSign::kBright;
  options.shape = CoreShape::kRound;
  return options;
}

TEST(DetectCores, NothingIsFoundInNoise) {
  const Plane image = noise_plane(200, 150, 4, 1);
  EXPECT_TRUE(detect_blobs(image, 4, round_and_bright()).empty());
  EXPECT_TRUE(detect_blobs(Plane(0, 0), 4, round_and_bright()).empty());
  EXPECT_NEAR(noise_of({image}), 4, 0.1);
  EXPECT_THROW(noise_of({}), InvalidInput);
}

TEST(DetectCores, AFlatSpotBeyondTheEdgeIsFittedToNothing) {
  BlobFitter fitter(noise_plane(100, 80, 4, 2), {4, true});
  fitter.add({50, 88, std::log(3.9), 1.8, 0, 3});  // its box ends a pixel below the picture
  fitter.add({50, 40, std::log(2.0), 0, 0, 30});
  EXPECT_NO_THROW(fitter.fit(2));
  EXPECT_EQ(fitter.blobs().size(), 2U);
  EXPECT_EQ(fitter.misfit(0), 0);
}

TEST(DetectCores, PlaceScaleAndAmplitudeAreThoseOfTheSpot) {
  Plane image = noise_plane(100, 80, 4, 2);
  paint(image, {30.3, 41.6, std::log(1.4), 0, 0, 90});
  paint(image, {70.8, 20.2, std::log(4.0), 0, 0, 60});
  const std::vector<Blob> blobs = detect_blobs(image, 4, round_and_bright());
  ASSERT_EQ(blobs.size(), 2U);
  const Blob &small = nearest(blobs, 30, 41), &large = nearest(blobs, 70, 20);
  EXPECT_NEAR(small.x, 30.3, 0.15);
  EXPECT_NEAR(small.y, 41.6, 0.15);
  EXPECT_NEAR(small.scale(), 1.4, 0.15);
  EXPECT_NEAR(small.amplitude, 90, 10);
  EXPECT_NEAR(large.scale(), 4, 0.3);
  EXPECT_NEAR(large.amplitude, 60, 5);
  // Four deviations that the fit itself claims.
  EXPECT_LT(std::abs(large.x - 70.8), 4 * large.place_spread);
  EXPECT_LT(large.place_spread, 0.2);
}

TEST(DetectCores, TwoThatOverlapAreFoundAsTwo) {
  for (const double distance : {2.5, 3.0, 4.0}) {
    Plane image = noise_plane(60, 60, 4, 3);
    paint(image, {29.6, 30.2, std::log(1.6), 0, 0, 110});
    paint(image, {29.6 + 0.8 * distance, 30.2 + 0.6 * distance, std::log(1.8), 0, 0, 90});
    const std::vector<Blob> blobs = detect_blobs(image, 4, round_and_bright());
    ASSERT_EQ(blobs.size(), 2U) << distance;
    EXPECT_LT(std::hypot(nearest(blobs, 29.6, 30.2).x - 29.6, nearest(blobs, 29.6, 30.2).y - 30.2), 0.6) << distance;
  }
}

TEST(DetectCores, HalfASpotAtTheEdgeIsFoundWhereItsCentreLies) {
  Plane image = noise_plane(60, 60, 4, 4);
  paint(image, {-0.4, 25.3, std::log(1.8), 0, 0, 120});
  const std::vector<Blob> blobs = detect_blobs(image, 4, round_and_bright());
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_NEAR(blobs[0].x, -0.4, 0.3);
  EXPECT_NEAR(blobs[0].y, 25.3, 0.2);
}

/// Elements of a given sign and shape, far apart.
std::vector<Plane> clip_of(double amplitude, double stretch, double angle) {
  std::vector<Plane> frames;
  for (int t = 0; t < 4; ++t) {
    Plane image = noise_plane(160, 120, 3, static_cast<std::uint64_t>(10 + t));
    for (int k = 0; k < 6; ++k)
      paint(image, {20.3 + 24 * k, 30.7 + 20 * (k % 4), std::log(2.2), stretch * std::cos(2 * angle),
                    stretch * std::sin(2 * angle), amplitude});
    frames.push_back(image);
  }
  return frames;
}

TEST(DetectCores, SignAndShapeAreDecidedOverTheClip) {
  const DetectOptions snow = decided({}, clip_of(90, 0, 0), 3), birds = decided({}, clip_of(-90, 1.1, 0.5), 3);
  EXPECT_EQ(snow.sign, CoreSign::kBright);
  EXPECT_EQ(snow.shape, CoreShape::kRound);
  EXPECT_LT(snow.shape_misfit, 0.03);
  EXPECT_EQ(birds.sign, CoreSign::kDark);
  EXPECT_EQ(birds.shape, CoreShape::kOriented);
}

TEST(DetectCores, ElongatedElementsBecomeStreaks) {
  const std::vector<Plane> frames = clip_of(-90, 1.1, 0.5);
  const DetectOptions options = decided({}, frames, 3);
  const std::vector<Base> cores = detect_cores(frames[0], 3, options);
  ASSERT_EQ(cores.size(), 6U);
  for (const Base& core : cores) {
    EXPECT_EQ(core.kind, BaseKind::kStreak);
    EXPECT_NEAR(core.angle, 0.5 + std::numbers::pi / 2, 0.1);
    EXPECT_NEAR(peak_amplitude(core), -90, 12);
  }
}

/// What a core leaves of its spot is what the best base of its place and turn leaves, by the formula in core_of().
TEST(DetectCores, CoresAreProjections) {
  for (const double aspect : {1.0, 1.3, 2.0, 3.0, 5.0}) {
    const Blob blob{40.3, 39.8, std::log(4.0), std::log(aspect) * std::cos(0.8), std::log(aspect) * std::sin(0.8), 90};
    const Base core = core_of(blob);
    Plane image(80, 80);
    paint(image, blob);
    double energy = 0, left = 0;
    for (const float value : image.values) energy += static_cast<double>(value) * static_cast<double>(value);
    add_patch(image, render_patch(core, 80, 80), -core.coefficients[0]);
    for (const float value : image.values) left += static_cast<double>(value) * static_cast<double>(value);
    const double stretch = core.kind == BaseKind::kStreak ? aspect / 2 : aspect;
    EXPECT_EQ(core.kind == BaseKind::kStreak, aspect >= 2);
    EXPECT_NEAR(left / energy, std::pow((stretch - 1) / (stretch + 1), 2), 0.003) << aspect;
  }
}

TEST(DetectCores, AnExpectedElementTellsTwoApartThatNothingElseCould) {
  Plane image = noise_plane(60, 60, 4, 5);
  const Blob a{30, 30, std::log(1.6), 0, 0, 100}, b{30.7, 30.4, std::log(1.6), 0, 0, 80};
  paint(image, a);
  paint(image, b);
  ASSERT_EQ(detect_blobs(image, 4, round_and_bright()).size(), 1U);
  std::vector<ExpectedBlob> expected;
  for (const Blob& blob : {a, b})
    expected.push_back(
        {blob, {{blob.x, blob.y, blob.log_scale, 0, 0, blob.amplitude}, {25, 25, 400, 0, 0, 0.04}}, true});
  EXPECT_EQ(detect_blobs(image, 4, round_and_bright(), expected).size(), 2U);
}

TEST(DetectCores, AGuessIsTakenOnlyWhereTheFrameAgrees) {
  Plane image = noise_plane(60, 60, 4, 6);
  paint(image, {20, 20, std::log(1.3), 0, 0, 20});
  DetectOptions options = round_and_bright();
  options.min_significance = 14;  // too weak to be found without being expected
  ASSERT_TRUE(detect_blobs(image, 4, options).empty());
  const auto guess = [](double x, double y) {
    return ExpectedBlob{
        {x, y, std::log(1.3), 0, 0, 20}, {{x, y, std::log(1.3), 0, 0, 20}, {4, 4, 100, 0, 0, 0.1}}, false};
  };
  EXPECT_EQ(detect_blobs(image, 4, options, {guess(20.3, 19.8)}).size(), 1U);
  EXPECT_EQ(detect_blobs(image, 4, options, {guess(40, 40)}).size(), 0U);
}

}  // namespace
}  // namespace motex
