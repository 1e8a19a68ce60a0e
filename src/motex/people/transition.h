// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "motex/people/cut_smoothness.h"
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

  /// Renders the frames. kAuto takes the renderer that brings both takes together best in the middle frame (a hard cut
  /// where none does within max_error) of those whose frames are smooth: area, centroid and aspect change no more
  /// suddenly than in the most sudden twentieth of the footage, or hardly more than by the smoothest renderer.
  Transition(const PeopleTexture& texture, const SecondDifferenceScales& scales, std::vector<Frame> frames,
             const RenderFilmOptions& options, int jobs);

  const Sprite& frame(int k) const { return rendered_[static_cast<std::size_t>(k)]; }
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
  /// weight: how far the shapes are on their way; dissolve: how far the colours are.
  Sprite render_on(const Way& way, const Frame& frame, double weight, double dissolve) const;
  Sprite render(std::size_t k, TransitionRenderer renderer) const;
  std::vector<Sprite> render_all(TransitionRenderer renderer) const;
  /// Of the frames rendered, between two of the footage at each end.
  double smoothness_of(const std::vector<Sprite>& rendered) const;
  void measure_errors();
  void choose();

  const PeopleTexture& texture_;
  const SecondDifferenceScales& scales_;
  std::vector<Frame> frames_;
  std::vector<Sprite> rendered_;
  RenderFilmOptions options_;
  int jobs_;
  CutReport report_;
};

}  // namespace motex
