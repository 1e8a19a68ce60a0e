// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/traits.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motex/core/error.h"
#include "motex/particles/cable_fate.h"
#include "motex/particles/cable_tracks.h"

namespace motex {
namespace {

constexpr std::size_t kFewestFrames = 3;  // of a cable that tells of motion
constexpr double kLeastBrightness = 1;    // grey levels
constexpr double kLeastShare = 0.05;
constexpr double kLeastGround = 8;  // grey levels behind an element
constexpr std::array<double, static_cast<std::size_t>(Trait::kCount)> kWeights{0.6, 0.6, 0.5, 1, 1, 1.5,
                                                                               0.5, 1.5, 2,   5, 1, 2.5};

/// Bounded, so that clips of a thousand elements are no surer than those of ten.
double logit(double share) { return std::log((share + kLeastShare) / (1 - share + kLeastShare)); }

double share_of(double part, double whole) { return whole > 0 ? part / whole : 0.5; }

/// Sums over cables and steps.
struct Sums {
  double frames = 0, births = 0, births_inside = 0, deaths_inside = 0;
  double cables = 0, dark = 0;
  double steps = 0, vx = 0, vy = 0, square = 0, scaled_square = 0;
  double kept_square = 0;  // of mean velocities
  double gained = 0, moving = 0;
  double faded = 0, changes = 0, changes_square = 0;
  double contrast = 0;  // of all frames of cables
};

/// Accelerations by halves of a life, which errors of tracking do not hide.
void add_motion(const Cable& cable, Sums& sums) {
  const std::size_t last = cable.core.size() - 1;
  const auto num = static_cast<double>(last);
  const double mean_x = (cable.core[last].x - cable.core[0].x) / num,
               mean_y = (cable.core[last].y - cable.core[0].y) / num;
  for (std::size_t t = 1; t <= last; ++t) {
    const double dx = cable.core[t].x - cable.core[t - 1].x, dy = cable.core[t].y - cable.core[t - 1].y;
    const double square = dx * dx + dy * dy, scale = std::max(0.1, cable.core[t].scale);
    sums.vx += dx;
    sums.vy += dy;
    sums.square += square;
    sums.scaled_square += square / (scale * scale);
  }
  sums.steps += num;
  sums.kept_square += num * (mean_x * mean_x + mean_y * mean_y);
  const std::size_t half = last / 2;
  const double before = (cable.core[half].y - cable.core[0].y) / static_cast<double>(half),
               after = (cable.core[last].y - cable.core[last - half].y) / static_cast<double>(half);
  sums.gained += 2 * (after - before);
  sums.moving += 1;
}

/// Light behind a base, all planes of colour together as luma; outside the picture that at its border.
double ground_behind(const TexturedMotion& clip, const Base& base) {
  if (clip.background.empty()) return 0;
  const Plane& first = clip.background[0];
  const int x = std::clamp(static_cast<int>(std::lround(base.x)), 0, first.width - 1),
            y = std::clamp(static_cast<int>(std::lround(base.y)), 0, first.height - 1);
  if (clip.background.size() < 3) return first.at(x, y);
  return luma_of(first.at(x, y), clip.background[1].at(x, y), clip.background[2].at(x, y));
}

void add_brightness(const Cable& cable, const TexturedMotion& clip, Sums& sums) {
  std::vector<double> ln;
  double sum = 0;
  for (Base base : cable.core) {
    base.coefficients[0] = static_cast<float>(luma_coefficient(base, clip.num_planes));
    const double peak = peak_amplitude(base);
    sum += peak;
    sums.contrast += std::abs(peak) / (ground_behind(clip, base) + kLeastGround);
    ln.push_back(std::log(std::max(kLeastBrightness, std::abs(peak))));
  }
  sums.cables += 1;
  sums.dark += sum < 0 ? 1 : 0;
  if (ln.size() < kFewestFrames) return;
  sums.faded += ln.back() - ln.front();
  for (std::size_t t = 1; t < ln.size(); ++t) sums.changes_square += (ln[t] - ln[t - 1]) * (ln[t] - ln[t - 1]);
  sums.changes += static_cast<double>(ln.size() - 1);
}

/// Variance over mean of births in the frames after the first; one where they come independently.
double bursts_of(const TexturedMotion& clip) {
  std::vector<double> births(static_cast<std::size_t>(std::max<std::int64_t>(2, clip.num_frames)) - 1, 0);
  for (const Cable& cable : clip.cables)
    if (cable.first_frame > 0 && cable.first_frame < clip.num_frames)
      births[static_cast<std::size_t>(cable.first_frame) - 1] += 1;
  double sum = 0, square = 0;
  for (const double count : births) {
    sum += count;
    square += count * count;
  }
  const auto num = static_cast<double>(births.size());
  const double mean = sum / num, variance = square / num - mean * mean;
  return (variance + 0.5) / (mean + 0.5);
}

}  // namespace

const char* name_of(Trait trait) {
  static constexpr std::array<const char*, static_cast<std::size_t>(Trait::kCount)> kNames{
      "life",         "born inside", "speed",   "coherence", "steadiness", "falling",
      "acceleration", "fading",      "flicker", "dark",      "bursts",     "contrast"};
  return kNames[static_cast<std::size_t>(trait)];
}

ClipTraits traits_of(const TexturedMotion& clip) {
  if (clip.cables.empty()) throw InvalidInput("a clip without elements has no traits");
  const std::vector<CableFate> fates = fates_of(clip);
  Sums sums;
  for (std::size_t k = 0; k < fates.size(); ++k) {
    const Cable& cable = clip.cables[k];
    if (cable.core.empty()) continue;
    sums.frames += static_cast<double>(cable.core.size());
    sums.births += fates[k].birth_seen ? 1 : 0;
    sums.births_inside += fates[k].birth_seen && !fates[k].enters ? 1 : 0;
    sums.deaths_inside += fates[k].death_seen && !fates[k].leaves ? 1 : 0;
    add_brightness(cable, clip, sums);
    if (cable.core.size() >= kFewestFrames) add_motion(cable, sums);
  }
  const double steps = std::max(1.0, sums.steps), mean_square = std::max(1e-6, sums.square / steps);
  const double speed = std::sqrt(mean_square), vx = sums.vx / steps, vy = sums.vy / steps;
  ClipTraits traits;
  const auto set = [&](Trait trait, double value) { traits.values[static_cast<std::size_t>(trait)] = value; };
  set(Trait::kLife, std::log(sums.frames / ((sums.births_inside + sums.deaths_inside) / 2 + 0.5)));
  set(Trait::kBornInside, logit(share_of(sums.births_inside, sums.births)));
  set(Trait::kSpeed, std::log(std::max(1e-3, std::sqrt(sums.scaled_square / steps))));
  set(Trait::kCoherence, logit((vx * vx + vy * vy) / mean_square));
  set(Trait::kSteadiness, logit(std::min(1.0, sums.kept_square / (steps * mean_square))));
  set(Trait::kFalling, 2 * vy / speed);
  set(Trait::kAcceleration, sums.gained / std::max(1.0, sums.moving) / speed);
  set(Trait::kFading, sums.faded / std::max(1.0, sums.moving));
  set(Trait::kFlicker, std::log(std::max(1e-2, std::sqrt(sums.changes_square / std::max(1.0, sums.changes)))));
  set(Trait::kDark, logit(share_of(sums.dark, sums.cables)));
  set(Trait::kBursts, std::log(bursts_of(clip)));
  set(Trait::kContrast, std::log(std::max(1e-3, sums.contrast / std::max(1.0, sums.frames))));
  return traits;
}

double trait_distance(const ClipTraits& a, const ClipTraits& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.values.size(); ++k)
    sum += kWeights[k] * (a.values[k] - b.values[k]) * (a.values[k] - b.values[k]) / 2;
  return sum;
}

}  // namespace motex
