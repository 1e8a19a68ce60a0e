// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
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
constexpr std::size_t kTries = 40;         // for each event,
constexpr std::size_t kMostBirths = 2500;  // and so many births drawn for all of them
constexpr double kTopQuantile = 0.99, kTopSpeeds = 1.25;
// differences that are near enough: what remains is left to chance
constexpr double kNearMotion = 0.03, kNearCount = 0.01;
constexpr double kCountWeight = 3, kUnevenWeight = 0.5;

double excess(double value, double near) { return std::max(0.0, std::abs(value) - near); }

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

/// What will be seen in each part from now on of elements and births alone; `from` is the first frame that is theirs.
std::vector<MotionTally> CableSynthesizer::Population::outlook(std::vector<Element> elements,
                                                               std::vector<ElementBirth> births, std::int64_t from) {
  const std::int64_t now = frame_;
  const bool drew_looks = draws_looks_;
  std::swap(elements_, elements);
  std::swap(waiting_, births);
  std::vector<MotionTally> parts(num_ahead_, MotionTally(wanted_.top_speed()));
  const std::int64_t end = now + part_ * static_cast<std::int64_t>(num_ahead_);
  for (frame_ = from; frame_ < end && !(elements_.empty() && waiting_.empty());) {
    draws_looks_ = drew_looks;  // how large they are tells where they come in
    begin_waiting();
    for (const Element& element : elements_)
      if (counts(element) && is_inside(element))
        parts[static_cast<std::size_t>((frame_ - now) / part_)].add_element(element.x.now - element.x.before,
                                                                            element.y.now - element.y.before);
    draws_looks_ = false;
    advance();
  }
  draws_looks_ = drew_looks;
  frame_ = now;
  std::swap(elements_, elements);
  std::swap(waiting_, births);
  return parts;
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
    sum += excess(apart.speed, kNearMotion) + excess(apart.direction, kNearMotion) +
           kCountWeight * excess(apart.count, kNearCount) + kUnevenWeight * unevenness(ahead, part);
  }
  return sum;
}

void CableSynthesizer::Population::foresee(Planned& event) {
  event.births.clear();
  Rng rng = event.rng;
  births_->add_event(event.kind, event.example, event.frame, rng, event.births);
  event.outlook = outlook({}, event.births, event.frame);
}

/// Anywhere in its interval that is not past.
void CableSynthesizer::Population::draw_time(Planned& event, Rng& rng) const {
  const double rate = births_->rate(event.kind), first = static_cast<double>(event.number) / rate;
  const double low = std::max(first, static_cast<double>(frame_)), high = first + 1 / rate;
  event.frame = std::max(frame_, static_cast<std::int64_t>(std::floor(rng.uniform(low, std::max(low, high)))));
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
    event.example = births_->example_of(kind, next, own, 0);
    event.rng = own.fork(0);
    draw_time(event, own);
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

/// Another event instead of one of the plan; of those that come alone two may exchange what they are like, so that each
/// example goes on coming as often as it should.
std::vector<CableSynthesizer::Population::Planned> CableSynthesizer::Population::redrawn(const Planned& one,
                                                                                         const Planned& another,
                                                                                         const Rng& rng) const {
  Rng own = rng;
  std::vector<Planned> drawn{one};
  const std::uint64_t what = own.below(3);  // 0: time, 1: example, 2: both
  if (what != 0) {
    if (one.kind == BirthKind::kBurst) {
      drawn[0].example = births_->example_of(one.kind, one.number, own, 1);
    } else if (another.kind == one.kind && another.example != one.example) {
      drawn.push_back(another);
      std::swap(drawn[0].example, drawn[1].example);
    }
  }
  if (what != 1) draw_time(drawn[0], own);
  drawn[0].rng = own;
  return drawn;
}

/// Draws events anew, and keeps what comes nearer.
void CableSynthesizer::Population::improve_plan(std::vector<MotionTally>& ahead, const Rng& rng) {
  const auto exchange = [&ahead](const Planned& out, const Planned& in) {
    for (std::size_t part = 0; part < ahead.size(); ++part) {
      ahead[part].add(out.outlook[part], -1);
      ahead[part].add(in.outlook[part]);
    }
  };
  double least = cost(ahead);
  std::size_t num_births = 0;
  for (std::size_t k = 0; k < kTries * plan_.size() && num_births < kMostBirths && least > 0; ++k) {
    Rng own = rng.fork(k);
    const std::array<std::size_t, 2> which{own.below(plan_.size()), own.below(plan_.size())};
    std::vector<Planned> drawn = redrawn(plan_[which[0]], plan_[which[1]], own);
    for (std::size_t j = 0; j < drawn.size(); ++j) {
      foresee(drawn[j]);
      num_births += drawn[j].births.size();
      exchange(plan_[which[j]], drawn[j]);
    }
    const double now = cost(ahead);
    for (std::size_t j = 0; j < drawn.size(); ++j) {
      std::swap(plan_[which[j]], drawn[j]);
      if (now < least) continue;
      exchange(plan_[which[j]], drawn[j]);
      std::swap(plan_[which[j]], drawn[j]);
    }
    least = std::min(least, now);
  }
}

void CableSynthesizer::Population::plan_births() {
  if (frame_ % part_ != 0) return;
  const Rng rng = rng_.fork(4).fork(static_cast<std::uint64_t>(frame_));
  if (past_.empty()) begin_plan();
  if (steers_singles_) extend_plan(BirthKind::kSingle, rng.fork(0));
  if (steers_bursts_) extend_plan(BirthKind::kBurst, rng.fork(1));
  std::vector<MotionTally> ahead = outlook(elements_, waiting_, frame_);
  for (MotionTally& part : ahead) part.add_frames(static_cast<double>(part_));
  for (Planned& event : plan_) {
    foresee(event);
    for (std::size_t part = 0; part < num_ahead_; ++part) ahead[part].add(event.outlook[part]);
  }
  improve_plan(ahead, rng.fork(2));
  if (past_.size() == kParts) past_.erase(past_.begin());
  past_.emplace_back(wanted_.top_speed());
  // those of this part will come so
  std::erase_if(plan_, [this](const Planned& event) {
    if (event.frame >= frame_ + part_) return false;
    waiting_.insert(waiting_.end(), event.births.begin(), event.births.end());
    return true;
  });
}

}  // namespace motex
