// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "motex/core/job.h"
#include "motex/particles/frame_painter.h"
#include "motex/particles/moveton_frame.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// The three files that every synthesis of particles writes.
struct ParticleOutputs {
  std::filesystem::path video;   ///< movetons on the background
  std::filesystem::path tracks;  ///< their paths: NAME.tracks.csv
  std::filesystem::path layer;   ///< the movetons alone, with alpha: NAME.layer.mov (ProRes 4444)
};

/// "a/o.mp4" → a/o.tracks.csv, a/o.layer.mov; of a picture sequence "a/f_%04d.png" a/f.tracks.csv, a/f.layer.mov; of a
/// folder "a/frames" a/frames.tracks.csv, a/frames.layer.mov.
ParticleOutputs particle_outputs(const std::filesystem::path& video);

struct ParticleVideoReport {
  std::int64_t num_frames = 0;
  std::int64_t num_tracks = 0;    ///< with a point inside the picture
  double elements_per_frame = 0;  ///< inside the picture
  double bases_per_frame = 0;
  int width = 0, height = 0;
};

/// What a video of movetons is of.
struct ParticleVideoShape {
  int width = 0, height = 0;  ///< of the model's picture, pixels
  int num_base_planes = 1;    ///< coefficients that bases have
  double frames_per_sec = 25;
};

/// Draws up to num_frames of the source and writes all three files; all of them appear at the end, or none. Tracks are
/// in pixels of the model's picture, whatever the video's magnification. Throws InvalidInput, WriteError, Cancelled.
ParticleVideoReport write_particle_video(const ParticleVideoShape& shape, MovetonSource& source, FramePainter& painter,
                                         std::int64_t num_frames, const ParticleOutputs& outputs,
                                         const JobContext& job = {});

/// The background of the model, or `replacement` (opaque), in the magnified size: enlarged by cubic interpolation,
/// reduced by area means. A replacement of another shape is cut to the picture's at its middle.
Planes magnified_background(const TexturedMotion& model, double magnification, const Image* replacement = nullptr);

}  // namespace motex
