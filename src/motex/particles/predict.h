// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/detect_cores.h"
#include "motex/particles/element_filter.h"

namespace motex {

/// E[next frame | frames so far] of a scene of elements, one frame ahead.
///
/// Learned on the frames of `training`: background, noise, looks and dynamics of the elements (track_elements.h). Then,
/// frame by frame, elements are found in the frame just seen where their filters expect them and elsewhere, and every
/// filter takes its sight in. The prediction is the expected picture, not the picture of expected elements: an element
/// at N(p, v) is its Gaussian widened to s² + v, as dark as that makes it; what comes into sight (births) is the mean
/// of what earlier predictions missed, blurred.
class FramePredictor {
 public:
  /// Throws InvalidInput (fewer than 8 frames), Cancelled.
  explicit FramePredictor(const ClipFrames& training, const JobContext& job = {});

  /// The next frame: luma, of the size of the training frames. The training frames have been observed already.
  void observe(const Plane& frame);
  Plane predict() const;

  std::size_t num_elements() const { return elements_.size(); }
  const Plane& background() const { return background_; }

 private:
  struct Element {
    ElementFilter filter;
    Blob looks;  ///< means over its sights
    int num_seen = 1;
    int num_missed = 0;  ///< frames in a row
  };
  std::vector<ExpectedBlob> expectations() const;
  void take_in(const std::vector<Blob>& blobs);
  void take_in(Element& element, const Blob& blob) const;
  double weight_of(const Element& element) const;

  ElementModel model_;
  DetectOptions detect_;
  Plane background_, births_;
  double noise_ = 1;
  std::vector<Element> elements_;
  int frame_ = 0;  ///< number of the frame that comes next
};

}  // namespace motex
