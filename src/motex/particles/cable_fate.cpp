// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_fate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/image/pyramid.h"
#include "motex/particles/cable_exit.h"

namespace motex {
namespace {

constexpr std::size_t kStartSteps = 4;  // whose mean is the velocity at birth
constexpr double kBorder = 1.5;         // pixels and core scales that a tracker may miss at the border
constexpr double kPriorPresences = 20;  // of the mean hazard, in each cell and at each age
constexpr std::size_t kNumAges = 200;
constexpr std::size_t kFewCables = 100;
constexpr std::array<double, 12> kFrailties{1e4, 100, 30, 10, 5, 3, 2, 1, 0.5, 0.3, 0.2, 0.1};  // κ

/// Whether a path of that velocity is outside one step and the width of the border further on.
bool soon_outside(const TexturedMotion& model, const Base& at, double vx, double vy, int& side) {
  const double speed = std::hypot(vx, vy);
  if (speed == 0) return false;
  const StraightExit exit = straight_exit(model, at.x, at.y, vx, vy);
  side = exit.side;
  const double normal_speed = exit.side % 2 == 0 ? std::abs(vx) : std::abs(vy);
  return exit.frames * normal_speed <= 1.5 * normal_speed + kBorder + 0.5 * at.scale;
}

/// Deaths inside and presences that could have ended so, on cells or ages.
struct Counts {
  Plane deaths, presences;
  std::vector<double> deaths_at_age, presences_at_age;
  double num_deaths = 0, num_presences = 0;
};

int num_cells(int pixels) { return (pixels + DeathLaw::kCell - 1) / DeathLaw::kCell; }

int cell_of(double x, int cells) {
  return std::clamp(static_cast<int>(std::floor((x + 0.5) / DeathLaw::kCell)), 0, cells - 1);
}

/// part: 0 or 1 = every second cable, 2 = all.
Counts count_deaths(const TexturedMotion& model, const std::vector<CableFate>& fates, std::size_t part) {
  const int width = num_cells(model.width), height = num_cells(model.height);
  Counts counts{Plane(width, height), Plane(width, height), std::vector<double>(kNumAges),
                std::vector<double>(kNumAges)};
  for (std::size_t k = 0; k < fates.size(); ++k) {
    if (part < 2 && k % 2 != part) continue;
    const Cable& cable = model.cables[k];
    const std::size_t num = cable.core.size();
    // of a cable that left, or that the clip's end cut, the last presence tells nothing
    const std::size_t num_told = num - (fates[k].death_seen && !fates[k].leaves ? 0 : 1);
    for (std::size_t age = 0; age < num_told; ++age) {
      const Base& at = cable.core[age];
      const int x = cell_of(at.x, width), y = cell_of(at.y, height);
      const bool dies = age + 1 == num;
      counts.presences.at(x, y) += 1;
      counts.num_presences += 1;
      if (dies) counts.deaths.at(x, y) += 1;
      if (dies) counts.num_deaths += 1;
      if (!fates[k].birth_seen) continue;
      const std::size_t bin = std::min(age, kNumAges - 1);
      counts.presences_at_age[bin] += 1;
      if (dies) counts.deaths_at_age[bin] += 1;
    }
  }
  return counts;
}

std::vector<double> smoothed(const std::vector<double>& values, double sigma) {
  Plane line(static_cast<int>(values.size()), 1);
  for (std::size_t k = 0; k < values.size(); ++k) line.values[k] = static_cast<float>(values[k]);
  const Plane blurred = gaussian_blur(line, sigma);
  return {blurred.values.begin(), blurred.values.end()};
}

double bandwidth_of(const TexturedMotion& model) {
  return model.maps.bandwidth > 0 ? model.maps.bandwidth : 0.05 * std::max(model.width, model.height);
}

DeathLaw law_of(const TexturedMotion& model, const Counts& counts, bool by_age) {
  DeathLaw law;
  law.by_age = by_age;
  law.mean = counts.num_presences > 0 ? counts.num_deaths / counts.num_presences : 0;
  const double sigma = std::max(0.5, bandwidth_of(model) / DeathLaw::kCell);
  const Plane deaths = gaussian_blur(counts.deaths, sigma), presences = gaussian_blur(counts.presences, sigma);
  // a window covers 4πσ² cells, so the prior is spread over them
  const double prior = kPriorPresences / (4 * 3.14159265 * sigma * sigma);
  law.by_place = Plane(deaths.width, deaths.height);
  for (std::size_t i = 0; i < deaths.values.size(); ++i)
    law.by_place.values[i] = static_cast<float>((static_cast<double>(deaths.values[i]) + prior * law.mean) /
                                                (static_cast<double>(presences.values[i]) + prior));
  const std::vector<double> deaths_at = smoothed(counts.deaths_at_age, 1.5),
                            presences_at = smoothed(counts.presences_at_age, 1.5);
  for (std::size_t age = 0; age < kNumAges; ++age)
    law.by_age_frames.push_back((deaths_at[age] + kPriorPresences * law.mean / 5) /
                                (presences_at[age] + kPriorPresences / 5));
  return law;
}

/// Log-likelihood of what became of every second cable, by the law.
double predicted(const TexturedMotion& model, const std::vector<CableFate>& fates, const DeathLaw& law,
                 std::size_t part) {
  double sum = 0;
  for (std::size_t k = part; k < fates.size(); k += 2) {
    if (!fates[k].birth_seen) continue;
    const Cable& cable = model.cables[k];
    const bool dies_inside = fates[k].death_seen && !fates[k].leaves;
    for (std::size_t age = 0; age + (dies_inside ? 0 : 1) < cable.core.size(); ++age) {
      const double p = std::clamp(law.probability(cable.core[age].x, cable.core[age].y, static_cast<std::int64_t>(age)),
                                  1e-9, 1 - 1e-9);
      sum += age + 1 == cable.core.size() ? std::log(p) : std::log1p(-p);
    }
  }
  return sum;
}

}  // namespace

std::vector<CableFate> fates_of(const TexturedMotion& model) {
  std::vector<CableFate> fates(model.cables.size());
  for (std::size_t k = 0; k < fates.size(); ++k) {
    const Cable& cable = model.cables[k];
    CableFate& fate = fates[k];
    const std::size_t num_steps = cable.core.empty() ? 0 : cable.core.size() - 1;
    fate.birth_seen = cable.first_frame > 0;
    fate.death_seen = cable.end_frame() < model.num_frames;
    if (cable.core.empty()) continue;
    const Base &first = cable.core.front(), &last = cable.core.back();
    fate.vx = fate.start_vx = model.flow.vx;
    fate.vy = fate.start_vy = model.flow.vy;
    double end_vx = fate.vx, end_vy = fate.vy;
    if (num_steps > 0) {
      const std::size_t some = std::min(num_steps, kStartSteps);
      const auto share = [](double difference, std::size_t steps) { return difference / static_cast<double>(steps); };
      fate.vx = share(last.x - first.x, num_steps);
      fate.vy = share(last.y - first.y, num_steps);
      fate.start_vx = share(cable.core[some].x - first.x, some);
      fate.start_vy = share(cable.core[some].y - first.y, some);
      end_vx = share(last.x - cable.core[num_steps - some].x, some);
      end_vy = share(last.y - cable.core[num_steps - some].y, some);
    }
    int side = 0;
    fate.enters = soon_outside(model, first, -fate.start_vx, -fate.start_vy, fate.side);
    fate.leaves = soon_outside(model, last, end_vx, end_vy, side);
  }
  for (const Burst& burst : model.maps.bursts)
    for (const int cable : burst.cables)
      if (cable >= 0 && static_cast<std::size_t>(cable) < fates.size())
        fates[static_cast<std::size_t>(cable)].in_burst = true;
  return fates;
}

double DeathLaw::probability(double x, double y, std::int64_t age) const {
  if (by_age) {
    if (by_age_frames.empty()) return mean;
    return by_age_frames[static_cast<std::size_t>(
        std::clamp<std::int64_t>(age, 0, static_cast<std::int64_t>(by_age_frames.size()) - 1))];
  }
  if (by_place.values.empty()) return mean;
  return static_cast<double>(by_place.at(cell_of(x, by_place.width), cell_of(y, by_place.height)));
}

DeathLaw learn_death_law(const TexturedMotion& model, const std::vector<CableFate>& fates) {
  const Counts even = count_deaths(model, fates, 0), odd = count_deaths(model, fates, 1);
  std::array<double, 2> score{};
  for (const bool by_age : {false, true})
    score[by_age ? 1 : 0] = predicted(model, fates, law_of(model, even, by_age), 1) +
                            predicted(model, fates, law_of(model, odd, by_age), 0);
  return law_of(model, count_deaths(model, fates, 2), score[1] > score[0]);
}

double learn_frailties(const TexturedMotion& model, const DeathLaw& deaths, std::vector<CableFate>& fates) {
  std::vector<double> hazards, died;
  for (std::size_t k = 0; k < fates.size(); ++k) {
    const Cable& cable = model.cables[k];
    const bool dies_inside = fates[k].death_seen && !fates[k].leaves;
    double sum = 0;
    for (std::size_t age = 0; age + (dies_inside ? 0 : 1) < cable.core.size(); ++age)
      sum += deaths.probability(cable.core[age].x, cable.core[age].y, static_cast<std::int64_t>(age));
    hazards.push_back(sum);
    died.push_back(dies_inside ? 1 : 0);
  }
  double best = 0, kappa = kFrailties[0];
  for (const double candidate : kFrailties) {
    // log ∫ m^d e^{−m H} Gamma(m; κ, κ) dm
    double score = 0;
    for (std::size_t k = 0; k < hazards.size(); ++k)
      score += (candidate + died[k]) * (std::log(candidate) - std::log(candidate + hazards[k]));
    if (candidate == kFrailties[0] || score > best) {
      best = score;
      kappa = candidate;
    }
  }
  for (std::size_t k = 0; k < fates.size(); ++k) fates[k].frailty = (died[k] + kappa) / (hazards[k] + kappa);
  return kappa;
}

DeathLaw death_law_of_map(const TexturedMotion& model, const Plane& map) {
  const int width = num_cells(model.width), height = num_cells(model.height);
  Plane share(width, height), presences(width, height);
  double total = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      share.at(x / DeathLaw::kCell, y / DeathLaw::kCell) += std::max(0.0F, map.at(x, y));
      total += static_cast<double>(std::max(0.0F, map.at(x, y)));
    }
  DeathLaw law;
  double num_deaths = 0, num_presences = 0;
  for (const Cable& cable : model.cables) {
    num_deaths += cable.end_frame() < model.num_frames ? 1 : 0;
    for (const Base& at : cable.core) presences.at(cell_of(at.x, width), cell_of(at.y, height)) += 1;
    num_presences += static_cast<double>(cable.core.size());
  }
  if (num_presences == 0) return law;
  presences = gaussian_blur(presences, std::max(0.5, bandwidth_of(model) / DeathLaw::kCell));
  const double floor = 0.1 * num_presences / static_cast<double>(share.values.size());
  law.mean = total > 0 ? num_deaths / num_presences : 0;
  law.by_place = Plane(width, height);
  for (std::size_t i = 0; i < share.values.size(); ++i)
    law.by_place.values[i] =
        static_cast<float>(total > 0 ? std::min(1.0, num_deaths * (static_cast<double>(share.values[i]) / total) /
                                                         std::max(floor, static_cast<double>(presences.values[i])))
                                     : 0);
  return law;
}

DeathLaw death_law_of_hazard(const Plane& hazard) {
  Plane pixels(num_cells(hazard.width), num_cells(hazard.height));
  DeathLaw law;
  law.by_place = pixels;
  for (int y = 0; y < hazard.height; ++y)
    for (int x = 0; x < hazard.width; ++x) {
      const float probability = std::clamp(hazard.at(x, y), 0.0F, 1.0F);
      law.by_place.at(x / DeathLaw::kCell, y / DeathLaw::kCell) += probability;
      pixels.at(x / DeathLaw::kCell, y / DeathLaw::kCell) += 1;
      law.mean += static_cast<double>(probability) / static_cast<double>(hazard.values.size());
    }
  for (std::size_t i = 0; i < pixels.values.size(); ++i) law.by_place.values[i] /= pixels.values[i];
  return law;
}

bool are_few(const std::vector<CableFate>& fates) { return fates.size() < kFewCables; }

}  // namespace motex
