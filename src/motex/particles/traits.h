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

/// Σ (difference)² / 2: −ln of how probable one is given the other, each trait normal with a deviation of one.
double trait_distance(const ClipTraits& a, const ClipTraits& b);

}  // namespace motex
