// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/particles/cable.h"
#include "motex/plot/drawing.h"

namespace motex {

/// Outlines, in pixels of the image with (0, 0) at the corner of its top left pixel, of where Σ ±√|a_j| ψ_j reaches
/// `share` of its largest value: a_j is the peak of base j (first plane), the sign that of the core's own. The root
/// keeps faint bases in the silhouette: a wing is as solid as the body.
std::vector<std::vector<Point>> shape_of_bases(std::span<const Base> bases, double share = 0.4);

/// Outline of a blob of that radius moving by (vx, vy) a frame: a disc when slow, a drop with its tail behind when it
/// moves farther than 1.5 of its width.
std::vector<Point> drop_outline(Point centre, double radius, double vx, double vy);

/// A leaf, pointed at both ends, half `along` long in the direction across the base's angle, half `across` wide.
std::vector<Point> leaf_outline(Point centre, double angle, double along, double across);

/// What a cartoon draws for a moveton: core first, then its coils; velocity in pixels a frame; `size` (0 … 1) of its
/// usual size.
std::vector<std::vector<Point>> cartoon_outlines(std::span<const Base> bases, double vx, double vy, double size);

}  // namespace motex
