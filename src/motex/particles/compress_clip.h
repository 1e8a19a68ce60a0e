// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/quantised_clip.h"
#include "motex/particles/textured_motion.h"

namespace motex {

struct CompressClipOptions {
  double coefficient_step = 0;
  double background_step = 0;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"coefficient_step", "grey levels",
                "coarseness of coefficients, and with them of places; auto: what "
                "costs about 0.5 dB"},
          self.coefficient_step, Range{0.01, 1e5, true});
    visit(Field{"background_step", "grey levels", "coarseness of the background; auto: what costs about 0.1 dB"},
          self.background_step, Range{0.01, 1e4, true});
  }
};

struct CompressClipReport {
  std::int64_t raw_bytes = 0;         ///< width · height · planes · frames
  std::int64_t bytes = 0;             ///< of the file, everything in it
  std::int64_t background_bytes = 0;  ///< of those
  double psnr = 0;                    ///< of what the decoder gives, over all planes, mean over the frames, dB
  double bases_per_frame = 0;         ///< that are stored
  double bits_per_base = 0;           ///< of one base in one frame, background left out

  double ratio() const { return bytes > 0 ? static_cast<double>(raw_bytes) / static_cast<double>(bytes) : 0; }
};

/// Background and cables as whole numbers, with as little precision as the error of the clip deserves, then the
/// coefficients fitted to the frames once more (joint least squares) on the places that came out. What becomes 0 or
/// lies outside the picture is dropped. The error of each number is about that of coefficient_step:
///   places 2^k ≤ √2 · step · scale / |α| pixels, scales 1/8 octave, angles π/32.
/// background_out: what the background bytes are made from. Throws InvalidInput (sizes), Cancelled.
QuantisedClip quantise_clip(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
                            const CompressClipOptions& options, const JobContext& job = {});

/// The same of a model alone, without the frames: the cables' own coefficients, and the model's noise for the error.
QuantisedClip quantise_cables(const TexturedMotion& model, const CompressClipOptions& options = {});

/// quantise_clip() and write_clip_bytes().
std::string compress_clip(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
                          const CompressClipOptions& options, const JobContext& job = {},
                          CompressClipReport* report = nullptr);

/// The frame that a decoder shows: 1 or 3 planes, grey levels, not rounded. dequantised_cables() gives `cables`.
Planes decoded_frame(const QuantisedClip& clip, const std::vector<Cable>& cables, std::int64_t frame);

/// The cables, and in every frame where they are fewer than num_bases bases (coils counted) free ones by matching
/// pursuit in what they leave: cables of one frame.
std::vector<Cable> with_free_bases(const ClipFrames& clip, const Planes& background, std::vector<Cable> cables,
                                   int num_bases, const JobContext& job = {});

}  // namespace motex
