// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace motex {

/// A directed line in a picture from P to Q: one feature. Pixels of the film. [Beier and Neely 1992]
struct FeatureLine {
  double px = 0, py = 0, qx = 0, qy = 0;
  double length() const;
};

/// The same feature in two pictures.
struct FeatureLinePair {
  FeatureLine a, b;
};

/// Both ends on their straight way from a to b.
FeatureLine between(const FeatureLinePair& pair, double weight);
/// The line moved.
FeatureLine moved(const FeatureLine& line, double dx, double dy);

}  // namespace motex
