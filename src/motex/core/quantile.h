// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace motex {

/// The value below which that share (0 … 1) of the values lies, linear between ranks: 0 is the smallest, 1 the largest.
/// Needs at least one value. Linear cost.
double quantile(std::vector<double> values, double share);

/// The middle value, the upper one of two; 0 without any. Linear cost.
double median(std::vector<double> values);

}  // namespace motex
