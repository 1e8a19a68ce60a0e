// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/options.h"
#include "motex/particles/base.h"
#include "motex/particles/blob_fit.h"

namespace motex {

enum class CoreSign { kAuto, kBright, kDark, kBoth };
enum class CoreShape { kAuto, kRound, kOriented };

/// Of the amplitude that most of the energy of a clip has: the least one of its elements.
inline constexpr double kFaintShare = 0.08;

struct DetectOptions {
  double min_significance = 7;
  double min_scale = kMinScale;
  double max_scale = kMaxScale;
  CoreSign sign = CoreSign::kAuto;
  CoreShape shape = CoreShape::kAuto;
  /// Deviation of elements from the fitted shape relative to their peak; measured by decided().
  double shape_misfit = 0;
  /// Least |amplitude|, grey levels: what is far fainter than the elements that make up the clip is flicker. Likewise.
  double min_amplitude = 0;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"min_significance", "deviations", "least response of an element, in deviations of that of the noise"},
          self.min_significance, Range{1, 1000});
    visit(Field{"min_scale", "pixels", "smallest scale of an element"}, self.min_scale, Range{0.5, 32});
    visit(Field{"max_scale", "pixels", "largest scale of an element"}, self.max_scale, Range{0.5, 32});
    visit(Field{"sign", "", "elements are brighter or darker than the background; auto: decided over the clip"},
          self.sign, Choices{{"auto", "bright", "dark", "both"}});
    visit(Field{"shape", "", "round elements, or oriented ones (streaks, birds); auto: decided over the clip"},
          self.shape, Choices{{"auto", "round", "oriented"}});
  }
};

/// Deviation of a pixel: 1.4826 × the median of |residual| over every plane (a fixed subset of its pixels), which a few
/// elements do not disturb; at least 0.5 grey levels (rounding, compression). Throws InvalidInput without planes.
double noise_of(const std::vector<Plane>& residuals);

/// The options with sign and shape decided by the elements that stand out most in up to seven of the frames, and
/// shape_misfit measured on those that stand alone, min_amplitude on all.
DetectOptions decided(const DetectOptions& options, const std::vector<Plane>& residuals, double noise);

/// An element expected in a frame because its path leads there.
struct ExpectedBlob {
  Blob blob;        ///< to begin the fit with
  BlobPrior prior;  ///< amplitudes of the prior have the sign of the element
  bool is_seen =
      true;            ///< false = a guess (a gap, the frame before or after a path): taken only where the frame agrees
  int num_sights = 0;  ///< of its path
  double turn_precision = 0;  ///< of blob.turn, 1 / variance; 0 = it is not known
};

/// Elements of one frame (residual = luma minus background) as Gaussian spots fitted jointly with their neighbours:
/// 1. local maxima over place and scale of differences of Gaussians, above min_significance;
/// 2. all fitted to the frame together; what they leave is searched again, so that of two that overlap both are
///    found; a spot stays only while it explains more than the noise and the misfit of its stronger neighbours would.
/// expected: where to begin, and what is known there.
/// Strongest first. sign and shape of the options are decided on this frame when they are auto.
/// left: what the spots leave of the residual.
std::vector<Blob> detect_blobs(const Plane& residual, double noise, const DetectOptions& options,
                               const std::vector<ExpectedBlob>& expected = {}, Plane* left = nullptr);

/// The core base that stands for a spot: a Gaussian where it is nearly round, else a streak turned with it, both of its
/// area. Coefficient of plane 0 by projection: of the spot's energy a Gaussian leaves ((a − 1) / (a + 1))² at aspect a,
/// a streak the same at a / 2.
Base core_of(const Blob& blob);
/// The same of a kind chosen for the whole life of an element by its typical aspect.
Base core_of(const Blob& blob, BaseKind kind);
BaseKind core_kind(double aspect);

/// core_of() of each of detect_blobs().
std::vector<Base> detect_cores(const Plane& residual, double noise, const DetectOptions& options);

}  // namespace motex
