// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/particles/explain.h"
#include "motex/plot/drawing.h"

namespace motex {

/// Where and when elements of a clip are unlikely under a model: abnormality_map() as heat over the clip's background,
/// the paths of the most surprising elements on it (ringed where they surprise most), and abnormality_over_time().
/// title: what the model is called.
Drawing abnormality_figure(const TexturedMotion& observed, const Explanation& explanation, const std::string& title);

}  // namespace motex
