// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "motex/people/feature_lines.h"
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
  std::vector<FeatureLinePair> lines_of(const Frame& frame) const;
  Sprite render_with(TransitionRenderer renderer, const Frame& frame, double weight, double dissolve) const;
  double error_of(TransitionRenderer renderer) const;
  void choose();

  const PeopleTexture& texture_;
  std::vector<Frame> frames_;
  RenderFilmOptions options_;
  int jobs_;
  CutReport report_;
};

}  // namespace motex
