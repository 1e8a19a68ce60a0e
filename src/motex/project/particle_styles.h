// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "motex/image/flat_colours.h"
#include "motex/particles/frame_painter.h"
#include "motex/particles/textured_motion.h"
#include "motex/plot/drawing.h"

namespace motex {

/// How movetons are drawn when not as their own pixels. [TM02] section 1: the motion stays realistic, the looks change.
enum class DrawnStyle {
  kSymbolic,  ///< each base by its symbol (blob, bar, edge) on white paper, as in the paper's sketches
  kCartoon    ///< flat outlined shapes in a few colours before a background in a few colours
};

/// Draws movetons frame by frame, at any magnification crisp and anti-aliased. A cartoon shape is, for a moveton with
/// coils, the outline of its bases together (so wings keep their pose); a bar is a leaf; a blob a disc, or a drop with
/// its tail behind when it moves farther in a frame than 1.5 of its width. Fills are those of the model's cables on
/// their background, put to a palette of five and kept apart from the background; a shape shrinks as its element fades.
///
/// Cost of a frame of 640 × 480 with 60 flakes: 3 ms.
class StylePainter : public FramePainter {
 public:
  /// magnification: output pixels to one of the model. Throws InvalidInput unless it is 0.1 … 16.
  StylePainter(const TexturedMotion& model, DrawnStyle style, double magnification = 1);

  int width() const { return background_.width; }
  int height() const { return background_.height; }
  void paint(const MovetonFrame& frame, Image& picture, Image& layer) override;
  /// The movetons alone as shapes (for SVG and figures).
  Drawing draw(const MovetonFrame& frame);

 private:
  /// A cable's fill is chosen where it was strongest so far.
  struct Looks {
    std::int64_t frame = 0;
    double strongest = 0;
    Rgba fill, outline;
  };
  void draw_symbols(const MovetonFrame& frame, Drawing& drawing) const;
  void draw_shapes(const MovetonFrame& frame, Drawing& drawing);
  LevelTriple colour_at_peak(const Base& core) const;
  void choose_fill(const Base& core, Looks& looks) const;

  DrawnStyle style_;
  double magnification_;
  int model_width_, model_height_, num_planes_;
  Planes model_background_;
  double full_ink_ = 1;             ///< coefficient that is drawn in full ink
  std::vector<LevelTriple> fills_;  ///< what cables look like at their strongest
  Image background_;
  std::map<std::int64_t, Looks> looks_;
};

}  // namespace motex
