// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/options.h"
#include "motex/motion/clip.h"
#include "motex/plot/drawing.h"
#include "motex/project/figure.h"
#include "motex/project/texton_span.h"

namespace motex {

struct PoseStripOptions {
  int figures = 12;
  int rows = 1;
  double start_secs = 0;
  double secs = 0;
  int ghosts = 2;
  double figure_height = 150;
  double azimuth_deg = 28;
  double elevation_deg = 9;
  bool trails = true;
  bool frame_numbers = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"figures", "", "key frames in a row"}, self.figures, Range{1, 200});
    visit(Field{"rows", "", "rows of key frames"}, self.rows, Range{1, 200});
    visit(Field{"start_secs", "s", "where in the clip the strip begins"}, self.start_secs, Range{0, 1e6});
    visit(Field{"secs", "s", "how much of the clip it shows; auto: 0.4 s a figure"}, self.secs, Range{1e-3, 1e6, true});
    visit(Field{"ghosts", "", "faint figures between two key frames"}, self.ghosts, Range{0, 20});
    visit(Field{"figure_height", "px", "height of the standing body"}, self.figure_height, Range{20, 2000});
    visit(Field{"azimuth_deg", "°", "view from the front, turned towards the left side by this"}, self.azimuth_deg,
          Range{-360, 360});
    visit(Field{"elevation_deg", "°", "how far from above"}, self.elevation_deg, Range{0, 60});
    visit(Field{"trails", "", "paths of the right hand and the right foot in red"}, self.trails, Range{});
    visit(Field{"frame_numbers", "", "frame number under each figure"}, self.frame_numbers, Range{});
  }
};

/// Key frames of a clip side by side in one orthographic view, time running to the right: figures stand at equal times
/// above their own place, faint figures and the red paths of right hand and right foot pass from one to the next. The
/// view faces the dancer's mean direction over the strip. Left limbs are blue, right ones orange. spans (may be empty)
/// become a strip of textons under each row. Throws InvalidInput when the clip has no frame at start_secs.
Drawing pose_strip(const Clip& clip, const std::vector<TextonSpan>& spans = {}, const PoseStripOptions& options = {});
/// The same of any figure; points that are NaN are not drawn.
Drawing pose_strip(const FigureMotion& motion, const std::vector<TextonSpan>& spans = {},
                   const PoseStripOptions& options = {});

}  // namespace motex
