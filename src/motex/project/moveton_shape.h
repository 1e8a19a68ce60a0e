// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/cable.h"
#include "motex/plot/drawing.h"

namespace motex {

/// The bases of a cable in one frame of its life: core first.
std::vector<Base> bases_at(const Cable& cable, std::int64_t frame);

/// Outlines, in pixels of the image with (0, 0) at the corner of its top left pixel, of where the bases together reach
/// `share` of their largest deviation from the background (of that sign; the first plane decides).
std::vector<std::vector<Point>> shape_of_bases(const std::vector<Base>& bases, double share = 0.4);

/// Outline of a blob of that radius moving by (vx, vy) a frame: a disc when slow, a drop with its tail behind when it
/// moves farther than 1.5 of its width.
std::vector<Point> drop_outline(Point centre, double radius, double vx, double vy);

/// A leaf, pointed at both ends, half `along` long in the direction across the base's angle, half `across` wide.
std::vector<Point> leaf_outline(Point centre, double angle, double along, double across);

/// What a cartoon draws for the moveton in that frame, `size` (0 … 1) of its usual size.
std::vector<std::vector<Point>> cartoon_outlines(const Cable& cable, std::int64_t frame, double size);

}  // namespace motex
