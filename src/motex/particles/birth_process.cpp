// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/birth_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kUsualBandwidth = 0.03;  // of the picture's longer side, where the model has none
constexpr double kNearBorder = 3;         // pixels: births painted there come from outside

/// Velocity into the picture across the side.
double inwards(int side, double vx, double vy) {
  const std::array<double, 4> speeds{vx, vy, -vx, -vy};
  return speeds[static_cast<std::size_t>(side)];
}

double length_of(const TexturedMotion& model, int side) { return side % 2 == 0 ? model.height : model.width; }

/// Reflected into [−½, size − ½).
double reflected(double x, int size) {
  const double span = 2.0 * size;
  double place = std::fmod(x + 0.5, span);
  if (place < 0) place += span;
  if (place >= size) place = span - place;
  return std::clamp(place, 0.0, size - 1e-6) - 0.5;
}

void put_on_side(const TexturedMotion& model, int side, double along, double& x, double& y) {
  x = side == 0 ? 0 : side == 2 ? model.width - 1 : along;
  y = side == 1 ? 0 : side == 3 ? model.height - 1 : along;
}

std::vector<double> cumulated(const TexturedMotion& model, const Plane& source) {
  if (source.values.empty()) return {};
  if (source.width != model.width || source.height != model.height)
    throw InvalidInput("the map of sources has " + std::to_string(source.width) + " × " +
                       std::to_string(source.height) + " pixels, the model " + std::to_string(model.width) + " × " +
                       std::to_string(model.height));
  std::vector<double> sums;
  sums.reserve(source.values.size());
  double sum = 0;
  for (const float value : source.values) {
    sum += std::max(0.0, static_cast<double>(value));
    sums.push_back(sum);
  }
  if (!(sum > 0)) throw InvalidInput("the map of sources is black all over: nothing could be born");
  return sums;
}

std::vector<double> rates_of(const auto& items) {
  std::vector<double> rates;
  for (const auto& item : items) rates.push_back(item.example.rate);
  return rates;
}

double total_of(const auto& items) {
  double sum = 0;
  for (const auto& item : items) sum += item.example.rate;
  return sum;
}

}  // namespace

BirthProcess::BirthProcess(const TexturedMotion& model, const std::vector<CableFate>& fates,
                           const std::vector<BirthExample>& examples, const std::vector<double>& burst_rates,
                           const BirthSettings& settings, const Rng& rng)
    : model_(model),
      fates_(fates),
      source_(cumulated(model, settings.source)),
      bandwidth_(model.maps.bandwidth > 0 ? model.maps.bandwidth
                                          : kUsualBandwidth * std::max(model.width, model.height)),
      burst_rates_(burst_rates),
      singles_(0, 0, rng),
      bursts_(0, 0, rng),
      deck_({}, rng),
      burst_deck_({}, rng) {
  for (const BirthExample& example : examples) items_.push_back({example, false});
  if (source_.empty() && (settings.wind_x != 0 || settings.wind_y != 0)) add_wind(settings);
  // so that any few births in a row go in all directions
  std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
    return std::atan2(a.example.vy, a.example.vx) < std::atan2(b.example.vy, b.example.vx);
  });
  births_per_frame_ = total_of(items_) * settings.rate * settings.singles * settings.speed;
  bursts_per_frame_ = std::accumulate(burst_rates.begin(), burst_rates.end(), 0.0) * settings.rate;
  singles_ = Arrivals(births_per_frame_, settings.period, rng.fork(0));
  bursts_ = Arrivals(bursts_per_frame_, settings.period, rng.fork(1));
  deck_ = WeightedDeck(rates_of(items_), rng.fork(2));
  burst_deck_ = WeightedDeck(burst_rates_, rng.fork(3));
}

void BirthProcess::add_wind(const BirthSettings& settings) {
  const double area = static_cast<double>(model_.width) * static_cast<double>(model_.height);
  double entering = 0, whole = 0;
  for (const Item& item : items_) {
    whole += item.example.rate;
    entering += item.example.enters ? item.example.rate : 0;
  }
  if (entering <= 0) return;
  const std::vector<Item> learned = items_;
  for (int side = 0; side < 4; ++side) {
    double before = 0, after = 0;
    std::vector<Item> more;
    for (const Item& item : learned) {
      const CableFate& fate = fates_[static_cast<std::size_t>(item.example.cable)];
      const double density = item.example.rate * item.example.residence / area * entering / whole;
      const double calm = density * length_of(model_, side) * std::max(0.0, inwards(side, fate.vx, fate.vy));
      const double windy = density * length_of(model_, side) *
                           std::max(0.0, inwards(side, fate.vx + settings.wind_x, fate.vy + settings.wind_y));
      before += calm;
      after += windy;
      if (windy <= calm) continue;
      more.push_back({item.example, true});
      more.back().example.enters = true;
      more.back().example.side = side;
      more.back().example.rate = windy - calm;
    }
    const double surplus = total_of(more);
    if (after > before)
      for (Item& item : more) {
        item.example.rate *= (after - before) / surplus;
        items_.push_back(item);
      }
    else if (before > 0)
      for (std::size_t k = 0; k < learned.size(); ++k)
        if (learned[k].example.enters && learned[k].example.side == side) items_[k].example.rate *= after / before;
  }
}

void BirthProcess::draw_place(double& x, double& y, Rng& rng) const {
  const double wanted = rng.uniform() * source_.back();
  const auto found = std::upper_bound(source_.begin(), source_.end(), wanted);
  const auto pixel = std::min(found, source_.end() - 1) - source_.begin();
  const std::ptrdiff_t row = pixel / model_.width, column = pixel % model_.width;
  x = static_cast<double>(column) + rng.uniform() - 0.5;
  y = static_cast<double>(row) + rng.uniform() - 0.5;
}

ElementBirth BirthProcess::birth_like(const Item& item, Rng& rng) const {
  const BirthExample& example = item.example;
  ElementBirth birth;
  birth.cable = example.cable;
  birth.enters = example.enters;
  birth.side = example.side;
  birth.life = example.life;
  birth.first_step = example.first_step;
  birth.starts_like = example.starts_like;
  if (!source_.empty()) {
    draw_place(birth.x, birth.y, rng);
    const std::array<double, 4> gaps{birth.x, birth.y, model_.width - 1 - birth.x, model_.height - 1 - birth.y};
    const auto nearest = std::min_element(gaps.begin(), gaps.end());
    birth.side = static_cast<int>(nearest - gaps.begin());
    birth.enters = *nearest < kNearBorder && inwards(birth.side, example.vx, example.vy) > 0;
    return birth;
  }
  if (item.along_side) {
    put_on_side(model_, example.side, rng.uniform() * length_of(model_, example.side) - 0.5, birth.x, birth.y);
    return birth;
  }
  const bool jitters_x = !example.enters || example.side % 2 == 1, jitters_y = !example.enters || example.side % 2 == 0;
  birth.x = reflected(example.x + (jitters_x ? bandwidth_ * rng.normal() : 0), model_.width);
  birth.y = reflected(example.y + (jitters_y ? bandwidth_ * rng.normal() : 0), model_.height);
  return birth;
}

void BirthProcess::add_burst(std::int64_t frame, std::size_t which, Rng& rng, std::vector<ElementBirth>& births) const {
  const Burst& burst = model_.maps.bursts[which];
  double x = reflected(burst.x + bandwidth_ * rng.normal(), model_.width);
  double y = reflected(burst.y + bandwidth_ * rng.normal(), model_.height);
  if (!source_.empty()) draw_place(x, y, rng);
  const auto beginning = static_cast<std::int64_t>(std::floor(burst.frame));
  std::uint64_t member = 0;
  for (const int index : burst.cables) {
    ++member;
    if (index < 0 || static_cast<std::size_t>(index) >= model_.cables.size()) continue;
    const Cable& cable = model_.cables[static_cast<std::size_t>(index)];
    const CableFate& fate = fates_[static_cast<std::size_t>(index)];
    if (cable.core.empty()) continue;
    ElementBirth birth;
    birth.cable = index;
    birth.x = cable.core[0].x + x - burst.x;
    birth.y = cable.core[0].y + y - burst.y;
    birth.starts_like = birth.is_burst = true;
    if (fate.death_seen && !fate.leaves) birth.life = cable.num_frames();
    birth.frame = frame + std::max<std::int64_t>(0, cable.first_frame - beginning);
    birth.rng = rng.fork(6 + member);
    births.push_back(birth);
  }
}

std::size_t BirthProcess::example_of(BirthKind kind, std::int64_t j, Rng& rng, int nth) const {
  const WeightedDeck& deck = kind == BirthKind::kSingle ? deck_ : burst_deck_;
  return nth == 0 ? deck.draw(j) : deck.at_share(rng.uniform());
}

void BirthProcess::add_event(BirthKind kind, std::size_t example, std::int64_t frame, Rng& rng,
                             std::vector<ElementBirth>& births) const {
  if (kind == BirthKind::kBurst) return add_burst(frame, example, rng, births);
  births.push_back(birth_like(items_[example], rng));
  births.back().frame = frame;
  births.back().rng = rng.fork(7);
}

void BirthProcess::singles_at(std::int64_t frame, std::vector<ElementBirth>& births) const {
  if (deck_.empty()) return;
  singles_.at(frame, [&](std::int64_t number, Rng& rng) {
    add_event(BirthKind::kSingle, deck_.draw(number), frame, rng, births);
  });
}

void BirthProcess::bursts_at(std::int64_t frame, std::vector<ElementBirth>& births) const {
  if (burst_deck_.empty()) return;
  bursts_.at(frame, [&](std::int64_t number, Rng& rng) {
    add_event(BirthKind::kBurst, burst_deck_.draw(number), frame, rng, births);
  });
}

}  // namespace motex
