// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/core/options.h"
#include "motex/particles/moveton_frame.h"
#include "motex/particles/textured_motion.h"

namespace motex {

using Vector3 = Eigen::Vector3d;

struct BirdFlightOptions {
  double field_of_view = 45;
  double flap_angle = 45;
  double depth_frames = 25;
  double wingspan_m = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"field_of_view", "degrees", "horizontal angle that the camera sees"}, self.field_of_view,
          Range{5, 120});
    visit(Field{"flap_angle", "degrees", "of the wings above and below the body in their outermost states"},
          self.flap_angle, Range{0, 80});
    visit(Field{"depth_frames", "frames", "over which depth, taken from the size in the picture, is smoothed"},
          self.depth_frames, Range{7, 1000});
    visit(Field{"wingspan_m", "m", "of the birds: how much a turn makes them bank"}, self.wingspan_m, Range{0.05, 10});
  }
};

/// Both wings of a bird.
struct WingPosture {
  double inner = 0;  ///< radians above the level of the body, of the half of the wing at the body
  double outer = 0;  ///< radians that the outer half is bent against the inner one; positive = up
  double fold = 0;   ///< 0 = stretched … 1 = the outer half swept back, as in the upstroke
};

/// A bird in space. World: x right, y up, the camera at the origin looking along −z; a length of 1 is its wingspan.
struct BirdPose {
  std::int64_t track = 0;
  int species = -1;
  Vector3 position{0, 0, 0};
  Vector3 forward{1, 0, 0}, up{0, 1, 0};  ///< unit, at right angles
  WingPosture wings;
};

/// A value that is drawn to its target like a critically damped spring of ω radians a frame: exact for any ω.
struct Follower {
  double value = 0, rate = 0;
  void step(double target, double omega);
};

/// Angle of the inner wing in each pose of a template, radians: poses are put in order by how high their coils lie
/// beside the core in the picture; highest = +flap_angle, lowest = −flap_angle, the others between in proportion; a
/// single pose glides.
std::vector<double> wing_angles(const MovetonTemplate& birds, double flap_angle);

/// Apparent wingspan in the picture / scale of the core: twice the reach of the farthest coil that usually is there.
double span_per_scale(const MovetonTemplate& birds);

/// Focal length in pixels: f = ½ width / tan(½ field of view).
double focal_length(int width, double field_of_view);

/// Birds in space ([TM02] Figure 6 and its future work 2) from movetons in the picture, frame by frame:
///   depth z = f · size₀ / size, size₀ = 1 the wingspan, size its apparent one: core scale × span_per_scale, without
///   what the pose changes of the scale, followed over depth_frames; x and y stay those of the picture heading along
///   the followed velocity in space, bank = atan(sideways acceleration / g) wings follow the angles of the states that
///   the template's chain went through, the outer half lags behind
/// Nothing is looked ahead, so flights may be endless.
class BirdFlock {
 public:
  /// Throws InvalidInput when an option is out of range or the model's picture has no size.
  BirdFlock(const TexturedMotion& model, const BirdFlightOptions& options = {});

  /// The birds of the next frame, farthest first.
  const std::vector<BirdPose>& advance(const MovetonFrame& frame);

  double focal() const { return focal_; }  ///< pixels of the model

 private:
  /// What one bird has come to.
  struct Flight {
    bool is_new = true;
    std::int64_t frame = 0;
    double x = 0, y = 0;
    Follower vx, vy, log_depth, wing, tip;
    Vector3 velocity{0, 0, 0};
    Vector3 forward{1, 0, 0}, up{0, 1, 0};
    double bank = 0;
  };
  /// What is known of a template.
  struct Species {
    double span = 0;
    std::vector<double> wing_angles;
    std::vector<double> log_scale_offsets;  ///< of each pose
  };
  const Species& species_of(int species) const;
  BirdPose advance_one(Flight& flight, const Moveton& moveton, const Base& core) const;
  void point_along(Flight& flight, const Vector3& velocity) const;

  BirdFlightOptions options_;
  int width_, height_;
  double focal_, gravity_;  // pixels; wingspans a frame²
  std::vector<Species> species_;
  Species unknown_;
  std::map<std::int64_t, Flight> flights_;
  std::vector<BirdPose> birds_;
};

}  // namespace motex
