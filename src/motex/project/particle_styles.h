// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/image/flat_colours.h"
#include "motex/particles/textured_motion.h"
#include "motex/plot/drawing.h"

namespace motex {

/// How movetons are drawn when not as their own pixels. [TM02] section 1: the motion stays realistic, the looks change.
enum class DrawnStyle {
  kSymbolic,  ///< each base by its symbol (blob, bar, edge) on white paper, as in the paper's sketches
  kCartoon    ///< flat outlined shapes in a few colours before a background in a few colours
};

/// One frame in both forms that synthesis writes.
struct StyledFrame {
  Image picture;  ///< opaque
  Image layer;    ///< the elements alone, with alpha
};

/// Draws cables frame by frame. A cartoon shape is, for a moveton with coils, the outline of where its bases together
/// reach 0.4 of their peak (so wings keep their pose); a bar is a leaf; a blob a disc, or a drop with its tail behind
/// when it moves farther in a frame than it is wide. Colours are those of the model's cables on their background,
/// put to a palette; one a cable for its whole life; shapes shrink as their element fades.
///
/// `model` and `cables` must outlive the painter. magnification: output pixels to one of the model. Cost of a frame at
/// 640 × 480 with 300 movetons: about 25 ms.
class StylePainter {
 public:
  /// Throws InvalidInput unless magnification is 0.1 … 16.
  StylePainter(const TexturedMotion& model, const std::vector<Cable>& cables, DrawnStyle style,
               double magnification = 1);

  int width() const { return background_.width; }
  int height() const { return background_.height; }
  StyledFrame paint(std::int64_t frame) const;
  /// The same as shapes, without the background (for SVG and figures).
  Drawing draw(std::int64_t frame) const;

 private:
  struct Looks {
    Rgba fill, outline;
    double strongest = 0;  ///< largest strength over its life
  };
  void choose_colours();
  void draw_symbols(std::int64_t frame, Drawing& drawing) const;
  void draw_shapes(std::int64_t frame, Drawing& drawing) const;

  const TexturedMotion& model_;
  const std::vector<Cable>& cables_;
  DrawnStyle style_;
  double magnification_;
  double symbol_strength_ = 1;  ///< coefficient that is drawn in full ink
  std::vector<Looks> looks_;    ///< one a cable
  Image background_;
};

}  // namespace motex
