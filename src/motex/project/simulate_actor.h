// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motex/core/options.h"
#include "motex/image/image.h"
#include "motex/people/puppet.h"
#include "motex/people/puppet_stage.h"
#include "motex/project/actor_body.h"

namespace motex {

struct SimulateActorOptions {
  int frames = 1800;
  int width = 720, height = 480;
  double frames_per_sec = 30;
  std::string actions;  ///< names with commas between; empty = all of actor_actions()
  int repetitions = 0;  ///< of each; 0 = as many as there is time for
  int persons = 1;
  ScreenColour screen = ScreenColour::kGreen;
  double unevenness = 0.25, shadow = 0.15, spill = 0.15, noise = 2, motion_blur = 0;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"frames", "", "length"}, self.frames, Range{1, 1e6});
    visit(Field{"width", "pixels", "of the picture"}, self.width, Range{32, 4096});
    visit(Field{"height", "pixels", "of the picture"}, self.height, Range{32, 4096});
    visit(Field{"frames_per_sec", "1/s", "frame rate"}, self.frames_per_sec, Range{5, 240});
    visit(Field{"actions", "",
                "what is performed, names with commas between; empty = all: steps, turn, arms, "
                "left_kick, right_kick, bow"},
          self.actions, Range{});
    visit(Field{"repetitions", "", "of each action; auto = as many as there is time for"}, self.repetitions,
          Range{1, 10000, true});
    visit(Field{"persons", "", "beside one another, each performing on its own"}, self.persons, Range{1, 8});
    visit(Field{"screen", "", "colour behind them"}, self.screen, Choices{{"green", "blue", "plain"}});
    visit(Field{"unevenness", "", "share of the screen's light that is missing at the edges"}, self.unevenness,
          Range{0, 0.5});
    visit(Field{"shadow", "", "share of light that is missing on the floor about the feet"}, self.shadow,
          Range{0, 0.8});
    visit(Field{"spill", "", "share of the screen's colour on the edges of a body"}, self.spill, Range{0, 0.6});
    visit(Field{"noise", "grey levels", "deviation of every channel"}, self.noise, Range{0, 30});
    visit(Field{"motion_blur", "frames", "time for which the shutter is open"}, self.motion_blur, Range{0, 1});
    visit(Field{"seed", "", "of everything random"}, self.seed, Range{0, 9007199254740991.0});
  }
};

/// One time that an action is performed.
struct ActorPerformance {
  int start = 0, length = 0;  ///< frames
  int action = 0;             ///< of actor_actions()
  int person = 0;             ///< from the left
  double amplitude = 1;
};

/// Footage of an actor before a screen whose every matte, action and repetition is known: figures drawn as puppets
/// and moved by motion capture (ActorBody). Each repetition is up to 5 % slower or faster, up to 10 % larger or
/// smaller; between two the actor stands, breathing and swaying. The same options give the same pictures.
class ActorSimulation {
 public:
  /// Throws InvalidInput: an action that does not exist, repetitions that do not fit.
  explicit ActorSimulation(const SimulateActorOptions& options);

  const SimulateActorOptions& options() const { return options_; }
  /// By rising start, then person.
  const std::vector<ActorPerformance>& performances() const { return performances_; }
  /// The empty screen, without noise.
  const Image& screen() const { return stage_.screen(); }

  struct Frame {
    Image image;  ///< as filmed
    Image matte;  ///< grey: alpha of all persons together
  };
  /// Thread-safe.
  Frame frame(int number) const;
  /// One person as filmed (with spill), cut out by its true alpha. Thread-safe.
  Sprite sprite(int number, int person) const;
  /// As the camera sees it at a time between frames too. Thread-safe.
  PuppetPose pose(double number, int person) const;

 private:
  struct Person {
    double x = 0, yaw = 0, pixels_per_metre = 150, phase = 0;
    PuppetLook look;
    std::vector<ActorPerformance> performances;
  };
  void schedule(const std::vector<int>& actions, int person);
  PuppetPoint seen(const Person& person, const Vector3& place) const;

  SimulateActorOptions options_;
  PuppetStage stage_;
  ActorBody body_;
  std::vector<Person> persons_;
  std::vector<ActorPerformance> performances_;
  struct JointColumns {
    int first, second;  // the middle of both
    double weight;
  };
  std::vector<JointColumns> columns_;
};

}  // namespace motex
