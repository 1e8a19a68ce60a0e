// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/particles/frame_painter.h"
#include "motex/particles/star.h"
#include "motex/particles/textured_motion.h"
#include "motex/particles/water_replay.h"

namespace motex {

/// Endless water of a learned model as movetons (the carried bases, born again jointly: water_replay.h).
class WaterSource : public MovetonSource {
 public:
  /// The model must outlive it. loop_frames > 0: frames repeat after so many, the last of them blending into the
  /// first. Throws InvalidInput: a model without water, options out of range, a loop of fewer than 2 frames.
  WaterSource(const TexturedMotion& model, const WaterReplayOptions& options, std::uint64_t seed,
              std::int64_t loop_frames = 0);
  /// Always true.
  bool next_frame(MovetonFrame& frame) override;

 private:
  void record_loop(std::int64_t num_frames);
  WaterReplay replay_;
  std::vector<MovetonFrame> loop_;
  std::int64_t num_shown_ = 0;
};

/// Movetons and, over them, the light that bases miss: I = background + Σ α_j b_j + mean + deviation · z, z by the
/// autoregression of the model ([TM02] eq. 1); its mean takes away what the bases add to the background in the mean.
/// Frames must come in order. At other resolutions the light is
/// interpolated.
class WaterPainter : public FramePainter {
 public:
  /// background: of the magnified size. Throws InvalidInput when the model is not one of water.
  WaterPainter(const TexturedMotion& model, Planes background, double magnification, std::uint64_t seed);
  void paint(const MovetonFrame& frame, Image& picture, Image& layer) override;

 private:
  Planes background_, sum_;
  Image background_image_;
  BaseRenderer renderer_;
  StarSampler light_;
};

}  // namespace motex
