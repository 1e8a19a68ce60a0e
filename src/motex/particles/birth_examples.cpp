// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "motex/particles/cable_exit.h"
#include "motex/particles/cable_fate.h"
#include "motex/particles/path_replay.h"

/// What of the clip's cables its ends cut off, and how often elements like them are born.
namespace motex {
namespace {

constexpr double kLongestResidence = 10;  // clip lengths
constexpr double kLeavingLives = 4;       // lives after which one that should have left is gone at last

/// Frames until death inside, at most `frames`, for an element that stays where it is.
double expected_rest(const DeathLaw& deaths, const Base& at, std::int64_t age, double frames) {
  double alive = 1, sum = 0;
  for (double k = 0; k < frames && alive > 1e-3; k += 1, ++age) {
    alive *= 1 - deaths.probability(at.x, at.y, age);
    sum += alive;
  }
  return sum;
}

double longest_residence(const TexturedMotion& model) {
  return kLongestResidence * static_cast<double>(model.num_frames);
}

/// Frames until something of that probability a frame happens, at most so many.
double ends_within(double frames, double probability, Rng& rng) {
  if (probability <= 0) return frames;
  return std::min(frames, std::floor(std::log(1 - rng.uniform()) / std::log1p(-std::min(probability, 0.999))));
}

/// Probabilities a frame that an element was born inside just before, and that it dies inside just after.
struct CutHazards {
  double birth = 0, death = 0;
};

/// What the clip cut off of a cable, at its mean velocity.
void extend_straight(const TexturedMotion& model, const Cable& cable, const CableFate& fate, const CutHazards& hazards,
                     Rng& rng, BirthExample& example) {
  const Base &first = cable.core.front(), &last = cable.core.back();
  const double longest = longest_residence(model);
  if (!fate.birth_seen && !fate.enters) {
    const StraightExit entry = straight_exit(model, first.x, first.y, -fate.vx, -fate.vy);
    const double before = ends_within(std::min(entry.frames, longest), hazards.birth, rng);
    example.enters = before >= entry.frames;
    example.side = entry.side;
    example.x -= before * fate.vx;
    example.y -= before * fate.vy;
    example.residence += before;
  }
  if (!fate.death_seen && !fate.leaves) {
    const StraightExit exit = straight_exit(model, last.x, last.y, fate.vx, fate.vy);
    example.residence += ends_within(std::min(exit.frames, longest), hazards.death, rng);
  }
}

/// Where a path goes beyond one end of its cable.
struct PathEnd {
  double x = 0, y = 0;  ///< its last place in the picture
  double frames = 0;    ///< to there
  bool leaves = false;
  int side = 0;  ///< where it leaves
};

PathEnd beyond(const TexturedMotion& model, const Cable& cable, bool forwards, double most_frames) {
  const PathReplay path(cable);
  const Base& from = forwards ? cable.core.back() : cable.core.front();
  PathEnd end{from.x, from.y, 0, false, 0};
  std::int64_t step = forwards ? static_cast<std::int64_t>(cable.core.size()) - 1 : -1;
  for (; end.frames < most_frames; end.frames += 1, step += forwards ? 1 : -1) {
    const PathReplay::Step by = path.step_at(step);
    const double x = end.x + (forwards ? by.dx : -by.dx), y = end.y + (forwards ? by.dy : -by.dy);
    const std::array<bool, 4> outside{(x < -0.5), (y < -0.5), (x > model.width - 0.5), (y > model.height - 0.5)};
    const auto crossed = std::find(outside.begin(), outside.end(), true);
    if (crossed != outside.end()) {
      end.leaves = true;
      end.side = static_cast<int>(crossed - outside.begin());
      return end;
    }
    end.x = x;
    end.y = y;
  }
  return end;
}

/// What the clip cut off of a cable, along its own path; and how long it lives where that is not left to the death law.
void extend_path(const TexturedMotion& model, const Cable& cable, const CableFate& fate, const CutHazards& hazards,
                 bool has_own_life, Rng& rng, BirthExample& example) {
  const double longest = longest_residence(model);
  bool leaves = fate.leaves;
  if (!fate.birth_seen && !fate.enters) {
    const PathEnd entry = beyond(model, cable, false, ends_within(longest, hazards.birth, rng));
    example.enters = entry.leaves;
    example.side = entry.side;
    example.x = entry.x;
    example.y = entry.y;
    example.residence += entry.frames;
    example.first_step = -static_cast<std::int64_t>(entry.frames);
  }
  if (!fate.death_seen && !fate.leaves) {
    const PathEnd exit = beyond(model, cable, true, ends_within(longest, hazards.death, rng));
    leaves = exit.leaves;
    example.residence += exit.frames;
  }
  if (has_own_life) example.life = static_cast<std::int64_t>((leaves ? kLeavingLives : 1) * example.residence);
}

}  // namespace

std::vector<BirthExample> birth_examples(const TexturedMotion& model, const std::vector<CableFate>& fates,
                                         const DeathLaw& deaths, double kappa, Rng& rng) {
  double num_inside = 0, num_presences = 0;
  for (std::size_t k = 0; k < fates.size(); ++k) {
    num_inside += fates[k].birth_seen && !fates[k].enters ? 1 : 0;
    num_presences += static_cast<double>(model.cables[k].core.size());
  }
  const double born_inside = num_presences > 0 ? num_inside / num_presences : 0;
  std::vector<BirthExample> examples;
  for (std::size_t k = 0; k < fates.size(); ++k) {
    const CableFate& fate = fates[k];
    const Cable& cable = model.cables[k];
    if (cable.core.empty() || fate.in_burst) continue;
    const Base& first = cable.core.front();
    const auto num_seen = static_cast<double>(cable.core.size());
    BirthExample example;
    example.cable = static_cast<int>(k);
    example.x = first.x;
    example.y = first.y;
    example.vx = fate.start_vx;
    example.vy = fate.start_vy;
    example.enters = fate.enters;
    example.side = fate.side;
    example.residence = num_seen;
    example.starts_like = cable.core.size() > 1;
    // as easily as it dies, it may have been born a moment ago
    const double seen_inside = fate.birth_seen && !fate.enters ? 1 : 0;
    const double born_like = born_inside * (seen_inside + kappa) / (born_inside * num_seen + kappa);
    const double dies_like = deaths.mean * fate.frailty;
    if (fate.repeats_path)
      extend_path(model, cable, fate, {born_like, dies_like}, are_few(fates), rng, example);
    else
      extend_straight(model, cable, fate, {born_like, dies_like}, rng, example);
    if (example.residence >= longest_residence(model) && example.life < 0)
      example.life = static_cast<std::int64_t>(example.residence);
    example.rate = num_seen / (static_cast<double>(model.num_frames) * example.residence);
    examples.push_back(example);
  }
  return examples;
}

std::vector<double> burst_rates(const TexturedMotion& model, const std::vector<CableFate>& fates,
                                const DeathLaw& deaths) {
  std::vector<double> rates;
  const auto clip = static_cast<double>(model.num_frames);
  for (const Burst& burst : model.maps.bursts) {
    double seen = 0, whole = 0;
    for (const int cable : burst.cables) {
      if (cable < 0 || static_cast<std::size_t>(cable) >= fates.size()) continue;
      const Cable& member = model.cables[static_cast<std::size_t>(cable)];
      const CableFate& fate = fates[static_cast<std::size_t>(cable)];
      seen += static_cast<double>(member.core.size());
      whole += static_cast<double>(member.core.size());
      if (fate.death_seen || fate.leaves || member.core.empty()) continue;
      const Base& last = member.core.back();
      const StraightExit exit = straight_exit(model, last.x, last.y, fate.vx, fate.vy);
      whole += expected_rest(deaths, last, member.num_frames(), std::min(exit.frames, kLongestResidence * clip));
    }
    rates.push_back(whole > 0 ? seen / (whole * clip) : 0);
  }
  return rates;
}

}  // namespace motex
