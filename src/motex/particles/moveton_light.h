// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/core/job.h"
#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/joint_fit.h"

namespace motex {

/// The light of a clip shared out among the bases of its cables: in each frame all coefficients together by least
/// squares, and what they leave. Geometry belongs to the caller, who changes cables between calls. While coils are
/// sought the coefficients are those of the luma, in coefficients[0].
class MovetonLight {
 public:
  /// residuals: luma minus its background of each frame, where that is not the same in all of them; else empty.
  MovetonLight(const ClipFrames& clip, const Planes& background, std::vector<Plane> residuals,
               std::vector<Cable>& cables, double reach, const JobContext& job);

  /// Luma coefficients of all frames.
  void fit_luma();
  /// Coefficients of each colour, from those of the luma.
  void fit_colours();

  /// Luma minus background minus all bases, as of the last fit.
  const Plane& left(std::size_t frame) const { return left_[frame]; }
  int num_frames() const { return clip_.num_frames(); }
  double background_psnr() const;
  double psnr() const;  ///< of the last fit
  /// 1.4826 · median |left| over every 7th pixel, at least one grey level (rounding, compression).
  double noise() const;
  /// Cores near enough to own pixels within the reach of this one.
  const std::vector<Base>& neighbours(std::size_t cable, std::size_t at) const { return neighbours_[cable][at]; }

 private:
  struct Occupant {
    std::size_t cable = 0;
    std::size_t at = 0;  // frame − first_frame
  };

  void find_neighbours(double reach);
  Plane target(std::size_t frame) const;
  Planes colour_targets(std::size_t frame) const;
  std::vector<Base*> bases_of(int frame);
  double psnr_of(double sum_of_squares) const;

  const ClipFrames& clip_;
  const Planes& background_;
  Plane grey_background_;
  std::vector<Plane> residuals_;
  std::vector<Cable>& cables_;
  const JobContext& job_;
  std::vector<std::vector<Occupant>> frames_;
  std::vector<std::vector<std::vector<Base>>> neighbours_;  // of each cable and frame
  std::vector<Plane> left_;
  std::vector<double> squares_;  // of what is left, a frame
};

}  // namespace motex
