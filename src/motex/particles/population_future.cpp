// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "motex/particles/population.h"

/// Which births come, where they are few: those with which any stretch as long as the clip has the speeds, directions
/// and number of elements of the clip. Chance alone would make it differ by far more than a viewer takes for the same
/// scene. Elements do not touch one another, so that what is seen of one is the same whatever the others do.
namespace motex {
namespace {

constexpr std::size_t kParts = 8;  // of a stretch
constexpr std::size_t kAheadOfLong = 16, kAheadOfBursts = 8;
constexpr std::size_t kTries = 100;        // for each event,
constexpr std::size_t kMostTries = 3500;   // for all of them,
constexpr std::size_t kMostBirths = 2500;  // and so many births foreseen
constexpr std::uint64_t kExchanges = 3;    // for each flight that is drawn anew
constexpr double kShiftParts = 3;          // by which a path may begin earlier or later than its example's
constexpr double kSlack = 0.5;             // of the mean time between births: how much one may come too early or late
constexpr double kTopQuantile = 0.99, kTopSpeeds = 1.25;
// what a stretch may differ by; of bursts, of which one more or less changes much, the count by less than a run may
constexpr double kMostMotion = 0.08, kMostCount = 0.05, kMostCountOfBursts = 0.035;
constexpr double kUnevenWeight = 4;

/// Counts the worst of all most.
double badness(double apart, double most) {
  const double square = (apart / most) * (apart / most);
  return square * square;
}

}  // namespace

void CableSynthesizer::Population::learn_tally() {
  std::vector<double> speeds;
  wanted_parts_.assign(kParts, 0);
  const auto for_each_core = [this](auto&& take) {
    for (std::size_t k = 0; k < fates_.size(); ++k) {
      if (!steers_singles_ && !fates_[k].in_burst) continue;
      const Cable& cable = model_.cables[k];
      for (std::int64_t t = cable.first_frame; t < cable.end_frame(); ++t)
        if (!is_outside(cable.at(t).x, cable.at(t).y, 0)) take(cable, t);
    }
  };
  for_each_core([&](const Cable& cable, std::int64_t t) {
    wanted_parts_[static_cast<std::size_t>(std::clamp<std::int64_t>(t / part_, 0, kParts - 1))] += 1;
    if (t > cable.first_frame)
      speeds.push_back(std::hypot(cable.at(t).x - cable.at(t - 1).x, cable.at(t).y - cable.at(t - 1).y));
  });
  if (speeds.empty()) return;
  const auto top = speeds.begin() + static_cast<std::ptrdiff_t>(kTopQuantile * static_cast<double>(speeds.size()));
  std::nth_element(speeds.begin(), top, speeds.end());
  wanted_ = MotionTally(kTopSpeeds * std::max(0.1, *top));
  for_each_core([this](const Cable& cable, std::int64_t t) {
    if (t > cable.first_frame)
      wanted_.add_element(cable.at(t).x - cable.at(t - 1).x, cable.at(t).y - cable.at(t - 1).y);
  });
  // first steps are not among those, so that the number of elements is set apart
  const double num = std::accumulate(wanted_parts_.begin(), wanted_parts_.end(), 0.0);
  wanted_.add_frames(static_cast<double>(speeds.size()) * static_cast<double>(model_.num_frames) / num);
  std::sort(wanted_parts_.begin(), wanted_parts_.end());
}

void CableSynthesizer::Population::choose_steering() {
  const bool is_edited = options_.wind_x != 0 || options_.wind_y != 0 || options_.gravity != 0 || options_.speed != 1 ||
                         options_.rate != 1 || options_.uniform || !options_.source_map.values.empty() ||
                         has_painted_deaths() || loop_frames_ > 0;
  steers_singles_ = are_few(fates_) && !is_edited && learned_per_frame(false) > 0;
  steers_bursts_ = !is_edited && !burst_rates_.empty();
  num_ahead_ = steers_singles_ ? kAheadOfLong : kAheadOfBursts;
  part_ = std::max<std::int64_t>(1, model_.num_frames / static_cast<std::int64_t>(kParts));
  if (steers_singles_ || steers_bursts_) learn_tally();
}

void CableSynthesizer::Population::tally(MotionTally& into) const {
  for (const Element& element : elements_)
    if (counts(element) && is_inside(element))
      into.add_element(element.x.now - element.x.before, element.y.now - element.y.before);
  into.add_frames(1);
}

/// What will be seen of elements and births alone; frames are counted from now.
std::vector<CableSynthesizer::Population::Sighting> CableSynthesizer::Population::outlook(
    std::vector<Element> elements, std::vector<ElementBirth> births) {
  const std::int64_t now = frame_;
  const bool drew_looks = draws_looks_;
  std::swap(elements_, elements);
  std::swap(waiting_, births);
  std::vector<Sighting> sightings;
  const std::int64_t end = part_ * static_cast<std::int64_t>(num_ahead_);
  for (frame_ = 0; frame_ < end && !(elements_.empty() && waiting_.empty());) {
    draws_looks_ = drew_looks;  // how large they are tells where they come in
    begin_waiting();
    for (const Element& element : elements_)
      if (counts(element) && is_inside(element))
        sightings.push_back({static_cast<std::int32_t>(frame_),
                             wanted_.bins_of(element.x.now - element.x.before, element.y.now - element.y.before)});
    draws_looks_ = false;
    advance();
  }
  draws_looks_ = drew_looks;
  frame_ = now;
  std::swap(elements_, elements);
  std::swap(waiting_, births);
  return sightings;
}

/// How differently the elements are shared out over the parts of the stretch that ends with that one ahead, whatever
/// their order: Wasserstein-1 of their number over its mean. Of bursts alone: that they flare and fade is what is seen
/// of them, while one flock more or less in a part of the clip is chance.
double CableSynthesizer::Population::unevenness(const std::vector<MotionTally>& ahead, std::size_t last) const {
  if (steers_singles_ || past_.size() + last + 1 < kParts) return 0;
  std::array<double, kParts> own{};
  for (std::size_t k = 0; k < kParts; ++k) {
    const std::size_t part = past_.size() + last + 1 - kParts + k;
    own[k] = (part < past_.size() ? past_[part] : ahead[part - past_.size()]).num_elements();
  }
  std::sort(own.begin(), own.end());
  double apart = 0, sum = 0;
  for (std::size_t k = 0; k < kParts; ++k) {
    apart += std::abs(own[k] - wanted_parts_[k]);
    sum += wanted_parts_[k];
  }
  return apart / sum;
}

/// Of all stretches that end with a part ahead.
double CableSynthesizer::Population::cost(const std::vector<MotionTally>& ahead) const {
  MotionTally stretch(wanted_.top_speed());
  for (const MotionTally& part : past_) stretch.add(part);
  double sum = 0;
  for (std::size_t part = 0; part < num_ahead_; ++part) {
    if (past_.size() + part >= kParts) {
      const std::size_t left = past_.size() + part - kParts;
      stretch.add(left < past_.size() ? past_[left] : ahead[left - past_.size()], -1);
    }
    stretch.add(ahead[part]);
    const MotionTally::Difference apart = stretch.difference(wanted_);
    sum += badness(apart.speed, kMostMotion) + badness(apart.direction, kMostMotion) +
           badness(apart.count, steers_bursts_ ? kMostCountOfBursts : kMostCount) +
           kUnevenWeight * unevenness(ahead, part);
  }
  return sum;
}

/// Elsewhere on the path of its example, if it comes in there as well.
void CableSynthesizer::Population::shift_path(ElementBirth& birth, Rng& rng) const {
  const double most = kShiftParts * static_cast<double>(part_);
  const auto shift = static_cast<std::int64_t>(std::floor(rng.uniform(-most, most + 1)));
  const Cable& cable = model_.cables[static_cast<std::size_t>(birth.cable)];
  if (cable.core.size() < 2) return;
  const auto inwards = [&](std::int64_t first) {
    const PathReplay::Step step = PathReplay(cable, first).peek();
    return std::array<double, 4>{step.dx, step.dy, -step.dx, -step.dy}[static_cast<std::size_t>(birth.side)];
  };
  if (!birth.enters || inwards(birth.first_step + shift) > 0.5 * std::abs(inwards(birth.first_step)))
    birth.first_step += shift;
}

CableSynthesizer::Population::Flight CableSynthesizer::Population::foresee(BirthKind kind, std::size_t example,
                                                                           Rng rng) {
  Flight flight;
  flight.example = example;
  births_->add_event(kind, example, 0, rng, flight.births);
  if (kind == BirthKind::kSingle) shift_path(flight.births[0], rng);
  flight.sightings = outlook({}, flight.births);
  return flight;
}

/// Anywhere in its interval, or near it, that is not past.
std::int64_t CableSynthesizer::Population::draw_time(const Planned& event, Rng& rng) const {
  const double rate = births_->rate(event.kind), slack = event.kind == BirthKind::kSingle ? kSlack : 0;
  const auto number = static_cast<double>(event.number);
  const double low = std::max((number - slack) / rate, static_cast<double>(frame_));
  const double high = (number + 1 + slack) / rate;
  return std::max(frame_, static_cast<std::int64_t>(std::floor(rng.uniform(low, std::max(low, high)))));
}

/// Events whose interval begins before the time ahead is over.
void CableSynthesizer::Population::extend_plan(BirthKind kind, const Rng& rng) {
  const double end = static_cast<double>(frame_ + part_ * static_cast<std::int64_t>(num_ahead_));
  std::int64_t& next = kind == BirthKind::kSingle ? next_single_ : next_burst_;
  const double rate = births_->rate(kind);
  for (; rate > 0 && static_cast<double>(next) / rate < end; ++next) {
    Rng own = rng.fork(static_cast<std::uint64_t>(next));
    Planned event;
    event.kind = kind;
    event.number = next;
    event.flight = foresee(kind, births_->example_of(kind, next, own, 0), own.fork(0));
    event.frame = draw_time(event, own);
    plan_.push_back(std::move(event));
  }
}

void CableSynthesizer::Population::begin_plan() {
  const auto first = [this](BirthKind kind) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(frame_) * births_->rate(kind)));
  };
  next_single_ = first(BirthKind::kSingle);
  next_burst_ = first(BirthKind::kBurst);
}

/// What to try instead. Events exchange flights far more often than they get new ones, so that each example goes on
/// coming as often as it should; and it costs little.
CableSynthesizer::Population::Change CableSynthesizer::Population::draw_change(Rng rng) {
  Change change;
  change.one = rng.below(plan_.size());
  const std::size_t another = rng.below(plan_.size());
  const Planned& one = plan_[change.one];
  const std::uint64_t what = rng.below(3);  // 0: time, 1: flight, 2: both
  change.another = change.one;
  change.frame = what == 1 ? one.frame : draw_time(one, rng);
  if (what == 0) return change;
  if (plan_[another].kind == one.kind && rng.below(kExchanges + 1) > 0) {
    change.another = another;
    return change;
  }
  std::size_t example = one.flight.example;
  if (one.kind == BirthKind::kBurst) example = births_->example_of(one.kind, one.number, rng, 1);
  change.flight = foresee(one.kind, example, rng.fork(0));
  return change;
}

/// Makes the change; a second time takes it back.
void CableSynthesizer::Population::apply(Change& change, std::vector<MotionTally>& ahead) {
  Planned &one = plan_[change.one], &another = plan_[change.another];
  note(one, -1, ahead);
  if (change.another != change.one) {
    note(another, -1, ahead);
    std::swap(one.flight, another.flight);
    note(another, 1, ahead);
  }
  if (change.flight) std::swap(one.flight, *change.flight);
  std::swap(one.frame, change.frame);
  note(one, 1, ahead);
}

/// Tries changes, and keeps those that come nearer.
void CableSynthesizer::Population::improve_plan(std::vector<MotionTally>& ahead, const Rng& rng) {
  double least = cost(ahead);
  std::size_t num_births = 0;
  const std::size_t num_tries = std::min(kTries * plan_.size(), kMostTries);
  for (std::size_t k = 0; k < num_tries && num_births < kMostBirths; ++k) {
    Change change = draw_change(rng.fork(k));
    if (change.flight) num_births += change.flight->births.size();
    apply(change, ahead);
    const double now = cost(ahead);
    if (now < least)
      least = now;
    else
      apply(change, ahead);
  }
}

/// Adds sightings, so many frames from now, to the parts of the time ahead.
void CableSynthesizer::Population::note(const std::vector<Sighting>& sightings, std::int64_t from, double times,
                                        std::vector<MotionTally>& ahead) const {
  auto part = static_cast<std::size_t>(from / part_);
  std::int64_t end = (from / part_ + 1) * part_;
  for (const Sighting& sighting : sightings) {
    while (from + sighting.after >= end) {
      end += part_;
      ++part;
    }
    if (part >= num_ahead_) return;
    ahead[part].add(sighting.bins, times);
  }
}

void CableSynthesizer::Population::plan_births() {
  if (frame_ % part_ != 0) return;
  const Rng rng = rng_.fork(4).fork(static_cast<std::uint64_t>(frame_));
  if (past_.empty()) begin_plan();
  if (steers_singles_) extend_plan(BirthKind::kSingle, rng.fork(0));
  if (steers_bursts_) extend_plan(BirthKind::kBurst, rng.fork(1));
  std::vector<ElementBirth> waiting = waiting_;
  for (ElementBirth& birth : waiting) birth.frame -= frame_;
  std::vector<MotionTally> ahead(num_ahead_, MotionTally(wanted_.top_speed()));
  note(outlook(elements_, std::move(waiting)), 0, 1, ahead);
  for (MotionTally& part : ahead) part.add_frames(static_cast<double>(part_));
  for (const Planned& event : plan_) note(event, 1, ahead);
  improve_plan(ahead, rng.fork(2));
  if (past_.size() == kParts) past_.erase(past_.begin());
  past_.emplace_back(wanted_.top_speed());
  // those of this part will come so
  std::erase_if(plan_, [this](const Planned& event) {
    if (event.frame >= frame_ + part_) return false;
    for (ElementBirth birth : event.flight.births) {
      birth.frame += event.frame;
      waiting_.push_back(birth);
    }
    return true;
  });
}

}  // namespace motex
