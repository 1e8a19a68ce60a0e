// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/particles/population.h"

/// Which of many futures comes: the one in which most is as in the clip. Where a clip has twenty elements, chance would
/// make any run of its length differ from it by far more than a viewer takes for the same scene.
namespace motex {
namespace {

constexpr int kFutures = 32;
constexpr std::int64_t kSteps = 8;   // part of the clip's length: a future is kept for so long,
constexpr std::int64_t kSights = 2;  // and judged by what it brings in so much of it
constexpr double kTopQuantile = 0.99, kTopSpeeds = 1.25;

}  // namespace

void CableSynthesizer::Population::learn_tally() {
  std::vector<double> speeds;
  const auto for_each_step = [this](auto&& take) {
    for (const Cable& cable : model_.cables)
      for (std::size_t t = 1; t < cable.core.size(); ++t)
        if (!is_outside(cable.core[t].x, cable.core[t].y, 0))
          take(cable.core[t].x - cable.core[t - 1].x, cable.core[t].y - cable.core[t - 1].y);
  };
  for_each_step([&](double vx, double vy) { speeds.push_back(std::hypot(vx, vy)); });
  if (speeds.empty()) return;
  const auto top = speeds.begin() + static_cast<std::ptrdiff_t>(kTopQuantile * static_cast<double>(speeds.size()));
  std::nth_element(speeds.begin(), top, speeds.end());
  wanted_ = past_ = MotionTally(kTopSpeeds * std::max(0.1, *top));
  for_each_step([this](double vx, double vy) { wanted_.add_element(vx, vy); });
  // first steps are not among those, so that the number of elements is set apart
  wanted_.add_frames(static_cast<double>(speeds.size()) / std::max(1e-9, learned_per_frame(true)));
}

bool CableSynthesizer::Population::is_steered() const {
  const bool is_edited = options_.wind_x != 0 || options_.wind_y != 0 || options_.gravity != 0 || options_.speed != 1 ||
                         options_.rate != 1 || options_.uniform || !options_.source_map.values.empty() ||
                         has_painted_deaths() || loop_frames_ > 0;
  return are_few(fates_) && !is_edited && learned_per_frame(false) > 0;
}

void CableSynthesizer::Population::tally(MotionTally& into) const {
  for (const Element& element : elements_)
    if (is_inside(element)) into.add_element(element.x.now - element.x.before, element.y.now - element.y.before);
  into.add_frames(1);
}

void CableSynthesizer::Population::choose_future() {
  const std::int64_t step = std::max<std::int64_t>(1, model_.num_frames / kSteps);
  if (frame_ % step != 0) return;
  const std::vector<Element> elements = elements_;
  const std::vector<ElementBirth> waiting = waiting_;
  const std::int64_t now = frame_;
  const bool drew_looks = draws_looks_;
  draws_looks_ = false;
  const Rng futures = rng_.fork(4).fork(static_cast<std::uint64_t>(now));
  double nearest = std::numeric_limits<double>::infinity();
  std::uint64_t best = 0;
  for (std::uint64_t future = 0; future < kFutures; ++future) {
    births_->begin_anew(futures.fork(future));
    MotionTally seen = past_;
    for (std::int64_t t = 0; t < model_.num_frames / kSights; ++t, advance()) {
      be_born(new_births_);
      tally(seen);
    }
    const double distance = seen.distance(wanted_);
    if (distance < nearest) {
      nearest = distance;
      best = future;
    }
    elements_ = elements;
    waiting_ = waiting;
    frame_ = now;
  }
  births_->begin_anew(futures.fork(best));
  draws_looks_ = drew_looks;
}

/// What was seen counts less and less: half after half a clip.
void CableSynthesizer::Population::remember() {
  past_.fade(std::exp2(-2.0 / static_cast<double>(model_.num_frames)));
  tally(past_);
}

}  // namespace motex
