// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/image/planes.h"
#include "motex/particles/element.h"
#include "motex/particles/moveton_frame.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// Where the bases of a synthesized element come from.
enum class ParticleAppearance {
  kReplay,    ///< core and coils of a learned cable, at new places
  kTemplates  ///< a moveton drawn from its template
};

struct SynthesizeParticlesOptions {
  std::uint64_t seed = 1;
  ParticleAppearance appearance = ParticleAppearance::kReplay;
  double rate = 1;
  double gravity = 0;
  double speed = 1;
  bool uniform = false;
  bool loop = false;

  double wind_x = 0, wind_y = 0;             ///< added to the mean velocity, pixels a frame
  Plane source_map;                          ///< births in proportion to it, of the picture's size; empty = as learned
  Plane sink_map;                            ///< deaths likewise
  Plane hazard_map;                          ///< probability to die before the next frame, instead of a sink map
  const TexturedMotion* looks_of = nullptr;  ///< appearance of another model; must outlive the synthesis
  int looks_of_species = -1;                 ///< of that template only; −1 = each its own

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"seed", "", "random numbers; the same seed gives the same bytes"}, self.seed, Range{0, 1.8e19});
    visit(Field{"appearance", "",
                "replay: learned elements look again as they did, on new paths; templates: looks are drawn, too"},
          self.appearance, Choices{{"replay", "templates"}});
    visit(Field{"rate", "", "births, times as many as learned"}, self.rate, Range{0, 1000});
    visit(Field{"gravity", "pixels/frame²", "pulls downwards, besides what was learned"}, self.gravity,
          Range{-100, 100});
    visit(Field{"speed", "", "movement, times as fast as learned"}, self.speed, Range{0.01, 100});
    visit(Field{"uniform", "", "births anywhere in the picture alike"}, self.uniform, Range{});
    visit(Field{"loop", "", "the first frame follows the last"}, self.loop, Range{});
  }
};

struct SynthesizeParticlesReport {
  double births_per_frame = 0;  ///< in the mean, those of bursts left out
  double bursts_per_frame = 0;
  double learned_per_frame = 0;  ///< elements in the picture, in the clip learned from
  bool deaths_by_age = false;    ///< inside the picture; otherwise by place
  std::int64_t warm_up_frames = 0;
};

/// An element put in by hand.
struct InsertedElement {
  std::int64_t track = 0;
  double x = 0, y = 0;    ///< pixels
  double vx = 0, vy = 0;  ///< its velocity in the mean, pixels a frame
  int species = -1;       ///< whose looks and dynamics it has; −1 = any
};

/// Endless new movetons by a learned model ([TM02] section 3), frame by frame in constant memory:
/// births    like those of the clip, their places under the Parzen window; from outside where the learned ones came
/// from
///           outside; bursts as a whole, moved; or from a map
/// motion    the second-order dynamics of the species; c_i from the posterior of the cable that the birth is like
/// deaths    by leaving the picture, and inside by the death law (cable_fate.h); bursts live as long as learned
/// The population is steady from the first frame on, and as large as the clip's. The same seed gives the same frames;
/// track numbers rise from 0 in the order in which elements come into sight.
class CableSynthesizer : public MovetonSource {
 public:
  /// The model must outlive it. loop_frames: with options.loop frames repeat after so many; else not used. Throws
  /// InvalidInput: options out of range, no cables, a map of another size or black all over, no templates where they
  /// are needed.
  CableSynthesizer(const TexturedMotion& model, const SynthesizeParticlesOptions& options, std::int64_t loop_frames = 0,
                   const JobContext& job = {});
  ~CableSynthesizer() override;
  /// Always true.
  bool next_frame(MovetonFrame& frame) override;

  /// It is there from the next frame on, and lives by the same dynamics and laws as others. Throws InvalidInput for a
  /// species that the model has not.
  void insert(const InsertedElement& element);
  /// Throws what insert() would.
  void check(const InsertedElement& element) const;

  const SynthesizeParticlesReport& report() const;

 private:
  class Population;
  std::unique_ptr<Population> population_;
};

/// num_frames of it at once, as cables (those in sight, numbered as the tracks).
std::vector<Cable> synthesize_cables(const TexturedMotion& model, const SynthesizeParticlesOptions& options,
                                     std::int64_t num_frames, const JobContext& job = {},
                                     SynthesizeParticlesReport* report = nullptr);
/// The frames of a source as cables; at most num_frames.
std::vector<Cable> collect_cables(MovetonSource& source, std::int64_t num_frames, const JobContext& job = {});

}  // namespace motex
