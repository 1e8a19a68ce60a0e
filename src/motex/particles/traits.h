// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "motex/particles/textured_motion.h"

namespace motex {

/// What kind of motion a clip shows, in numbers that its size, contrast, density and length do not change: of clips of
/// one kind they are alike, although a likelihood in pixels and grey levels knows only the clip that it was learned
/// from. Positive quantities as logarithms, shares as logits, so that one is a plain difference of any of them.
enum class Trait : std::size_t {
  kLife,          ///< ln frames between being born and dying inside the picture
  kBornInside,    ///< logit of births that are not entries over the border
  kSpeed,         ///< ln of core scales a frame (root mean square)
  kCoherence,     ///< logit of |mean velocity|² over mean velocity²: all the same way, or any
  kSteadiness,    ///< logit of the part of velocity² that stays over a life: straight and even, or not
  kFalling,       ///< mean velocity downwards over the root mean square, two = 1
  kAcceleration,  ///< gain of velocity downwards in a life, over the root mean square
  kFading,        ///< mean of ln brightness at the end over that at the beginning of a life
  kFlicker,       ///< ln of the root mean square of changes of ln brightness from frame to frame
  kDark,          ///< logit of elements darker than what is behind them
  kBursts,        ///< ln variance over mean of the number of births a frame
  kContrast,      ///< ln of the mean ratio of an element's brightness to that of what is behind it
  kCount
};

struct ClipTraits {
  std::array<double, static_cast<std::size_t>(Trait::kCount)> values{};
  double operator[](Trait trait) const { return values[static_cast<std::size_t>(trait)]; }
};

/// In words, for tables.
const char* name_of(Trait trait);

/// Of the cables of a clip or of a model. Throws InvalidInput when there are none.
ClipTraits traits_of(const TexturedMotion& clip);

/// Σ w (difference)² / 2. w: how well a trait tells kinds apart, which is the deviation between kinds over that within
/// them, over the variance within: 5 for the dark share (flakes and sparks are bright, birds dark, water is both), 2.5
/// for contrast (sparks shine by themselves), 0.5 for speed. Of 19 clips of four kinds, rounded.
double trait_distance(const ClipTraits& a, const ClipTraits& b);

}  // namespace motex
