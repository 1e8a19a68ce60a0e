// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/arrivals.h"
#include "motex/particles/cable_fate.h"

namespace motex {

/// What decides where and how many elements are born.
struct BirthSettings {
  double rate = 1;     ///< times as many, bursts too
  double singles = 1;  ///< besides, times as many of those that come alone
  double speed = 1;    ///< of everything, so that as many more come over the border
  double wind_x = 0, wind_y = 0;
  Plane source;             ///< places in proportion to it; empty = like the examples
  std::int64_t period = 0;  ///< births repeat after so many frames; 0 = never
};

struct ElementBirth {
  int cable = 0;        ///< it is like this one
  double x = 0, y = 0;  ///< in the picture, near the border when it enters
  bool enters = false;
  int side = 0;              ///< where: 0 left, 1 top, 2 right, 3 bottom
  bool starts_like = false;  ///< with the first velocity of the cable, otherwise with its drift
  bool is_burst = false;
  std::int64_t life = -1;       ///< frames, −1 = by the death law
  std::int64_t first_step = 0;  ///< of the cable's path
  std::int64_t frame = 0;
  Rng rng{0};  ///< its own
};

/// A birth that comes alone, or a burst.
enum class BirthKind { kSingle, kBurst };

/// Births of a frame, from the source map P_B of [TM02] in its Parzen form: a birth that was observed, moved by a
/// normal deviate of the map's bandwidth (one that enters only along the border). Wind changes what comes over each
/// border: the flux there is density × velocity, so borders to leeward give less, those to windward more, uniformly
/// along them. Bursts come as a whole, moved together.
class BirthProcess {
 public:
  BirthProcess(const TexturedMotion& model, const std::vector<CableFate>& fates,
               const std::vector<BirthExample>& examples, const std::vector<double>& burst_rates,
               const BirthSettings& settings, const Rng& rng);

  /// Appends the births of events of that frame; those of bursts may lie some frames later.
  void singles_at(std::int64_t frame, std::vector<ElementBirth>& births) const;
  void bursts_at(std::int64_t frame, std::vector<ElementBirth>& births) const;

  /// Events one by one, for those who choose among them. Event j has its time in [j, j + 1) / rate.
  double rate(BirthKind kind) const { return kind == BirthKind::kSingle ? births_per_frame_ : bursts_per_frame_; }
  /// Which example event j is like: any few in a row are as varied as the examples. nth > 0: drawn at random.
  std::size_t example_of(BirthKind kind, std::int64_t j, Rng& rng, int nth) const;
  /// Appends the births of an event.
  void add_event(BirthKind kind, std::size_t example, std::int64_t frame, Rng& rng,
                 std::vector<ElementBirth>& births) const;
  double births_per_frame() const { return births_per_frame_; }
  double bursts_per_frame() const { return bursts_per_frame_; }

 private:
  struct Item {
    BirthExample example;
    bool along_side = false;  ///< anywhere on its side
  };
  void add_wind(const BirthSettings& settings);
  ElementBirth birth_like(const Item& item, Rng& rng) const;
  void add_burst(std::int64_t frame, std::size_t which, Rng& rng, std::vector<ElementBirth>& births) const;
  void draw_place(double& x, double& y, Rng& rng) const;

  const TexturedMotion& model_;
  const std::vector<CableFate>& fates_;
  std::vector<Item> items_;
  std::vector<double> source_;  // cumulative, a pixel
  double bandwidth_;
  std::vector<double> burst_rates_;
  double births_per_frame_ = 0, bursts_per_frame_ = 0;
  Arrivals singles_, bursts_;
  WeightedDeck deck_, burst_deck_;
};

}  // namespace motex
