// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/core/matrix.h"

namespace motex {

/// Frames start … start + length − 1 of a clip are played by that texton.
struct TextonSpan {
  int texton = 0;
  Index start = 0;
  Index length = 0;
  std::string source;  ///< where its example comes from, for people: "salsa_01, frames 120–210"; may be empty
};

}  // namespace motex
