// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motex/particles/clip_frames.h"
#include "motex/particles/textured_motion.h"
#include "motex/plot/drawing.h"

namespace motex {

/// Symbols of a template's bases, as base_sketch() has them: one panel a state, the core in the middle, a line from it
/// to each coil, dashed where the coil is not always there. [TM02] Figures 3a, 9a.
Drawing template_sketch(const MovetonTemplate& moveton_template, int num_planes, double size = 110);
/// All templates of a model, one row each.
Drawing templates_picture(const TexturedMotion& model);

/// `num` movetons sampled from the templates by their share, as light on the mean colour of the background, all at one
/// enlargement. [TM02] Figures 3b, 9b, 14.
Drawing sampled_movetons_picture(const TexturedMotion& model, int num, int columns, std::uint64_t seed);

/// `num` elements of the clip, cut out of its frames, isolated ones and spread over cables and time; below each what
/// core and coils make of it. [TM02] Figure 9c.
Drawing moveton_instances_picture(const TexturedMotion& model, const ClipFrames& clip, int num, int columns);

/// The three under one another: the figure as the paper has it. clip = nullptr: without image instances.
Drawing movetons_figure(const TexturedMotion& model, const ClipFrames* clip, int num_samples, std::uint64_t seed);

}  // namespace motex
