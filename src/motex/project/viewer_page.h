// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "motex/motion/clip.h"
#include "motex/project/figure.h"
#include "motex/project/texton_span.h"

namespace motex {

struct ViewerPageOptions {
  std::string title;  ///< shown instead of the clip's name when not empty
};

/// One HTML file, complete in itself, that plays the clip in 3D in any browser, from disk too: body with floor, shadow
/// and trails, time line with the strip of textons (spans may be empty). Positions are kept as 16 bits of the box that
/// the motion fills: within 0.1 mm for a stage of 6 m. Size ≈ 8 bytes × points × frames + 40 kB. Names may hold any
/// characters. Throws InvalidInput for a clip without frames and for spans that leave it.
std::string viewer_page(const Clip& clip, const std::vector<TextonSpan>& spans = {},
                        const ViewerPageOptions& options = {});
/// The same of any figure; points that are NaN are not shown.
std::string viewer_page(const FigureMotion& motion, const std::vector<TextonSpan>& spans = {},
                        const ViewerPageOptions& options = {});

}  // namespace motex
