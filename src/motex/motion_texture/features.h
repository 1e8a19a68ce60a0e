// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"
#include "motex/motion/root_path.h"

namespace motex {

/// Frame times that can be learned from; what a model needs in memory goes by them.
constexpr double kLeastFrameTimeSecs = 1e-4, kMostFrameTimeSecs = 1e4;

/// Channels of a frame, each multiplied by its weight, all then in centimetres of body movement:
///
///   0, 1   v_x, v_z   horizontal step from the previous frame, in its heading frame
///   2      height     of the travelling joint above reference_height
///   3      Δψ         turn of the heading since the previous frame
///   4, 5   t_x, t_z   tilt: q = R_y(ψ) · exp(t_x, 0, t_z), ψ = 2 atan2(q_y, q_w)
///   6 …    3 a joint  log(q_ref⁻¹ q), continued along the clip up to 270°
///
/// Encoding then decoding a clip gives it back (translations that were held apart). D = 6 + 3 · moving joints.
struct FeatureSpace {
  Skeleton skeleton;
  double frame_time_secs = 1.0 / 60;
  double cm_per_unit = 1;
  double reference_height = 0;  ///< units: heights keep their digits as floats only if they are small
  int travelling_joint = 0;
  std::vector<int> joints;  ///< joints of channels 6 …, in order
  FrameMatrix references;  ///< joints of the skeleton × 4: q_ref, w x y z; the held rotation of those without channels
  FrameMatrix held;        ///< joints of the skeleton × 3: translation where none is a channel
  Vector weights;          ///< D

  Index size() const { return weights.size(); }
};

/// Chooses the travelling joint, references and weights [docs/papers/motion-texture.md] for clips of one skeleton and
/// rate.
FeatureSpace make_feature_space(std::span<const Clip> clips, const JobContext& job = {});

/// Weighted features, frames × D. Throws InvalidInput when the clip's skeleton or rate is not the space's, or it has
/// fewer than 2 frames.
FrameMatrix encode(const FeatureSpace& space, const Clip& clip, const JobContext& job = {});

/// Where the travelling joint stands and looks; heading ψ in radians.
struct RootPlace {
  double x = 0, z = 0, heading = 0;
};
/// Of the clip's first frame.
RootPlace root_place(const FeatureSpace& space, const Clip& clip, Index frame);

/// Writes one frame of features (D) as a pose of `out` and moves `place` on. With `first` the place is kept as it is.
void decode_frame(const FeatureSpace& space, const double* features, bool first, RootPlace& place, Clip& out,
                  Index frame);

/// A clip of frames in which everything is held at its mean: what decode_frame() writes into.
Clip make_held_clip(const FeatureSpace& space, Index num_frames);

/// All frames; the first stands at `start`.
Clip decode(const FeatureSpace& space, const FrameMatrix& features, RootPlace start = {});

/// The way of features (frames × D) whose first frame stands at `start`, and back: steps and turns of a path.
RootPath root_path(const FeatureSpace& space, const FrameMatrix& features, RootPlace start);
void set_root_path(const FeatureSpace& space, const RootPath& path, FrameMatrix& features);

}  // namespace motex
