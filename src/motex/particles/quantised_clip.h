// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/image/planes.h"
#include "motex/particles/cable.h"

namespace motex {

constexpr int kScaleLevels = 8;   ///< of ln scale, an octave
constexpr int kAngleLevels = 32;  ///< in π
constexpr int kFinestPlace = -4;  ///< 2⁻⁴ pixel
constexpr int kCoarsestPlace = 3;

/// The state of a base as whole numbers.
struct QuantisedState {
  std::int32_t x = 0, y = 0;  ///< in 2^precision pixels
  std::int32_t scale = 0;     ///< kScaleLevels · log₂(scale)
  std::int32_t angle = 0;     ///< π / kAngleLevels
  std::int32_t luma = 0;      ///< coefficient of Y / coefficient_step
  std::int32_t blue = 0;      ///< of B − Y / (1.5 coefficient_step); 0 in grey clips
  std::int32_t red = 0;       ///< of R − Y, likewise
  friend bool operator==(const QuantisedState&, const QuantisedState&) = default;
};

/// One base followed over frames.
struct QuantisedPath {
  BaseKind kind = BaseKind::kGaussian;
  std::int32_t precision = 0;  ///< places are multiples of 2^precision pixels
  std::vector<QuantisedState> states;
  friend bool operator==(const QuantisedPath&, const QuantisedPath&) = default;
};

struct QuantisedCable {
  std::int64_t first_frame = 0;
  QuantisedPath core;
  std::vector<QuantisedPath> coils;  ///< each as long as the core
  friend bool operator==(const QuantisedCable&, const QuantisedCable&) = default;
};

/// A clip as background and cables of whole numbers: what is stored, and all that a decoder knows.
struct QuantisedClip {
  int width = 0, height = 0;
  int num_planes = 1;
  std::int64_t num_frames = 0;
  float frames_per_sec = 25;
  float coefficient_step = 1;  ///< grey levels · pixels
  float background_step = 1;   ///< grey levels, of cosine coefficients
  Planes background;           ///< as it comes out of the decoder
  std::vector<QuantisedCable> cables;
};

/// The base that a state stands for.
Base dequantised(const QuantisedClip& clip, const QuantisedPath& path, const QuantisedState& state);
/// All cables, species −1.
std::vector<Cable> dequantised_cables(const QuantisedClip& clip);

/// The order in which a file has them: by first frame, then by blocks of kPlaceBlock pixels row by row, then the rest.
constexpr int kPlaceBlock = 8;
void sort_for_coding(QuantisedClip& clip);
/// Block that the core is born in: its place cut to the picture.
std::int32_t birth_block(const QuantisedClip& clip, const QuantisedPath& path);

}  // namespace motex
