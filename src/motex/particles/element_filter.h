// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace motex {

/// One coordinate of an element's place: v' = m + φ (v − m) + q n, p' = p + v', seen with deviation r.
struct AxisModel {
  double mean_velocity = 0;      ///< m, pixels a frame
  double start_variance = 4;     ///< of the velocity at first sight, around m
  double persistence = 0.9;      ///< φ
  double step_variance = 0.1;    ///< q²
  double noise_variance = 0.05;  ///< r²
};

/// A number that an element keeps but for a random walk: ln scale, ln amplitude.
struct LevelModel {
  double mean = 0, variance = 0;  ///< over the elements; variance 0 = the number says nothing
  double step_variance = 0;       ///< a frame
  double noise_variance = 0;      ///< of one sight
};

/// How elements move, look, come and go.
struct ElementModel {
  AxisModel x, y;
  LevelModel log_amplitude, log_scale;
  double births = 1e-4;   ///< inside the picture, a pixel and frame
  double entries = 1e-3;  ///< within a step of its edges, likewise
  double clutter = 1e-5;  ///< sights of nothing, a pixel and frame
  double seen = 0.95;     ///< probability that an element is seen in a frame after one in which it was
  double hidden = 0.5;    ///< probability that an element that is not seen is not seen in the next frame either
  double death = 0.02;    ///< probability a frame
};

/// What is seen of an element in one frame.
struct Sight {
  double x = 0, y = 0;
  double log_amplitude = 0, log_scale = 0;
  // Variances of this sight beyond those of the model; 0 = no more than those.
  double place_variance = 0;  ///< of x and y each
  double log_amplitude_variance = 0, log_scale_variance = 0;
  int frame = 0;
};

/// Kalman filter of one element: places with their velocity, and levels.
class ElementFilter {
 public:
  explicit ElementFilter(const ElementModel& model) : model_(&model) {}

  /// Takes the first sight; its velocity is around the model's mean.
  /// Returns the log-density of its levels (of its place the caller knows more).
  double start(const Sight& sight);
  /// Log-density of the next sight (of a later frame) given all before; takes it in. Sights far off count as
  /// outliers: bounded cost, little pull.
  double follow(const Sight& sight);
  /// The same filter in a later frame, having seen nothing in between.
  ElementFilter waited(int frame) const;
  /// Squared distance of the sight's place from where it is expected, in deviations.
  double distance(const Sight& sight) const;
  double expected_x(int frame) const;
  double expected_y(int frame) const;
  double variance_x(int frame) const;  ///< of a sight around expected_x
  double variance_y(int frame) const;
  int frame() const { return frame_; }

 private:
  struct Axis {
    double p = 0, v = 0, pp = 0, pv = 0, vv = 0;
  };
  struct Level {
    double value = 0, variance = 0;
  };
  static void advance(Axis& axis, const AxisModel& model, int num_frames);
  static double follow(Axis& axis, const AxisModel& model, double value, double extra_variance, double inflation);
  static double start(Level& level, const LevelModel& model, double value, double extra_variance);
  static double follow(Level& level, const LevelModel& model, double value, double extra_variance, int num_frames);

  const ElementModel* model_;
  Axis x_, y_;
  Level amplitude_, scale_;
  int frame_ = 0;
};

/// An element in one frame given its sights in all frames, and what those of the other frames alone say of its place.
struct SmoothedPlace {
  double x = 0, y = 0, vx = 0, vy = 0;
  double variance_x = 0, variance_y = 0;
  double others_x = 0, others_y = 0;
  double others_variance_x = 0, others_variance_y = 0;
};

/// In each frame from num_before frames before the first sight to num_after frames behind the last; sights in rising
/// order of frames. Rauch–Tung–Striebel smoothing; outliers count less.
std::vector<SmoothedPlace> smooth_path(const ElementModel& model, const std::vector<Sight>& sights, int num_before = 0,
                                       int num_after = 0);

}  // namespace motex
