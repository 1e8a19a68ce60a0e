// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/image.h"
#include "motex/image/planes.h"
#include "motex/particles/element_light.h"
#include "motex/particles/moveton_frame.h"
#include "motex/particles/render.h"

namespace motex {

/// How the movetons of a frame become a picture: as a photo (here), as symbols or as a cartoon (styles).
class FramePainter {
 public:
  virtual ~FramePainter() = default;
  /// picture: opaque, movetons on the background. layer: the movetons alone, alpha not premultiplied; over the
  /// background it gives the picture. Both keep their memory from call to call; the painter sets their size.
  virtual void paint(const MovetonFrame& frame, Image& picture, Image& layer) = 0;
};

/// Sums of bases over a background.
class PhotoPainter : public FramePainter {
 public:
  /// background: 1 or 3 planes, of the magnified size. num_base_planes: coefficients that bases have.
  /// light: no pixel gets less or more of it; stray bases would be specks.
  PhotoPainter(Planes background, double magnification, int num_base_planes = 3, const ElementLight& light = {});
  void paint(const MovetonFrame& frame, Image& picture, Image& layer) override;

 private:
  Planes background_, sum_;
  Image background_image_;
  BaseRenderer renderer_;
  ElementLight light_;
};

/// The most transparent layer whose source-over onto `background` gives `picture`, both opaque and of one size:
///   A = max over colours of D/(255 − B) where D = I − B > 0, −D/B where D < 0, rounded up to 8 bits;  C = B + D/A
/// so that A C + (1 − A) B = I to the rounding of C: after rounding exactly I. What brightens becomes near white, what
/// darkens near black. Where A = 0 the colour is that of the surroundings, so that neither codecs nor filters of
/// players bleed a foreign colour in.
void make_layer(const Image& picture, const Image& background, Image& layer);

/// to_image() into memory that is there already.
void fill_image(const Planes& planes, Image& image);

}  // namespace motex
