// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "motex/particles/textured_motion.h"

namespace motex {

/// What synthesis needs and no more: background, templates, dynamics, maps, rates; no cables, no lists of births and
/// deaths. Pictures as quantised cosine coefficients (plane_codec.h; the background to about the model's noise, maps to
/// half a per cent of their peaks), the rest as an adaptive code of the model file's bytes, each in the context of the
/// one before it.
std::string generative_model_bytes(const TexturedMotion& model);
/// Safe for bytes from strangers. Throws ParseError, InvalidInput.
TexturedMotion parse_generative_model(const std::string& bytes, const std::string& name);

/// Sizes of a clip and of what stands for it, everything counted.
struct CompressionSummary {
  std::int64_t raw_bytes = 0;    ///< width · height · planes · frames
  std::int64_t clip_bytes = 0;   ///< background and every element in every frame, entropy coded (clip_codec.h)
  std::int64_t model_bytes = 0;  ///< the generative model alone

  double clip_ratio() const {
    return clip_bytes > 0 ? static_cast<double>(raw_bytes) / static_cast<double>(clip_bytes) : 0;
  }
  double model_ratio() const {
    return model_bytes > 0 ? static_cast<double>(raw_bytes) / static_cast<double>(model_bytes) : 0;
  }
};
/// Throws InvalidInput when the model has no background or no frames.
CompressionSummary measure_compression(const TexturedMotion& model);

}  // namespace motex
