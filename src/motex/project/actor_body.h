// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion/clip.h"

namespace motex {

/// Names of the actions that a simulated actor can perform: "steps", "turn", "arms" (motion capture), "left_kick",
/// "right_kick", "bow" (joints of the standing figure turned).
const std::vector<std::string>& actor_actions();

/// The body of a simulated actor over time: it stands as it was captured, breathing and swaying, and performs actions.
/// Lengths in metres, Y up; standing it looks along +Z from (0, ·, 0), the floor is y = 0.
class ActorBody {
 public:
  ActorBody();

  /// Of an action as it was performed, seconds.
  double duration_secs(int action) const;

  /// One moment: `idle_secs` runs all the time and says how it stands; action −1 = none, else how far it is through it
  /// (0 … 1, at both ends it stands) and how large it is performed (1 = as captured).
  struct Moment {
    double idle_secs = 0, idle_phase = 0;
    int action = -1;
    double share = 0, amplitude = 1;
  };
  /// 3 × (joints + end sites) of skeleton(), metres. Thread-safe.
  Eigen::Matrix<double, 3, Eigen::Dynamic> positions(const Moment& moment) const;

  const Skeleton& skeleton() const { return clip_.skeleton; }
  /// Column of positions() for a joint's name, or for the tip beyond it. Throws InvalidInput.
  int column(const std::string& joint) const;
  int tip_column(const std::string& joint) const;

 private:
  /// Root: heading about Y, place and tilt apart.
  struct Stance {
    double heading = 0;
    Vector3 root = Vector3::Zero();
    std::vector<Quat> rotations;  // of the root: the tilt
  };
  Stance captured(double frame) const;
  Stance idle(const Moment& moment) const;
  void perform_capture(const Moment& moment, Stance& stance) const;
  void perform_turned_joints(const Moment& moment, Stance& stance) const;
  void turn(Stance& stance, const char* joint, const Vector3& rotation_vector) const;
  Eigen::Matrix<double, 3, Eigen::Dynamic> place(const Stance& stance) const;

  Clip clip_;
  std::vector<double> headings_;  // of every frame, without jumps of 360°, 0 while standing
};

}  // namespace motex
