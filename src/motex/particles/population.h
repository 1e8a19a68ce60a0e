// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "motex/core/job.h"
#include "motex/particles/birth_process.h"
#include "motex/particles/element.h"
#include "motex/particles/motion_tally.h"
#include "motex/particles/synthesize.h"

namespace motex {

/// The elements that are alive in a frame of a synthesis, and how they become those of the next.
class CableSynthesizer::Population {
 public:
  Population(const TexturedMotion& model, const SynthesizeParticlesOptions& options, std::int64_t loop_frames);

  /// Lives through as many frames before frame 0 as it takes until nobody remembers the first ones; births are then as
  /// many as keep the population as large as learned.
  void settle(const JobContext& job);
  void draw(MovetonFrame& frame);
  void advance();
  void insert(const InsertedElement& inserted);
  /// Cables that it may be like.
  std::vector<int> examples_for(const InsertedElement& inserted) const;
  const SynthesizeParticlesReport& report() const { return report_; }

 private:
  /// Coordinates of a cable other than places.
  struct Series {
    std::vector<double> log_scale, angle, amplitude;
  };
  const Series& series_of(int cable);

  void start_at(std::int64_t frame, const BirthSettings& settings, const MotionEdit& motion);
  void warm_up(const BirthSettings& settings, const MotionEdit& motion, const JobContext& job);
  double calibrated_rate(const JobContext& job);
  BirthSettings settings() const;
  MotionEdit edited_motion() const;
  bool has_painted_deaths() const { return !options_.sink_map.values.empty() || !options_.hazard_map.values.empty(); }

  /// Births of a frame that is going to be seen.
  void begin_frame();
  void be_born(std::vector<ElementBirth>& births);
  void begin_waiting();

  /// An element as it is seen so many frames from a certain one on.
  struct Sighting {
    std::int32_t after = 0;
    MotionTally::Bins bins;
  };
  /// What an event is like, and what will be seen of it, whenever it comes.
  struct Flight {
    std::size_t example = 0;
    std::vector<ElementBirth> births;  ///< frames counted from the event's
    std::vector<Sighting> sightings;
  };
  /// An event that is to come.
  struct Planned {
    BirthKind kind = BirthKind::kSingle;
    std::int64_t number = 0, frame = 0;
    Flight flight;
  };
  /// What the plan could have instead: another time of an event, the flight of another one, or a new flight.
  struct Change {
    std::size_t one = 0, another = 0;
    std::int64_t frame = 0;
    std::optional<Flight> flight;
  };
  void choose_steering();
  void learn_tally();
  void plan_births();
  void begin_plan();
  void extend_plan(BirthKind kind, const Rng& rng);
  Change draw_change(Rng rng);
  void apply(Change& change, std::vector<MotionTally>& ahead);
  void improve_plan(std::vector<MotionTally>& ahead, const Rng& rng);
  std::int64_t draw_time(const Planned& event, Rng& rng) const;
  void note(const std::vector<Sighting>& sightings, std::int64_t from, double times,
            std::vector<MotionTally>& ahead) const;
  void note(const Planned& event, double times, std::vector<MotionTally>& ahead) const {
    note(event.flight.sightings, event.frame - frame_, times, ahead);
  }
  void shift_path(ElementBirth& birth, Rng& rng) const;
  Flight foresee(BirthKind kind, std::size_t example, Rng rng);
  std::vector<Sighting> outlook(std::vector<Element> elements, std::vector<ElementBirth> births);
  double unevenness(const std::vector<MotionTally>& ahead, std::size_t last) const;
  double cost(const std::vector<MotionTally>& ahead) const;
  bool counts(const Element& element) const { return steers_singles_ || element.is_burst; }
  void tally(MotionTally& into) const;
  void add(const ElementBirth& birth);
  void start_motion(Element& element, const ElementBirth& birth);
  void start_path(Element& element, const ElementBirth& birth);
  void start_looks(Element& element, int cable);
  void back_out(Element& element, int side);
  void choose_looks(Element& element, int cable, int species);
  int presentable(int cable, Rng& rng) const;
  std::size_t law_idx(int species) const;
  void learn_noise();
  void choose_paths();
  bool samples_looks() const;
  void move(Element& element);
  /// Whether it is still there.
  bool survives(Element& element);
  bool is_outside(double x, double y, double margin) const;
  bool is_inside(const Element& element) const;
  bool is_in_sight(const Element& element) const;
  double learned_per_frame(bool with_bursts) const;

  const TexturedMotion& model_;
  SynthesizeParticlesOptions options_;
  const TexturedMotion& looks_model_;
  std::int64_t loop_frames_;
  Rng rng_;
  std::vector<CableFate> fates_;
  DeathLaw deaths_;
  std::vector<BirthExample> examples_;
  std::vector<double> burst_rates_;
  std::vector<MovetonDynamics> laws_;           // one a species, the last for free bases
  std::vector<NoiseSpread> noise_x_, noise_y_;  // one a law
  std::vector<int> looks_cables_;               // whose bases may be replayed where the looks are not the cable's own
  std::vector<char> has_stray_light_;           // of looks_model_: cables that are not replayed
  std::map<int, Series> series_;
  MotionEdit motion_;
  bool draws_looks_ = true;
  std::int64_t longest_life_ = 0;                        // 0 = any
  bool steers_singles_ = false, steers_bursts_ = false;  // births are chosen among many
  std::int64_t part_ = 1;                                // frames between choices
  std::size_t num_ahead_ = 0;                            // parts that are planned
  MotionTally wanted_;
  std::vector<double> wanted_parts_;  // elements in each part of the clip, fewest first
  std::vector<MotionTally> past_;     // parts before now, the last may go on
  std::vector<Planned> plan_;
  std::int64_t next_single_ = 0, next_burst_ = 0;

  std::optional<BirthProcess> births_;
  std::vector<Element> elements_;
  std::vector<ElementBirth> new_births_, waiting_;  // waiting: bursts that go on
  std::int64_t frame_ = 0, next_track_ = 0;
  SynthesizeParticlesReport report_;
};

}  // namespace motex
