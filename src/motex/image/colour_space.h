// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace motex {

enum class YcbcrMatrix { kBt601, kBt709 };
enum class YcbcrRange { kStudio, kFull };  ///< Y' 16 … 235, C 16 … 240; or 0 … 255 (JPEG)

/// R', G', B' in 0 … 255 to Y', Cb, Cr in 8-bit code values (not rounded, not cut off). [ITU-R BT.601, BT.709]
std::array<double, 3> ycbcr_from_rgb(const std::array<double, 3>& rgb, YcbcrMatrix matrix, YcbcrRange range);
/// Its inverse.
std::array<double, 3> rgb_from_ycbcr(const std::array<double, 3>& ycbcr, YcbcrMatrix matrix, YcbcrRange range);

/// sRGB value 0 … 1 to light 0 … 1 and back. [IEC 61966-2-1]
double linear_from_srgb(double value);
double srgb_from_linear(double light);

}  // namespace motex
