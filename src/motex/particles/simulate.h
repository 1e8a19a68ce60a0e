// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/options.h"
#include "motex/image/planes.h"
#include "motex/markov/transition_matrix.h"
#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"

/// Scenes whose truth is known, for tests, for measurements and for users who evaluate. The same options give the same
/// bytes.
namespace motex {

/// One element in one frame, inside the picture.
struct SimulatedPoint {
  std::int64_t frame = 0;
  std::int64_t track = 0;
  double x = 0, y = 0;   ///< pixels
  double scale = 1;      ///< deviation of its Gaussian (snow, sparks), of its body across its flight (birds), pixels
  double angle = 0;      ///< of its flight (birds, sparks), radians; 0: snow
  double amplitude = 0;  ///< grey levels above the background, of the luma
  int state = 0;         ///< of its wings: 0 up, 1 level, 2 down
};

struct SimulatedBurst {
  double x = 0, y = 0;
  double frame = 0;
  int num_sparks = 0;
  std::int64_t first_track = 0;  ///< its sparks are numbered from here
};

struct SimulatedScene {
  int width = 0, height = 0;
  double frames_per_sec = 25;
  std::vector<Image> frames;
  Image background;
  std::vector<SimulatedPoint> points;  ///< by rising frame, then track
  std::vector<SimulatedBurst> bursts;
  double persistence = 0;                           ///< φ of velocities
  double noise = 0;                                 ///< d of velocities, pixels a frame
  double mean_velocity_x = 0, mean_velocity_y = 0;  ///< pixels a frame: the wind
  TransitionMatrix wing_transitions;                ///< of states, birds alone
};

/// Fields that the options of all scenes have.
template <typename Self, typename Visitor>
void visit_scene_sizes(Self& self, Visitor& visit) {
  visit(Field{"width", "pixels", "of the picture"}, self.width, Range{8, 4096});
  visit(Field{"height", "pixels", "of the picture"}, self.height, Range{8, 4096});
  visit(Field{"frames", "", "length"}, self.frames, Range{1, 100000});
  visit(Field{"frames_per_sec", "1/s", "frame rate"}, self.frames_per_sec, Range{1, 1000});
}
template <typename Self, typename Visitor>
void visit_scene_noise(Self& self, Visitor& visit) {
  visit(Field{"noise", "grey levels", "deviation of a pixel"}, self.noise, Range{0, 100});
  visit(Field{"seed", "", "of everything random"}, self.seed, Range{0, 9007199254740991.0});
}

struct SimulateSnowOptions {
  int width = 320, height = 240, frames = 100;
  double frames_per_sec = 25;
  double elements = 150;
  double wind = -2, fall = 3;
  double persistence = 0.7, deviation = 0.25, spread = 0;
  double min_size = 0.9, max_size = 2.2;
  double min_amplitude = 40, max_amplitude = 110;
  double vanish = 0;
  double level = 70, texture = 12, noise = 4;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit_scene_sizes(self, visit);
    visit(Field{"elements", "", "flakes in a frame, on average"}, self.elements, Range{0, 20000});
    visit(Field{"wind", "pixels a frame", "mean velocity to the right"}, self.wind, Range{-100, 100});
    visit(Field{"fall", "pixels a frame", "mean velocity downwards"}, self.fall, Range{-100, 100});
    visit(Field{"persistence", "", "phi: share of a flake's velocity that stays to the next frame"}, self.persistence,
          Range{0, 0.99});
    visit(Field{"deviation", "pixels a frame", "noise d of the velocity in each frame"}, self.deviation, Range{0, 20});
    visit(Field{"spread", "pixels a frame", "deviation of the flakes' own mean velocities"}, self.spread, Range{0, 20});
    visit(Field{"min_size", "pixels", "smallest deviation of a flake's Gaussian"}, self.min_size, Range{0.3, 50});
    visit(Field{"max_size", "pixels", "largest"}, self.max_size, Range{0.3, 50});
    visit(Field{"min_amplitude", "grey levels", "of the faintest flake"}, self.min_amplitude, Range{-255, 255});
    visit(Field{"max_amplitude", "grey levels", "of the brightest"}, self.max_amplitude, Range{-255, 255});
    visit(Field{"vanish", "", "probability that a flake vanishes before the next frame"}, self.vanish, Range{0, 1});
    visit(Field{"level", "grey levels", "of the background"}, self.level, Range{0, 255});
    visit(Field{"texture", "grey levels", "deviation of the background's pattern"}, self.texture, Range{0, 100});
    visit_scene_noise(self, visit);
  }
};

/// Gaussian flakes before a textured background. Velocity v_t = m + φ (v_{t−1} − m) + d n with the flake's own mean
/// m ~ N((wind, fall), spread²); flakes enter as they would if the same snow fell all around the picture, so that the
/// density is even and steady.
SimulatedScene simulate_snow(const SimulateSnowOptions& options = {});

struct SimulateBirdsOptions {
  int width = 320, height = 240, frames = 150;
  double frames_per_sec = 25;
  double elements = 10;
  double group_size = 3;
  double wind = 2, rise = 0.3;
  double persistence = 0.9, deviation = 0.08, spread = 0.4;
  double min_size = 1.6, max_size = 3.2;
  double min_amplitude = 60, max_amplitude = 110;
  double stay = 0.3;
  double noise = 3;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit_scene_sizes(self, visit);
    visit(Field{"elements", "", "birds in a frame, on average"}, self.elements, Range{0, 2000});
    visit(Field{"group_size", "", "birds that fly together, on average"}, self.group_size, Range{1, 100});
    visit(Field{"wind", "pixels a frame", "mean velocity to the right"}, self.wind, Range{-100, 100});
    visit(Field{"rise", "pixels a frame", "mean velocity upwards"}, self.rise, Range{-100, 100});
    visit(Field{"persistence", "", "phi: share of a bird's velocity that stays to the next frame"}, self.persistence,
          Range{0, 0.99});
    visit(Field{"deviation", "pixels a frame", "noise d of the velocity in each frame"}, self.deviation, Range{0, 20});
    visit(Field{"spread", "pixels a frame", "deviation of the groups' mean velocities"}, self.spread, Range{0, 20});
    visit(Field{"min_size", "pixels", "smallest body, deviation across"}, self.min_size, Range{0.3, 50});
    visit(Field{"max_size", "pixels", "largest"}, self.max_size, Range{0.3, 50});
    visit(Field{"min_amplitude", "grey levels", "how much the palest bird is darker than the sky"}, self.min_amplitude,
          Range{0, 255});
    visit(Field{"max_amplitude", "grey levels", "and the darkest"}, self.max_amplitude, Range{0, 255});
    visit(Field{"stay", "", "probability that wings stay as they are to the next frame"}, self.stay, Range{0, 1});
    visit_scene_noise(self, visit);
  }
};

/// Groups of dark birds before a blue sky: a body and two wings, which are up, level or down by a Markov chain of
/// three states: up goes to level (.85 of what does not stay) or down, level to down (.6) or up, down to level (.9) or
/// up. Birds of a group share their mean velocity.
SimulatedScene simulate_birds(const SimulateBirdsOptions& options = {});

struct SimulateFireworksOptions {
  int width = 320, height = 240, frames = 150;
  double frames_per_sec = 25;
  int bursts = 5;
  double elements = 60;
  double speed = 2.2, spread = 0.5;
  double persistence = 0.965, gravity = 0.05, deviation = 0.02;
  double min_life = 28, max_life = 50;
  double min_size = 0.8, max_size = 1.3;
  double amplitude = 170;
  double noise = 3;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit_scene_sizes(self, visit);
    visit(Field{"bursts", "", "in the whole scene"}, self.bursts, Range{0, 10000});
    visit(Field{"elements", "", "sparks of a burst, on average"}, self.elements, Range{1, 5000});
    visit(Field{"speed", "pixels a frame", "of sparks at their birth, on average"}, self.speed, Range{0, 100});
    visit(Field{"spread", "pixels a frame", "deviation of that"}, self.spread, Range{0, 100});
    visit(Field{"persistence", "", "phi: share of a spark's velocity that stays to the next frame"}, self.persistence,
          Range{0, 0.99});
    visit(Field{"gravity", "pixels a frame²", "added to the velocity downwards in each frame"}, self.gravity,
          Range{-10, 10});
    visit(Field{"deviation", "pixels a frame", "noise d of the velocity in each frame"}, self.deviation, Range{0, 20});
    visit(Field{"min_life", "frames", "of a spark"}, self.min_life, Range{1, 10000});
    visit(Field{"max_life", "frames", "of a spark"}, self.max_life, Range{1, 10000});
    visit(Field{"min_size", "pixels", "smallest deviation across a spark"}, self.min_size, Range{0.3, 50});
    visit(Field{"max_size", "pixels", "largest"}, self.max_size, Range{0.3, 50});
    visit(Field{"amplitude", "grey levels", "of a spark at its birth, on average"}, self.amplitude, Range{0, 255});
    visit_scene_noise(self, visit);
  }
};

/// Bursts spread over the scene's time: sparks leave one point at one (fractional) time in all directions, slow down,
/// fall and fade; drawn as streaks as long as their way in a frame, of one colour a burst, on a dark sky.
SimulatedScene simulate_fireworks(const SimulateFireworksOptions& options = {});

/// Frames as learning takes them.
ClipFrames clip_frames_of(const SimulatedScene& scene);
/// True tracks as cables of Gaussians whose peak is the amplitude (luma in every plane). Points of no amplitude are
/// left out; a track that leaves the picture and comes back is two cables.
std::vector<Cable> true_cables(const SimulatedScene& scene);

}  // namespace motex
