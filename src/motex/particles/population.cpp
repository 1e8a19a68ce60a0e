// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/population.h"

#include <algorithm>
#include <cmath>

#include "motex/particles/fit_dynamics.h"
#include "motex/particles/stray_light.h"

namespace motex {
namespace {

constexpr std::int64_t kFirstWarmUp = 128, kLongestWarmUp = 4096;
constexpr std::int64_t kCalibrationFrames = 300;  // or more,
constexpr double kCalibrationElements = 18'000;   // until so many were counted
constexpr std::int64_t kMostCalibrationFrames = 6000;
constexpr std::int64_t kLongestOutside = 150;  // frames that an element may stray outside
constexpr double kFarOutside = 100;            // pixels
constexpr std::size_t kFewSteps = 30;          // of a species that are too few for dynamics of its own

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
  learn_noise();
  choose_paths();
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
  has_stray_light_ = find_stray_light(looks_model_);
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
  if (has_painted_deaths()) {
    deaths_ = options_.hazard_map.values.empty() ? death_law_of_map(model_, options_.sink_map)
                                                 : death_law_of_hazard(options_.hazard_map);
    report_.deaths_by_age = false;
  }
  if (options_.rate <= 0) return start_at(0, edited, edited_motion());
  choose_steering();
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
  const auto num_frames =
      std::clamp(static_cast<std::int64_t>(kCalibrationElements / wanted), kCalibrationFrames, kMostCalibrationFrames);
  for (std::int64_t t = 0; t < num_frames; ++t, advance()) {
    be_born(new_births_);
    for (const Element& element : elements_) sum += !element.is_burst && is_inside(element) ? 1 : 0;
  }
  draws_looks_ = true;
  const double found = sum / static_cast<double>(num_frames);
  return found > 0 ? std::clamp(wanted / found, 0.5, 2.0) : 1;
}

void CableSynthesizer::Population::start_at(std::int64_t frame, const BirthSettings& settings,
                                            const MotionEdit& motion) {
  births_.emplace(model_, fates_, examples_, burst_rates_, settings, rng_.fork(2));
  motion_ = motion;
  elements_.clear();
  waiting_.clear();
  past_.clear();
  plan_.clear();
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
      begin_frame();
      advance();
    }
    report_.warm_up_frames = num_frames;
    const bool remembers = std::any_of(elements_.begin(), elements_.end(), [num_frames](const Element& element) {
      return element.age > num_frames * 3 / 4;
    });
    if (!remembers || num_frames >= kLongestWarmUp) return;
  }
}

void CableSynthesizer::Population::begin_frame() {
  if (steers_singles_ || steers_bursts_) plan_births();
  be_born(new_births_);
  if (!past_.empty()) tally(past_.back());
}

void CableSynthesizer::Population::be_born(std::vector<ElementBirth>& births) {
  births.clear();
  if (!steers_singles_) births_->singles_at(frame_, births);
  if (!steers_bursts_) births_->bursts_at(frame_, births);
  begin_waiting();
  for (const ElementBirth& birth : births)
    if (birth.frame <= frame_)
      add(birth);
    else
      waiting_.push_back(birth);
  births.clear();
}

/// Births that were to come by now.
void CableSynthesizer::Population::begin_waiting() {
  std::size_t num_left = 0;
  for (const ElementBirth& birth : waiting_)
    if (birth.frame <= frame_)
      add(birth);
    else
      waiting_[num_left++] = birth;
  waiting_.resize(num_left);
}

std::size_t CableSynthesizer::Population::law_idx(int species) const {
  const bool is_free = species < 0 || static_cast<std::size_t>(species) + 1 >= laws_.size();
  return is_free ? laws_.size() - 1 : static_cast<std::size_t>(species);
}

bool CableSynthesizer::Population::samples_looks() const {
  return draws_looks_ && options_.appearance == ParticleAppearance::kTemplates;
}

void CableSynthesizer::Population::move(Element& element) {
  const MovetonDynamics& law = *element.law;
  const bool is_first = element.age == 0;
  if (element.path) {
    const PathReplay::Step step = element.path->next();
    element.x.follow(law.x, motion_.speed * step.dx);
    element.y.follow(law.y, motion_.speed * step.dy);
  } else {
    element.x.step(law.x, element.rng);
    element.y.step(law.y, element.rng);
  }
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

bool CableSynthesizer::Population::is_outside(double x, double y, double margin) const {
  return x < -0.5 - margin || y < -0.5 - margin || x > model_.width - 0.5 + margin || y > model_.height - 0.5 + margin;
}

bool CableSynthesizer::Population::is_inside(const Element& element) const {
  return !is_outside(element.x.now, element.y.now, 0);
}

bool CableSynthesizer::Population::is_in_sight(const Element& element) const {
  return !is_outside(element.x.now, element.y.now, element.looks.reach());
}

bool CableSynthesizer::Population::survives(Element& element) {
  if (element.fading >= 0) return ++element.fading < kFadeFrames;
  const double margin = std::clamp(element.looks.reach(), 2.0, 60.0);
  const double x = element.x.now, y = element.y.now;
  const double u = element.rng.uniform();  // always one draw, so that settings do not shift the others
  if (is_outside(x, y, margin)) {
    const double vx = x - element.x.before, vy = y - element.y.before;
    const bool goes =
        (x < 0 && vx < 0) || (y < 0 && vy < 0) || (x > model_.width - 1 && vx > 0) || (y > model_.height - 1 && vy > 0);
    const bool far = is_outside(x, y, margin + kFarOutside);
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
  begin_frame();
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

double CableSynthesizer::Population::learned_per_frame(bool with_bursts) const {
  double sum = 0;
  for (std::size_t k = 0; k < model_.cables.size(); ++k) {
    if (!with_bursts && fates_[k].in_burst) continue;
    for (const Base& base : model_.cables[k].core) sum += is_outside(base.x, base.y, 0) ? 0 : 1;
  }
  return sum / static_cast<double>(model_.num_frames);
}

}  // namespace motex
