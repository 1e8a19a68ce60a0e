// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "motex/people/feature_lines.h"
#include "motex/people/flow_warp.h"
#include "motex/people/render_film.h"

namespace motex {

/// The frames around a cut: both takes play on while one becomes the other.
class Transition {
 public:
  struct Frame {
    PlacedFrame a, b;
    std::shared_ptr<const Sprite> sprite_a, sprite_b;
    double weight = 0;  ///< of b
  };

  /// Measures how well each renderer brings both takes together in the middle frame, and takes the best.
  Transition(const PeopleTexture& texture, std::vector<Frame> frames, const RenderFilmOptions& options, int jobs);

  Sprite render(int k) const;
  const CutReport& report() const { return report_; }
  CutReport& report() { return report_; }

 private:
  /// How both sprites of a frame are brought together.
  struct Way {
    std::vector<FeatureLinePair> lines;
    std::optional<SpriteFlow> flow;
  };
  PlacedSprite left(const Frame& frame) const;
  PlacedSprite entered(const Frame& frame) const;
  std::vector<FeatureLinePair> lines_of(const Frame& frame) const;
  Way way_of(const Frame& frame, TransitionRenderer renderer) const;
  Sprite render_on(const Way& way, const Frame& frame, double weight, double dissolve) const;
  void choose();

  const PeopleTexture& texture_;
  std::vector<Frame> frames_;
  RenderFilmOptions options_;
  int jobs_;
  CutReport report_;
};

}  // namespace motex
