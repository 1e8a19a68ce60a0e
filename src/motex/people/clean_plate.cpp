// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/clean_plate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/image/pyramid.h"
#include "motex/people/chroma_shift.h"
#include "motex/people/fill_plane.h"
#include "motex/people/mask_regions.h"
#include "motex/people/plate_noise.h"
#include "motex/people/sample_cluster.h"
#include "motex/people/screen_surface.h"
#include "motex/people/square_sums.h"

namespace motex {
namespace {

constexpr int kMostFrames = 48;
constexpr std::size_t kMostBytes = std::size_t{192} << 20;
constexpr int kFewestNatural = 8;
constexpr double kMostNaturalNoise = 3.5;  // grey levels
constexpr float kSeldom = 0.3F;  // of the frames: where the screen is seen less, something may stand before it

void check_frames(std::span<const Image> frames) {
  if (frames.empty()) throw InvalidInput("a clean plate needs frames to be estimated from; none was given");
  for (const Image& frame : frames)
    if (frame.width != frames[0].width || frame.height != frames[0].height)
      throw InvalidInput("the frames of a clip have one size; these have several");
}

/// What the largest cluster of each pixel's samples says.
struct PixelStatistics {
  Planes mean;  // R, G, B
  Plane share;  // of the frames that are in the cluster
};

/// Whether a sample may be the screen: near the expected colour in other light.
bool is_near(const LevelTriple& sample, const LevelTriple& expected, double reach) {
  // Pale clothes are a white screen in other light.
  const float least = std::min({expected[0], expected[1], expected[2]}),
              most = std::max({expected[0], expected[1], expected[2]});
  const LightRange light = most - least > 0.4F * most ? LightRange{0.22F, 0.15F} : LightRange{0.08F, 0.05F};
  const float square = squared_difference(sample[0] - expected[0], sample[1] - expected[1], sample[2] - expected[2],
                                          expected[0], expected[1], expected[2], light);
  return square <= reach * reach;
}

PixelStatistics cluster_pixels(std::span<const Image> frames, const ScreenSurface* screen, double reach, double noise,
                               const JobContext& job) {
  const int width = frames[0].width, height = frames[0].height;
  PixelStatistics found{Planes(3, Plane(width, height)), Plane(width, height)};
  parallel_for(job.jobs, height, [&](int y) {
    SampleCluster cluster(noise);
    for (int x = 0; x < width; ++x) {
      cluster.clear();
      const LevelTriple expected = screen != nullptr ? screen->at(x, y) : LevelTriple{};
      for (const Image& frame : frames) {
        const LevelTriple level = levels(frame.at(x, y));
        if (screen == nullptr || is_near(level, expected, reach)) cluster.add(level);
      }
      const SampleCluster::Result result = cluster.largest();
      for (std::size_t c = 0; c < 3; ++c) found.mean[c].at(x, y) = result.mean[c];
      found.share.at(x, y) = static_cast<float>(result.count) / static_cast<float>(frames.size());
    }
  });
  return found;
}

/// Median over some pixels of the deviation of the steadier half of their samples.
double typical_noise(std::span<const Image> frames) {
  if (frames.size() < 4) return 3;
  const std::size_t step = std::max<std::size_t>(1, frames[0].pixels.size() / 5000);
  std::vector<double> widths;
  std::vector<int> levels(frames.size());
  for (std::size_t i = step / 2; i < frames[0].pixels.size(); i += step) {
    for (std::size_t k = 0; k < frames.size(); ++k) levels[k] = frames[k].pixels[i].g;
    std::sort(levels.begin(), levels.end());
    const std::size_t half = frames.size() / 2;
    int least = 255;
    for (std::size_t k = 0; k + half < levels.size(); ++k) least = std::min(least, levels[k + half] - levels[k]);
    widths.push_back(least);
  }
  // The shortest half of a normal sample spans about 1.2 deviations.
  return std::clamp(quantile(widths, 0.5) / 1.2, kLeastPlateNoise, kLargestPlateNoise / 2);
}

ScreenKind kind_of(Rgba colour) {
  const int most = std::max({colour.r, colour.g, colour.b}), least = std::min({colour.r, colour.g, colour.b});
  if (most - least < 40) return ScreenKind::kPlain;
  if (colour.g == most && colour.g - std::max(colour.r, colour.b) > (most - least) / 3) return ScreenKind::kGreen;
  if (colour.b == most && colour.b - std::max(colour.r, colour.g) > (most - least) / 4) return ScreenKind::kBlue;
  return ScreenKind::kPlain;
}

std::uint8_t level(double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)); }

Rgba mean_of(const Planes& planes) {
  std::array<double, 3> sums{};
  for (std::size_t c = 0; c < 3; ++c)
    for (const float v : planes[c].values) sums[c] += v;
  const auto count = static_cast<double>(planes[0].values.size());
  return {level(sums[0] / count), level(sums[1] / count), level(sums[2] / count), 255};
}

/// Of a region of pixels seldom seen empty: how many it has, how many of these change, and the same of the pixels
/// around.
struct StillCount {
  double inside = 0, moving_inside = 0, around = 0, moving_around = 0;

  /// Around something that stands still the screen is seen nearly always; around the middle of an actor now and then.
  bool is_still() const { return moving_inside <= 0.1 * inside && around > 0 && moving_around <= 0.05 * around; }
};

/// Regions seldom seen empty that stand still and touch nothing that moves: they belong to the scene.
Mask still_things(const Mask& seen, const Plane& screen_share, const Plane& any_share) {
  constexpr float kSteady = 0.6F, kSeenOften = 0.85F;
  constexpr int kAround = 3;  // pixels
  MaskRegions found;
  find_regions(seen, found);
  std::vector<StillCount> counts(found.regions.size());
  for (const RegionRun& run : found.runs) {
    if (found.regions[static_cast<std::size_t>(run.region)].value) continue;
    StillCount& count = counts[static_cast<std::size_t>(run.region)];
    const auto look_around = [&](int x, int y) {
      if (x < 0 || y < 0 || x >= seen.width || y >= seen.height || !seen.at(x, y)) return;
      count.around += 1;
      count.moving_around += screen_share.at(x, y) < kSeenOften ? 1 : 0;
    };
    for (int x = run.first; x <= run.last; ++x) {
      count.inside += 1;
      count.moving_inside += any_share.at(x, run.y) < kSteady ? 1 : 0;
      look_around(x - kAround, run.y), look_around(x + kAround, run.y);
      look_around(x, run.y - kAround), look_around(x, run.y + kAround);
    }
  }
  Mask still(seen.width, seen.height);
  for (const RegionRun& run : found.runs)
    if (counts[static_cast<std::size_t>(run.region)].is_still())
      std::fill_n(&still.at(run.first, run.y), run.last - run.first + 1, std::uint8_t{1});
  return still;
}

/// The surface plus what the pixels seen empty deviate from it, carried into those never seen.
void complete_from_surface(PixelStatistics& pixels, const Mask& known, const ScreenSurface& screen) {
  for (std::size_t c = 0; c < 3; ++c) {
    Plane deviation = pixels.mean[c];
    for (int y = 0; y < known.height; ++y)
      for (int x = 0; x < known.width; ++x) deviation.at(x, y) -= screen.at(x, y)[c];
    fill_unknown(deviation, known);
    for (int y = 0; y < known.height; ++y)
      for (int x = 0; x < known.width; ++x)
        if (!known.at(x, y)) pixels.mean[c].at(x, y) = screen.at(x, y)[c] + deviation.at(x, y);
  }
}

Image picture_of(const Planes& mean) {
  Image picture(mean[0].width, mean[0].height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = {level(mean[0].values[i]), level(mean[1].values[i]), level(mean[2].values[i]), 255};
  return picture;
}

/// Median filter 3 × 3 costs detail; a screen has none, so that averaging over neighbours only takes noise away.
void smooth_screen(Planes& mean, const Mask& still, std::size_t num_frames) {
  const double sigma = num_frames < 12 ? 2 : 1;
  for (Plane& plane : mean) {
    const Plane blurred = gaussian_blur(plane, sigma);
    for (std::size_t i = 0; i < plane.values.size(); ++i)
      if (still.pixels[i] == 0) plane.values[i] = blurred.values[i];
  }
}

CleanPlate screen_plate(std::span<const Image> frames, const ScreenSurface& screen, double noise,
                        const JobContext& job) {
  const double reach = std::clamp(3 * screen.spread, 12.0, 24.0);
  PixelStatistics pixels = cluster_pixels(frames, &screen, reach, noise, job);
  const PixelStatistics any = cluster_pixels(frames, nullptr, 0, noise, job);
  Mask seen(screen.width, screen.height);
  const float least_share = std::max(0.06F, 1.5F / static_cast<float>(frames.size()));
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) seen.pixels[i] = pixels.share.values[i] >= least_share ? 1 : 0;
  if (frames.size() < 3) seen = threshold(pixels.share, 0.01F);
  CleanPlate plate;
  plate.seen_share = static_cast<double>(seen.area()) / static_cast<double>(seen.pixels.size());
  const Mask still = frames.size() >= kFewestNatural
                         ? still_things(threshold(pixels.share, kSeldom), pixels.share, any.share)
                         : Mask(seen.width, seen.height);
  Mask known = seen;
  for (std::size_t i = 0; i < still.pixels.size(); ++i) {
    if (still.pixels[i] == 0) continue;
    known.pixels[i] = 1;
    for (std::size_t c = 0; c < 3; ++c) pixels.mean[c].values[i] = any.mean[c].values[i];
  }
  complete_from_surface(pixels, known, screen);
  smooth_screen(pixels.mean, still, frames.size());
  plate.picture = picture_of(pixels.mean);
  plate.noise = measure_plate_noise(plate.picture, frames, noise, PlateTexture::kSmooth, job);
  plate.colour = mean_of(pixels.mean);
  plate.kind = kind_of(plate.colour);
  plate.chroma_shift = measure_chroma_shift(plate.picture, frames);
  return plate;
}

/// Share of the outlines near the left, right and upper border of one frame, where an actor seldom is, that stay where
/// they are in 60 % of the frames; 1 where there are too few to tell.
double steady_outlines(const Image& frame, const Plane& share) {
  constexpr int kStep = 30;  // grey levels of an outline
  constexpr float kSteady = 0.6F;
  const auto differ = [](const Rgba& a, const Rgba& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) >= kStep;
  };
  const int border = std::max(2, frame.width / 5);
  int outlines = 0, steady = 0;
  for (int y = 1; y + 1 < frame.height; ++y) {
    for (int x = 1; x + 1 < frame.width; ++x) {
      if (y >= frame.height / 5 && x >= border && x < frame.width - border) continue;
      if (!differ(frame.at(x - 1, y), frame.at(x + 1, y)) && !differ(frame.at(x, y - 1), frame.at(x, y + 1))) continue;
      ++outlines;
      steady += share.at(x, y) >= kSteady ? 1 : 0;
    }
  }
  const bool few = outlines * 500 < frame.width * frame.height;
  return few ? 1 : static_cast<double>(steady) / outlines;
}

CleanPlate natural_plate(std::span<const Image> frames, double noise, const JobContext& job) {
  if (frames.size() < kFewestNatural)
    throw InvalidInput("a natural background is learned from at least " + std::to_string(kFewestNatural) +
                       " frames in which the actor moves, not " + std::to_string(frames.size()) +
                       "; give a picture of the empty scene (--plate)");
  // What a moving camera does to outlines must not pass for noise.
  PixelStatistics pixels = cluster_pixels(frames, nullptr, 0, std::min(noise, kMostNaturalNoise), job);
  const Mask steady = threshold(pixels.share, 0.4F);
  CleanPlate plate;
  plate.kind = ScreenKind::kNatural;
  plate.steady_share = plate.seen_share =
      static_cast<double>(steady.area()) / static_cast<double>(steady.pixels.size());
  const double outlines = steady_outlines(frames[frames.size() / 2], pixels.share);
  if (plate.steady_share < 0.6 || outlines < 0.5)
    throw InvalidInput("the camera moves, or the light does: only " +
                       std::to_string(static_cast<int>(100 * std::min(plate.steady_share, outlines))) +
                       " % of the picture stays as it is; keying wants a fixed camera or an even screen");
  plate.picture = picture_of(pixels.mean);
  plate.noise = measure_plate_noise(plate.picture, frames, noise, PlateTexture::kDetailed, job);
  plate.colour = mean_of(pixels.mean);
  plate.chroma_shift = measure_chroma_shift(plate.picture, frames);
  return plate;
}

}  // namespace

const char* name_of(ScreenKind kind) {
  constexpr std::array<const char*, 4> kNames{"green", "blue", "plain", "natural"};
  return kNames[static_cast<std::size_t>(kind)];
}

int num_plate_frames(int width, int height) {
  const std::size_t bytes = sizeof(Rgba) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return static_cast<int>(std::clamp<std::size_t>(kMostBytes / std::max<std::size_t>(1, bytes), 8, kMostFrames));
}

CleanPlate estimate_clean_plate(std::span<const Image> frames, const CleanPlateOptions& options, const Mask* garbage,
                                const JobContext& job) {
  check_options(options);
  check_frames(frames);
  const double noise = typical_noise(frames);
  if (options.screen != BackgroundChoice::kNatural)
    if (const std::optional<ScreenSurface> screen = find_screen(frames, garbage))
      return screen_plate(frames, *screen, noise, job);
  if (options.screen == BackgroundChoice::kScreen)
    throw InvalidInput(
        "there is no screen: no colour fills enough of the picture and its borders; mask the rest "
        "(--garbage-mask) or take the scene as it is (--screen natural)");
  return natural_plate(frames, noise, job);
}

CleanPlate clean_plate_of(const Image& picture, std::span<const Image> frames, const JobContext& job) {
  CleanPlate plate;
  plate.picture = picture;
  plate.noise = Plane((picture.width + 1) / 2, (picture.height + 1) / 2, 3);
  plate.seen_share = 1;
  const Planes planes = to_planes(picture, 3);
  plate.colour = mean_of(planes);
  const std::optional<ScreenSurface> screen = find_screen(std::span(&picture, 1), nullptr);
  plate.kind = screen && screen->share > 0.6 ? kind_of(plate.colour) : ScreenKind::kNatural;
  if (frames.empty()) return plate;
  check_frames(frames);
  if (frames[0].width != picture.width || frames[0].height != picture.height)
    throw InvalidInput("the clean plate has " + std::to_string(picture.width) + " × " + std::to_string(picture.height) +
                       " pixels, the frames " + std::to_string(frames[0].width) + " × " +
                       std::to_string(frames[0].height));
  const PlateTexture texture = plate.kind == ScreenKind::kNatural ? PlateTexture::kDetailed : PlateTexture::kSmooth;
  plate.noise = measure_plate_noise(picture, frames, typical_noise(frames), texture, job);
  plate.chroma_shift = measure_chroma_shift(picture, frames);
  return plate;
}

}  // namespace motex
