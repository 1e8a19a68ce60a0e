// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/cable.h"
#include "motex/particles/cable_prior.h"
#include "motex/particles/core_image.h"
#include "motex/particles/core_proposal.h"

namespace motex {

/// One core in one frame; links are indices into the frames beside, −1 = the cable begins or ends here.
struct CoreElement {
  CoreState z{};
  BaseKind kind = BaseKind::kGaussian;
  int previous = -1, next = -1;
  int cell = -1;        ///< that it is listed in
  int place = -1;       ///< in that list
  int live_place = -1;  ///< in the list of its frame; −1 = a free slot
};

/// W as elements frame by frame with links, and what they leave of the images. All that a move changes lies in the
/// frames it works on, so moves in frames that are apart can be made at the same time.
class CableState {
 public:
  /// residuals: luma minus background. Cores of the start that the prior makes impossible end or cut their cables.
  CableState(const std::vector<Plane>& residuals, const std::vector<Cable>& start, const CableLaw& law);

  int num_frames() const { return static_cast<int>(frames_.size()); }
  int num_cells() const { return cells_across_ * cells_down_; }
  int cell_of(const CoreState& z) const;
  PictureCell cell(int idx) const;

  const std::vector<int>& live(int frame) const { return at(frame).live; }
  const std::vector<int>& in_cell(int frame, int cell) const { return at(frame).cells[static_cast<std::size_t>(cell)]; }
  const CoreElement& element(int frame, int idx) const { return at(frame).elements[static_cast<std::size_t>(idx)]; }
  const ResidualFrame& image(int frame) const { return at(frame).image; }
  ResidualFrame& image(int frame) { return at(frame).image; }

  /// Adds or removes an element without links; the image changes with it.
  int add(int frame, BaseKind kind, const CoreState& z);
  void remove(int frame, int idx);
  /// Another state in place, the image left alone.
  void place(int frame, int idx, const CoreState& z);
  /// Image += sign · element.
  void paint(int frame, int idx, float sign);
  /// Joins frame's element to the next frame's, or cuts (−1); what was joined to either before must be cut first.
  void link(int frame, int idx, int next_idx);
  void cut_after(int frame, int idx);

  /// Appends the elements of `frame` within radius of (x, y) to `out`.
  void near(int frame, double x, double y, double radius, std::vector<int>& out) const;

  /// A copy of some frames, to go back to.
  struct Snapshot;
  void save(int first, int end, Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

  std::vector<Cable> cables() const;
  std::int64_t num_elements() const;

 private:
  struct Frame {
    explicit Frame(const Plane& plane) : image(plane) {}
    ResidualFrame image;
    std::vector<CoreElement> elements;
    std::vector<int> live, free;
    std::vector<std::vector<int>> cells;
  };
  Frame& at(int frame) { return frames_[static_cast<std::size_t>(frame)]; }
  const Frame& at(int frame) const { return frames_[static_cast<std::size_t>(frame)]; }
  static void list_in(Frame& frame, int idx, int cell);
  static void unlist(Frame& frame, int idx);

  int width_ = 0, height_ = 0;
  int cells_across_ = 0, cells_down_ = 0;
  std::vector<Frame> frames_;
};

struct CableState::Snapshot {
  int first = 0, end = 0;
  std::vector<Frame> frames;
};

/// ln p(W, images) up to a constant of the images' size: Σ −residual² / 2 noise² − pixels · ln noise + ln p(W).
double log_posterior(const CableState& state, const CableLaw& law);

}  // namespace motex
