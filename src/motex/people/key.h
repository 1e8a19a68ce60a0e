// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "motex/core/options.h"
#include "motex/image/image.h"
#include "motex/image/mask.h"
#include "motex/people/clean_plate.h"
#include "motex/people/sprite.h"

namespace motex {

struct KeyOptions {
  double tolerance = 4.5;
  double spill = 1;
  double min_part = 0.02;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"tolerance", "deviations", "how far from the clean plate the background strays by noise"},
          self.tolerance, Range{1, 100});
    visit(Field{"spill", "", "share of the screen's light on the actor that is taken away"}, self.spill, Range{0, 1});
    visit(Field{"min_part", "% of the picture", "smaller loose parts are specks and left out"}, self.min_part,
          Range{0, 100});
  }
};

/// Cuts the actor out of frames of a fixed camera, one frame at a time and each for itself: the same frame gives the
/// same sprite in any order. A pixel is I = α F + (1 − α) B with the clean plate's B in the light of the frame:
/// 1. Squares of 2 × 2 pixels show the actor when |ΔI|² exceeds the noise, shadows on the background left aside, next
///    to squares that do so clearly; loose specks and holes that are no background are cleared up.
/// 2. At the rim F is carried outwards from the inside (over ± 4 and ± 8 pixels) and α follows (unmixed_alpha()).
///    Further inside the actor is opaque.
/// 3. F loses the screen's light that is on it, measured against the colour deeper inside (spill_share()); at the rim
///    what is too green for that is partly transparent.
/// Where the footage has colours of half the resolution (4:2:0) α is stretched by 1.5 about ½ at last.
/// They are read CleanPlate::chroma_shift pixels further right there.
/// Cost: about 1 ms for 720 × 480 pixels; nothing is allocated once buffers have grown. Not thread-safe; copies share
/// the plate: one for each thread.
class Keyer {
 public:
  /// garbage: what never is the actor; empty = nothing. Throws InvalidInput when sizes differ or options are wrong.
  explicit Keyer(CleanPlate plate, const KeyOptions& options = {}, const Mask& garbage = {});
  ~Keyer();
  Keyer(const Keyer& other);
  Keyer(Keyer&&) noexcept;
  Keyer& operator=(Keyer&&) noexcept;

  const CleanPlate& plate() const;
  /// Memory of `sprite` is used again. Empty when nobody is there. Throws InvalidInput for a frame of another size.
  void key(const Image& frame, Sprite& sprite);
  Sprite key(const Image& frame) {
    Sprite sprite;
    key(frame, sprite);
    return sprite;
  }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace motex
