// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/traits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/simulate.h"

namespace motex {
namespace {

TexturedMotion followed(const SimulatedScene& scene, std::int64_t num_frames) {
  TexturedMotion model;
  model.width = scene.width;
  model.height = scene.height;
  model.num_frames = num_frames;
  model.num_planes = 1;
  model.background = to_planes(scene.background, 1);
  for (const SimulatedPoint& point : scene.points) {
    const auto track = static_cast<std::size_t>(point.track);
    if (model.cables.size() <= track) model.cables.resize(track + 1);
    Cable& cable = model.cables[track];
    if (cable.core.empty()) cable.first_frame = point.frame;
    if (cable.end_frame() != point.frame || point.frame >= num_frames) continue;
    Base base{BaseKind::kGaussian, point.x, point.y, std::max(0.5, point.scale), 0, {}};
    base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, point.amplitude));
    cable.core.push_back(base);
  }
  std::erase_if(model.cables, [](const Cable& cable) { return cable.core.empty(); });
  return model;
}

TexturedMotion snow(std::uint64_t seed, double elements, double wind) {
  SimulateSnowOptions options;
  options.seed = seed;
  options.frames = 60;
  options.elements = elements;
  options.wind = wind;
  return followed(simulate_snow(options), 60);
}

TexturedMotion fireworks(std::uint64_t seed) {
  SimulateFireworksOptions options;
  options.seed = seed;
  return followed(simulate_fireworks(options), 60);
}

TexturedMotion birds(std::uint64_t seed) {
  SimulateBirdsOptions options;
  options.seed = seed;
  return followed(simulate_birds(options), 60);
}

TEST(Traits, RefusesNothing) { EXPECT_THROW(traits_of(TexturedMotion{}), InvalidInput); }

TEST(Traits, ScaleAndContrastChangeNothing) {
  const TexturedMotion model = snow(1, 60, 1);
  TexturedMotion larger = model;
  larger.width *= 2;
  larger.height *= 2;
  for (Cable& cable : larger.cables)
    for (Base& base : cable.core) {
      base.x = 2 * base.x + 0.5;
      base.y = 2 * base.y + 0.5;
      base.scale *= 2;
      base.coefficients[0] *= 6;  // three times the peak
    }
  larger.background = Planes(1, Plane(larger.width, larger.height));
  for (int y = 0; y < larger.height; ++y)
    for (int x = 0; x < larger.width; ++x) larger.background[0].at(x, y) = 3 * model.background[0].at(x / 2, y / 2);
  const ClipTraits a = traits_of(model), b = traits_of(larger);
  for (std::size_t k = 0; k < a.values.size(); ++k)
    EXPECT_NEAR(a.values[k], b.values[k], 0.15) << name_of(static_cast<Trait>(k));
}

TEST(Traits, SayWhatTheyShould) {
  const ClipTraits falling = traits_of(snow(2, 60, 0)), bursting = traits_of(fireworks(2)),
                   flying = traits_of(birds(2));
  EXPECT_GT(falling[Trait::kFalling], 1.5);
  EXPECT_GT(falling[Trait::kCoherence], bursting[Trait::kCoherence] + 2);
  EXPECT_GT(bursting[Trait::kBornInside], falling[Trait::kBornInside] + 2);
  EXPECT_GT(bursting[Trait::kBursts], falling[Trait::kBursts] + 1);
  EXPECT_GT(flying[Trait::kDark], 2);
  EXPECT_LT(falling[Trait::kDark], -2);
  EXPECT_GT(bursting[Trait::kContrast], falling[Trait::kContrast] + 0.5);
  EXPECT_LT(flying[Trait::kContrast], 0) << "nothing is darker than black";
}

TEST(Traits, ClipsOfOneKindAreNearest) {
  const std::vector<std::vector<ClipTraits>> kinds{{traits_of(snow(1, 60, 1)), traits_of(snow(2, 200, -1.5))},
                                                   {traits_of(fireworks(1)), traits_of(fireworks(2))},
                                                   {traits_of(birds(1)), traits_of(birds(2))}};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const double own = trait_distance(kinds[kind][0], kinds[kind][1]);
    for (std::size_t other = 0; other < kinds.size(); ++other) {
      if (other == kind) continue;
      for (const ClipTraits& clip : kinds[other])
        EXPECT_LT(own, trait_distance(kinds[kind][0], clip)) << kind << " and " << other;
    }
  }
}

}  // namespace
}  // namespace motex
