// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/matrix.h"
#include "motex/people/motif.h"
#include "motex/people/people_texture.h"
#include "motex/people/silhouette_bits.h"
#include "motex/people/sprite.h"

namespace motex {

/// The foreground pictures of many frames, reduced once so that any two can be compared: premultiplied R, G, B and
/// alpha in 48 × 48 cells around the centroid, 32 to each side of the bounding box; both lie on one another by their
/// centroids, and the box of the second is scaled to that of the first. [PT04] section 3.1. 9 KB a frame.
class SilhouettePictures {
 public:
  static constexpr int kSide = 48, kBoxSide = 32;
  static constexpr std::size_t kBytes = std::size_t{4} * kSide * kSide;

  SilhouettePictures() = default;
  explicit SilhouettePictures(int num_frames);

  /// Different frames may be set from several threads. A frame never set is empty.
  void set(int frame, const Sprite& sprite, const Silhouette& silhouette);
  int num_frames() const { return static_cast<int>(present_.size()); }
  bool empty(int frame) const { return present_[static_cast<std::size_t>(frame)] == 0; }

  /// √ξ of one pair: root mean square of a − b′ over R, G, B and alpha in a box, grey levels; 255 when one is empty, 0
  /// when both are. Symmetric.
  double difference(int a, int b) const;
  /// Sum of squares behind it.
  std::int64_t squared_difference(int a, int b) const;

 private:
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint8_t> present_;
};

/// What find_cuts() compares frames by: read once, frame after frame.
struct ComparableFrames {
  SilhouettePictures pictures;
  std::vector<MaskBits> masks;  ///< MaskAlignment::kBox
};
/// Throws InvalidInput unless source and texture have the same number of frames.
ComparableFrames comparable_frames(const PeopleTexture& texture, SpriteSource& source, const JobContext& job = {});

/// The silhouette-to-silhouette matrix of two stretches, n × m: √ξ of frame a.start + f and b.start + g in grey levels.
/// [PT04] section 3.1, Figure 5. Throws InvalidInput when a stretch leaves the frames.
FrameMatrixF compare_silhouettes(const SilhouettePictures& pictures, const FrameSpan& a, const FrameSpan& b,
                                 int jobs = 0);

/// √((ξ_f,g + ξ_f+1,g+1) / 2), (n − 1) × (m − 1): two consecutive frames, so that the movement agrees too; the film
/// goes from a.start + f to b.start + g + 1 where it is least. [PT04] section 3.1. Throws InvalidInput under 2 × 2.
FrameMatrixF two_frame_differences(const FrameMatrixF& matrix);

}  // namespace motex
