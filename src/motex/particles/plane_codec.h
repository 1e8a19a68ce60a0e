// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/planes.h"
#include "motex/particles/range_coder.h"

namespace motex {

/// A still picture as quantised cosine coefficients: planes as Y, B − Y, R − Y; blocks of 8 × 8 (edges repeated);
/// coefficients divided by the step (differences of colour by 1.5 steps), rounded, small ones towards 0; entropy coded
/// with their surroundings as context. Error of a pixel: about step / √12 where there is structure, less where not.
/// planes: 1 or 3, of one size; step > 0, grey levels.
void write_planes(RangeWriter& writer, const Planes& planes, double step);

/// What write_planes() wrote; size, number of planes and step must be the same. Throws ParseError.
Planes read_planes(RangeReader& reader, int width, int height, int num_planes, double step);

/// R, G, B → Y, B − Y, R − Y of a pixel (BT.601), and back.
template <typename Number>
void to_luma_and_differences(Number& a, Number& b, Number& c) {
  const Number luma = Number(0.299) * a + Number(0.587) * b + Number(0.114) * c, blue = c - luma, red = a - luma;
  a = luma;
  b = blue;
  c = red;
}
template <typename Number>
void to_red_green_blue(Number& a, Number& b, Number& c) {
  const Number red = a + c, blue = a + b;
  const Number green = a - (Number(0.299) * c + Number(0.114) * b) / Number(0.587);
  a = red;
  b = green;
  c = blue;
}

}  // namespace motex
