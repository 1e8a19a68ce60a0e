// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace motex {

/// How much light elements add to the background of a picture, grey levels of a plane.
struct ElementLight {
  float darkest = -std::numeric_limits<float>::infinity();
  float brightest = std::numeric_limits<float>::infinity();
};

}  // namespace motex
