// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "motex/lds/bridge.h"
#include "motex/motion_texture/model.h"
#include "motex/motion_texture/play_options.h"

namespace motex {

/// Consecutive rows of the corpus to be played between any two pairs of poses in any number of frames.
struct Piece {
  int texton = 0;
  Index source_row = 0, source_length = 0;
  Index first_row = 0;  ///< corpus rows first_row, first_row + 1: the first two frames
  Index last_row = 0;   ///< corpus rows last_row, last_row + 1: the last two frames
  Index length = 0;     ///< frames
};

/// Features of one texton between key poses [MT02 5.4, Figure 5].
///
/// replay: y(t) = y_source(t) + C e(t) + o(t). The deviation e follows the texton's dynamics from 0 to the difference
/// of the end poses, driven by fresh noise alone: the source's own residuals are in y_source. o carries what of that
/// difference lies outside the subspace, over the last third of a second. It is the constrained synthesis with the
/// source's residuals as noise, written around the source. white: y(t) = μ + C x(t) + o(t) with x the constrained
/// synthesis of white noise, as in the paper; o at both ends.
class SegmentSynthesis {
 public:
  SegmentSynthesis(const MotionTexture& model, const PlayOptions& options);

  /// Frames of `instance` up to and with the key poses of `next` (−1: up to its own last frames): length × D.
  /// The two first and the two last rows are key poses exactly.
  const FrameMatrix& play(int instance, int next);

  /// The same between other poses, in another number of frames. The source is played as fast as it was at both ends,
  /// and faster or slower between them. Fewer than 4 frames are the source itself.
  const FrameMatrix& play(const Piece& piece);
  /// The same between any poses, 2 × D weighted features each; first_row and last_row are not used. Throws InvalidInput
  /// unless they have that size and are finite.
  const FrameMatrix& play(const Piece& piece, const FrameMatrix& first, const FrameMatrix& last);

 private:
  Bridge& bridge(int texton);
  void draw_noise(Index rows, Index cols, double strength);
  void blend(Index first_row, const Vector& value, const Vector& slope, bool at_end);

  const MotionTexture& model_;
  NoiseSource source_;
  double noise_;
  Rng rng_;
  Index blend_frames_;
  std::vector<std::unique_ptr<Bridge>> bridges_;
  FrameMatrix out_, states_, noise_rows_;
};

}  // namespace motex
