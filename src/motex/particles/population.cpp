// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/population.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/fit_dynamics.h"

namespace motex {
namespace {

constexpr std::int64_t kFirstWarmUp = 128, kLongestWarmUp = 4096;
constexpr std::int64_t kCalibrationFrames = 300;
constexpr std::int64_t kLongestOutside = 150;  // frames that an element may stray outside
constexpr double kFarOutside = 100;            // pixels
constexpr int kMostBackSteps = 200;
constexpr std::size_t kFewSteps = 30;  // of a species that are too few for dynamics of its own
constexpr std::size_t kFewestResiduals = 3;
constexpr double kPersistent = 0.98;

bool is_outside(double x, double y, double margin, const TexturedMotion& model) {
  return x < -0.5 - margin || y < -0.5 - margin || x > model.width - 0.5 + margin || y > model.height - 0.5 + margin;
}

std::vector<double> values_of(const Cable& cable, auto value) {
  std::vector<double> values;
  for (const Base& base : cable.core) values.push_back(value(base));
  return values;
}

/// Dynamics of each species; the last are those of free bases.
std::vector<MovetonDynamics> laws_of(const TexturedMotion& model) {
  std::vector<MovetonDynamics> laws = model.dynamics;
  laws.resize(model.templates.size(), laws.empty() ? MovetonDynamics{} : laws[0]);
  std::vector<Cable> free;
  std::size_t num_steps = 0;
  for (const Cable& cable : model.cables)
    if (cable.species < 0 || static_cast<std::size_t>(cable.species) >= model.dynamics.size()) {
      num_steps += cable.core.size();
      free.push_back(cable);
    }
  if (free.empty() || (num_steps < kFewSteps && !model.dynamics.empty()))
    laws.push_back(laws.empty() ? MovetonDynamics{} : laws[0]);
  else
    laws.push_back(fit_dynamics(free));
  return laws;
}

}  // namespace

CableSynthesizer::Population::Population(const TexturedMotion& model, const SynthesizeParticlesOptions& options,
                                         std::int64_t loop_frames)
    : model_(model),
      options_(options),
      looks_model_(options.looks_of != nullptr ? *options.looks_of : model),
      loop_frames_(loop_frames),
      rng_(options.seed),
      fates_(fates_of(model)),
      deaths_(learn_death_law(model, fates_)),
      laws_(laws_of(model)) {
  Rng rng = rng_.fork(1);
  const double kappa = learn_frailties(model, deaths_, fates_);
  examples_ = birth_examples(model, fates_, deaths_, kappa, rng);
  burst_rates_ = burst_rates(model, fates_, deaths_);
  if (options_.looks_of != nullptr || options_.looks_of_species >= 0)
    for (std::size_t k = 0; k < looks_model_.cables.size(); ++k) {
      const Cable& cable = looks_model_.cables[k];
      const bool fits = options_.looks_of_species < 0 || cable.species == options_.looks_of_species;
      if (fits && !cable.core.empty()) looks_cables_.push_back(static_cast<int>(k));
    }
  learn_noise();
  report_.learned_per_frame = learned_per_frame(true);
  report_.deaths_by_age = deaths_.by_age;
}

MotionEdit CableSynthesizer::Population::edited_motion() const {
  return {options_.wind_x, options_.wind_y, options_.gravity, options_.speed};
}

BirthSettings CableSynthesizer::Population::settings() const {
  BirthSettings settings;
  settings.rate = options_.rate;
  settings.speed = options_.speed;
  settings.wind_x = options_.wind_x;
  settings.wind_y = options_.wind_y;
  settings.source = options_.source_map;
  if (options_.uniform) settings.source = Plane(model_.width, model_.height, 1);
  settings.period = loop_frames_;
  return settings;
}

void CableSynthesizer::Population::settle(const JobContext& job) {
  BirthSettings edited = settings();
  if (options_.rate > 0) edited.singles = calibrated_rate(job);
  if (!options_.sink_map.values.empty()) deaths_ = death_law_of_map(model_, options_.sink_map);
  if (options_.rate <= 0) return start_at(0, edited, edited_motion());
  warm_up(edited, edited_motion(), job);
  report_.births_per_frame = births_->births_per_frame();
  report_.bursts_per_frame = births_->bursts_per_frame();
}

/// Births that keep as many single elements in the picture as the clip has, in units of those that were counted.
double CableSynthesizer::Population::calibrated_rate(const JobContext& job) {
  const double wanted = learned_per_frame(false);
  if (wanted <= 0) return 1;
  draws_looks_ = false;
  warm_up({}, {}, job);
  double sum = 0;
  for (std::int64_t t = 0; t < kCalibrationFrames; ++t, advance()) {
    be_born(new_births_);
    for (const Element& element : elements_) sum += !element.is_burst && is_inside(element) ? 1 : 0;
  }
  draws_looks_ = true;
  const double found = sum / static_cast<double>(kCalibrationFrames);
  return found > 0 ? std::clamp(wanted / found, 0.5, 2.0) : 1;
}

void CableSynthesizer::Population::start_at(std::int64_t frame, const BirthSettings& settings,
                                            const MotionEdit& motion) {
  births_.emplace(model_, fates_, examples_, burst_rates_, settings, rng_.fork(2));
  motion_ = motion;
  elements_.clear();
  waiting_.clear();
  frame_ = frame;
  next_track_ = 0;
}

void CableSynthesizer::Population::warm_up(const BirthSettings& settings, const MotionEdit& motion,
                                           const JobContext& job) {
  double longest = 0;
  for (const BirthExample& example : examples_) longest = std::max(longest, example.residence);
  std::int64_t num_frames = kFirstWarmUp;
  while (static_cast<double>(num_frames) * motion.speed < longest && num_frames < kLongestWarmUp) num_frames *= 2;
  for (;; num_frames *= 2) {
    longest_life_ = settings.period > 0 ? num_frames - 1 : 0;
    start_at(-num_frames, settings, motion);
    while (frame_ < 0) {
      job.check_cancelled();
      be_born(new_births_);
      advance();
    }
    report_.warm_up_frames = num_frames;
    const bool remembers = std::any_of(elements_.begin(), elements_.end(), [num_frames](const Element& element) {
      return element.age > num_frames * 3 / 4;
    });
    if (!remembers || num_frames >= kLongestWarmUp) return;
  }
}

void CableSynthesizer::Population::be_born(std::vector<ElementBirth>& births) {
  births.clear();
  births_->at(frame_, births);
  std::size_t num_left = 0;
  for (const ElementBirth& birth : waiting_)
    if (birth.frame <= frame_)
      add(birth);
    else
      waiting_[num_left++] = birth;
  waiting_.resize(num_left);
  for (const ElementBirth& birth : births)
    if (birth.frame <= frame_)
      add(birth);
    else
      waiting_.push_back(birth);
  births.clear();
}

std::size_t CableSynthesizer::Population::law_idx(int species) const {
  const bool is_free = species < 0 || static_cast<std::size_t>(species) + 1 >= laws_.size();
  return is_free ? laws_.size() - 1 : static_cast<std::size_t>(species);
}

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
    element.looks = ElementLooks::replay(source, looks_model_.width, looks_model_.height);
    return;
  }
  element.looks = ElementLooks::sampled(looks_model_.templates[static_cast<std::size_t>(species)],
                                        looks_model_.num_planes, element.looks_rng);
}

void CableSynthesizer::Population::add(const ElementBirth& birth) {
  const Cable& cable = model_.cables[static_cast<std::size_t>(birth.cable)];
  Element& element = elements_.emplace_back();
  element.rng = birth.rng;
  element.is_burst = birth.is_burst;
  element.life = birth.life;
  if (options_.sink_map.values.empty()) element.frailty = fates_[static_cast<std::size_t>(birth.cable)].frailty;
  element.fades_in = !birth.is_burst && !birth.enters;
  element.law = &laws_[law_idx(cable.species)];
  element.looks_rng = birth.rng.fork(1);  // so that motion does not depend on looks
  start_motion(element, birth);
  if (draws_looks_) choose_looks(element, birth.cable, cable.species);
  if (birth.enters) back_out(element, birth.side);
}

void CableSynthesizer::Population::start_motion(Element& element, const ElementBirth& birth) {
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
    if (spread.is_white() || values.size() < kFewestResiduals + 2) return;
    const double mean = constant_and_residuals(law, values, walk.residuals);
    for (double& residual : walk.residuals) residual *= motion_.speed;
    walk.constant = motion_.speed * mean + (1 - phi) * wind;
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

bool CableSynthesizer::Population::samples_looks() const {
  return draws_looks_ && options_.appearance == ParticleAppearance::kTemplates;
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
  for (int k = 0; k < kMostBackSteps && !is_outside(element.x.now, element.y.now, margin, model_); ++k) {
    element.x.now -= vx;
    element.x.before -= vx;
    element.y.now -= vy;
    element.y.before -= vy;
    ++element.outside;
  }
}

void CableSynthesizer::Population::move(Element& element) {
  const MovetonDynamics& law = *element.law;
  const bool is_first = element.age == 0;
  element.x.step(law.x, element.rng);
  element.y.step(law.y, element.rng);
  if (!samples_looks()) {
    ++element.age;
    return;
  }
  const auto step = [&](CoordinateWalk& walk, const CoordinateDynamics& own) {
    if (!is_first) return walk.step(own, element.looks_rng);
    walk.before = walk.now;
    walk.now = own.a0 * walk.now + own.c0 + own.d0 * element.looks_rng.normal();
  };
  step(element.log_scale, law.log_scale);
  step(element.angle, law.angle);
  step(element.amplitude, law.amplitude);
  element.log_scale.now = std::clamp(element.log_scale.now, element.low_log_scale, element.high_log_scale);
  element.amplitude.now = std::clamp(element.amplitude.now, element.low_amplitude, element.high_amplitude);
  element.looks.advance(element.looks_rng);
  ++element.age;
}

bool CableSynthesizer::Population::is_inside(const Element& element) const {
  return !is_outside(element.x.now, element.y.now, 0, model_);
}

bool CableSynthesizer::Population::is_in_sight(const Element& element) const {
  return !is_outside(element.x.now, element.y.now, element.looks.reach(), model_);
}

bool CableSynthesizer::Population::survives(Element& element) {
  if (element.fading >= 0) return ++element.fading < kFadeFrames;
  const double margin = std::clamp(element.looks.reach(), 2.0, 60.0);
  const double x = element.x.now, y = element.y.now;
  const double u = element.rng.uniform();  // always one draw, so that settings do not shift the others
  if (is_outside(x, y, margin, model_)) {
    const double vx = x - element.x.before, vy = y - element.y.before;
    const bool goes =
        (x < 0 && vx < 0) || (y < 0 && vy < 0) || (x > model_.width - 1 && vx > 0) || (y > model_.height - 1 && vy > 0);
    const bool far = is_outside(x, y, margin + kFarOutside, model_);
    if (far || (element.came_in && goes)) return false;
    return element.came_in || element.age < element.outside + kLongestOutside;
  }
  bool dies = longest_life_ > 0 && element.age + kFadeFrames >= longest_life_;
  if (element.life >= 0)
    dies = dies || element.age - element.outside + 1 + kFadeFrames >= element.life;
  else if (is_inside(element))
    dies = dies || u < deaths_.probability(x, y, element.age - element.outside) * element.frailty * motion_.speed;
  if (is_inside(element)) element.came_in = true;
  if (dies) element.fading = 0;
  return true;
}

void CableSynthesizer::Population::advance() {
  std::size_t num_left = 0;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (!survives(elements_[k])) continue;
    move(elements_[k]);
    if (num_left != k) elements_[num_left] = std::move(elements_[k]);
    ++num_left;
  }
  elements_.resize(num_left);
  ++frame_;
}

void CableSynthesizer::Population::draw(MovetonFrame& frame) {
  be_born(new_births_);
  frame.clear();
  frame.frame = frame_;
  for (Element& element : elements_) {
    if (!is_in_sight(element)) continue;
    if (element.track < 0) element.track = next_track_++;
    Moveton moveton;
    moveton.track = element.track;
    moveton.species = element.species;
    const std::int64_t age = element.age - element.outside;
    moveton.pose = element.looks.pose(age);
    moveton.vx = element.x.now - element.x.before;
    moveton.vy = element.y.now - element.y.before;
    moveton.first_base = frame.bases.size();
    element.looks.append(element.x.now, element.y.now, std::exp(element.log_scale.now), element.angle.now,
                         element.amplitude.now, age, element.strength(), frame.bases);
    moveton.num_bases = frame.bases.size() - moveton.first_base;
    if (moveton.num_bases > 0) frame.movetons.push_back(moveton);
  }
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
  const auto set_velocity = [](CoordinateWalk& walk, const CoordinateDynamics& law, double velocity) {
    walk.before = walk.now - velocity;
    walk.constant = (1 - law.persistence()) * velocity;
  };
  set_velocity(element.x, element.law->x, inserted.vx);
  set_velocity(element.y, element.law->y, inserted.vy);
  element.fades_in = false;
}

double CableSynthesizer::Population::learned_per_frame(bool with_bursts) const {
  double sum = 0;
  for (std::size_t k = 0; k < model_.cables.size(); ++k) {
    if (!with_bursts && fates_[k].in_burst) continue;
    for (const Base& base : model_.cables[k].core) sum += is_outside(base.x, base.y, 0, model_) ? 0 : 1;
  }
  return sum / static_cast<double>(model_.num_frames);
}

}  // namespace motex
