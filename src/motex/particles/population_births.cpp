// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/population.h"

/// How elements begin: like the cable that they are born after.
namespace motex {
namespace {

constexpr int kMostBackSteps = 200;
constexpr double kPersistent = 0.98;

std::vector<double> values_of(const Cable& cable, auto value) {
  std::vector<double> values;
  for (const Base& base : cable.core) values.push_back(value(base));
  return values;
}

}  // namespace

void CableSynthesizer::Population::learn_noise() {
  for (std::size_t species = 0; species < laws_.size(); ++species) {
    std::vector<std::vector<double>> x, y;
    for (const Cable& cable : model_.cables) {
      if (law_idx(cable.species) != species) continue;
      x.push_back(values_of(cable, [](const Base& base) { return base.x; }));
      y.push_back(values_of(cable, [](const Base& base) { return base.y; }));
    }
    noise_x_.push_back(learn_noise_spread(laws_[species].x, x));
    noise_y_.push_back(learn_noise_spread(laws_[species].y, y));
  }
}

void CableSynthesizer::Population::choose_looks(Element& element, int cable, int species) {
  if (!looks_cables_.empty()) cable = looks_cables_[element.looks_rng.below(looks_cables_.size())];
  const Cable& source = looks_model_.cables[static_cast<std::size_t>(cable)];
  if (options_.looks_of_species >= 0)
    species = options_.looks_of_species;
  else if (!looks_cables_.empty())
    species = source.species;
  element.species = species;
  const bool has_template = species >= 0 && static_cast<std::size_t>(species) < looks_model_.templates.size();
  if (options_.appearance == ParticleAppearance::kReplay || !has_template) {
    const Cable& shown = looks_model_.cables[static_cast<std::size_t>(presentable(cable, element.looks_rng))];
    element.looks = ElementLooks::replay(shown, looks_model_.width, looks_model_.height);
    return;
  }
  element.looks = ElementLooks::sampled(looks_model_.templates[static_cast<std::size_t>(species)],
                                        looks_model_.num_planes, element.looks_rng);
}

/// The cable, or instead of one with stray light another of its species without, those that were seen long first.
int CableSynthesizer::Population::presentable(int cable, Rng& rng) const {
  const auto idx = static_cast<std::size_t>(cable);
  if (has_stray_light_[idx] == 0) return cable;
  const auto weight_of = [&](std::size_t k) {
    const bool fits = has_stray_light_[k] == 0 && looks_model_.cables[k].species == looks_model_.cables[idx].species;
    return fits ? static_cast<double>(looks_model_.cables[k].core.size()) : 0;
  };
  double total = 0;
  for (std::size_t k = 0; k < has_stray_light_.size(); ++k) total += weight_of(k);
  double wanted = rng.uniform() * total;
  for (std::size_t k = 0; k < has_stray_light_.size() && total > 0; ++k) {
    wanted -= weight_of(k);
    if (wanted < 0) return static_cast<int>(k);
  }
  return cable;
}

void CableSynthesizer::Population::add(const ElementBirth& birth) {
  const Cable& cable = model_.cables[static_cast<std::size_t>(birth.cable)];
  Element& element = elements_.emplace_back();
  element.rng = birth.rng;
  element.is_burst = birth.is_burst;
  if (birth.is_burst)
    element.life = birth.life;
  else if (birth.life >= 0 && !has_painted_deaths())
    element.life = std::llround(static_cast<double>(birth.life) / motion_.speed);
  if (!has_painted_deaths()) element.frailty = fates_[static_cast<std::size_t>(birth.cable)].frailty;
  element.fades_in = !birth.is_burst && !birth.enters;
  element.law = &laws_[law_idx(cable.species)];
  element.looks_rng = birth.rng.fork(1);  // so that motion does not depend on looks
  start_motion(element, birth);
  if (draws_looks_) choose_looks(element, birth.cable, cable.species);
  if (birth.enters) back_out(element, birth.side);
}

void CableSynthesizer::Population::choose_paths() {
  for (std::size_t k = 0; k < fates_.size(); ++k) {
    const Cable& cable = model_.cables[k];
    const std::size_t law = law_idx(cable.species);
    const bool obeys = noise_x_[law].is_white() && noise_y_[law].is_white() && !are_few(fates_);
    fates_[k].repeats_path = cable.core.size() > 1 && !obeys;
  }
}

void CableSynthesizer::Population::start_path(Element& element, const ElementBirth& birth) {
  const MovetonDynamics& law = *element.law;
  element.path.emplace(model_.cables[static_cast<std::size_t>(birth.cable)], birth.first_step);
  const PathReplay::Step step = element.path->peek();
  const auto start = [&](CoordinateWalk& walk, const CoordinateDynamics& own, double place, double first, double wind,
                         double gravity) {
    walk.now = place;
    walk.drift = wind;
    walk.before = place - motion_.speed * first - wind;
    walk.constant = (1 - own.persistence()) * wind + gravity;
  };
  start(element.x, law.x, birth.x, step.dx, motion_.wind_x, 0);
  start(element.y, law.y, birth.y, step.dy, motion_.wind_y, motion_.gravity);
}

void CableSynthesizer::Population::start_motion(Element& element, const ElementBirth& birth) {
  if (fates_[static_cast<std::size_t>(birth.cable)].repeats_path) {
    start_path(element, birth);
    if (samples_looks()) start_looks(element, birth.cable);
    return;
  }
  const Cable& cable = model_.cables[static_cast<std::size_t>(birth.cable)];
  const auto start_place = [&](CoordinateWalk& walk, const CoordinateDynamics& law, const NoiseSpread& spread,
                               double place, auto value, double wind) {
    const std::vector<double> values = values_of(cable, value);
    const double phi = law.persistence();
    const double constant = draw_constant_like(law, values, true, element.rng);
    const double drift = std::abs(phi) < kPersistent ? constant / (1 - phi) : law.start_mean;
    const double own_noise = noise_like(spread, law, values);
    const double deviation = std::abs(phi) < kPersistent ? own_noise / std::sqrt(1 - phi * phi) : 0;
    const double noise = element.rng.normal();
    double velocity = drift + deviation * noise;
    if (birth.starts_like && values.size() > 1) velocity = values[1] - values[0];
    walk.now = place;
    walk.before = place - motion_.speed * velocity - wind;
    walk.constant = motion_.speed * constant + (1 - phi) * wind;
    walk.noise = motion_.speed * own_noise;
  };
  const MovetonDynamics& law = *element.law;
  const std::size_t idx = law_idx(cable.species);
  start_place(
      element.x, law.x, noise_x_[idx], birth.x, [](const Base& base) { return base.x; }, motion_.wind_x);
  start_place(
      element.y, law.y, noise_y_[idx], birth.y, [](const Base& base) { return base.y; }, motion_.wind_y);
  element.y.constant += motion_.gravity;
  if (samples_looks()) start_looks(element, birth.cable);
}

/// Scale, angle and brightness begin as those of the cable did.
void CableSynthesizer::Population::start_looks(Element& element, int cable) {
  const MovetonDynamics& law = *element.law;
  const Series& series = series_of(cable);
  const auto start = [&](CoordinateWalk& walk, const CoordinateDynamics& own, const std::vector<double>& values,
                         double& low, double& high) {
    walk.now = walk.before = values[0];
    walk.constant = draw_constant_like(own, values, false, element.looks_rng);
    walk.noise = own.d;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    low = *least - 2 * own.d;
    high = *most + 2 * own.d;
  };
  double low = 0, high = 0;
  start(element.log_scale, law.log_scale, series.log_scale, element.low_log_scale, element.high_log_scale);
  start(element.angle, law.angle, series.angle, low, high);
  start(element.amplitude, law.amplitude, series.amplitude, element.low_amplitude, element.high_amplitude);
}

const CableSynthesizer::Population::Series& CableSynthesizer::Population::series_of(int cable) {
  const auto [found, is_new] = series_.try_emplace(cable);
  if (!is_new) return found->second;
  for (Base base : model_.cables[static_cast<std::size_t>(cable)].core) {
    base.coefficients[0] = static_cast<float>(luma_coefficient(base, model_.num_planes));
    found->second.log_scale.push_back(std::log(std::max(base.scale, 0.1)));
    found->second.angle.push_back(base.angle);
    found->second.amplitude.push_back(peak_amplitude(base));
  }
  return found->second;
}

/// Begins so far outside that nothing of it is seen.
void CableSynthesizer::Population::back_out(Element& element, int side) {
  double vx = element.x.now - element.x.before, vy = element.y.now - element.y.before;
  const auto inward = [side](double x, double y) { return side == 0 ? x : side == 1 ? y : side == 2 ? -x : -y; };
  const double margin = std::clamp(element.looks.reach(), 2.0, 60.0);
  if (inward(vx, vy) < 0.05) {
    element.fades_in = true;
    return;
  }
  for (int k = 0; k < kMostBackSteps && !is_outside(element.x.now, element.y.now, margin); ++k) {
    element.x.now -= vx;
    element.x.before -= vx;
    element.y.now -= vy;
    element.y.before -= vy;
    ++element.outside;
  }
  if (element.path) element.path->hold(element.outside);
}

std::vector<int> CableSynthesizer::Population::examples_for(const InsertedElement& inserted) const {
  if (inserted.species >= static_cast<int>(model_.templates.size()))
    throw InvalidInput("there is no species " + std::to_string(inserted.species) + " to insert; the model has " +
                       std::to_string(model_.templates.size()) + ", counted from 0");
  std::vector<int> like;
  for (std::size_t k = 0; k < model_.cables.size(); ++k)
    if (!model_.cables[k].core.empty() && (inserted.species < 0 || model_.cables[k].species == inserted.species))
      like.push_back(static_cast<int>(k));
  if (like.empty())
    throw InvalidInput(inserted.species < 0 ? std::string("the model has no elements to insert one like them")
                                            : "no learned element is of species " + std::to_string(inserted.species));
  return like;
}

void CableSynthesizer::Population::insert(const InsertedElement& inserted) {
  const std::vector<int> like = examples_for(inserted);
  Rng rng = rng_.fork(3).fork(static_cast<std::uint64_t>(inserted.track));
  ElementBirth birth;
  birth.cable = like[rng.below(like.size())];
  birth.x = inserted.x;
  birth.y = inserted.y;
  birth.rng = rng.fork(1);
  add(birth);
  Element& element = elements_.back();
  element.track = inserted.track;
  const PathReplay::Step path = element.path ? element.path->mean() : PathReplay::Step{};
  const auto set_velocity = [&](CoordinateWalk& walk, const CoordinateDynamics& law, double velocity, double of_path) {
    walk.before = walk.now - velocity;
    walk.drift = velocity - motion_.speed * of_path;
    walk.constant = (1 - law.persistence()) * walk.drift;
  };
  set_velocity(element.x, element.law->x, inserted.vx, path.dx);
  set_velocity(element.y, element.law->y, inserted.vy, path.dy);
  element.fades_in = false;
}

}  // namespace motex
