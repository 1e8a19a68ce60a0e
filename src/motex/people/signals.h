// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/core/options.h"
#include "motex/people/motif.h"
#include "motex/people/people_texture.h"

namespace motex {

/// One number a frame.
struct Signal {
  std::string name;            ///< "aspect", "centroid_x", …
  std::string unit;            ///< "px", "px²"; "" for ratios
  std::vector<double> values;  ///< one a frame of the people texture; NaN where nobody is to be seen
};

/// What the silhouettes of footage say over time. [PT04] section 2.1
struct PeopleSignals {
  std::vector<Signal> signals;
  std::vector<FrameSpan> stretches;  ///< frames of one take, one after another, with someone in each: whole in between
  std::vector<FrameSpan> bridged;    ///< frames inside stretches whose values are interpolated: nobody was seen

  int num_frames() const { return signals.empty() ? 0 : static_cast<int>(signals[0].values.size()); }
};

struct SignalOptions {
  double bridge_secs = 0.2;
  double smooth_secs = 0;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"bridge_secs", "s", "gaps without a person up to this long are interpolated inside a take"},
          self.bridge_secs, Range{0, 10});
    visit(Field{"smooth_secs", "s", "deviation of the Gaussian that smooths the signals; 0: as measured"},
          self.smooth_secs, Range{0, 1});
  }
};

/// In this order: aspect (width / height of the box, the paper's signal), area, width, height, centroid_x, centroid_y,
/// mu20, mu11, mu02, mu30, mu21, mu12, mu03 (Silhouette). Smoothing is a Gaussian cut at three deviations that never
/// crosses the ends of a stretch. Throws InvalidInput when takes and silhouettes disagree, when nobody is in any frame.
PeopleSignals measure_signals(const PeopleTexture& texture, const SignalOptions& options = {});

/// The signal of that name. Throws InvalidInput naming all there are.
const Signal& signal_named(const PeopleSignals& signals, const std::string& name);

/// Signals made comparable, for the search of motifs: distances between windows add up over them.
struct MotifSignals {
  std::vector<Signal> signals;       ///< scaled; 0 outside stretches
  std::vector<double> weights;       ///< what each was multiplied by after its units were taken out; 0 = left out
  std::vector<FrameSpan> stretches;  ///< windows lie inside one of them
};

/// What the default search looks at: log aspect, log area, centroid in body sizes (√ of the take's median area), mu11,
/// mu30, mu21 and mu03, smoothed with 0.04 s (the other moments tell nothing that these do not, measured on eleven
/// exercises). mu11 and mu30 change sign in the mirror: a kick with the left leg is not one with the right. Each is
/// multiplied by the inverse of its movement, the root mean square deviation from the mean of windows of two seconds,
/// and by the share of it that is no noise (third differences); one that is half noise is left out. find_motifs() puts
/// them into units of its own.
MotifSignals default_motif_signals(const PeopleTexture& texture);
/// The paper's mode: the aspect ratio alone, as measured. [PT04] section 2.2
MotifSignals paper_motif_signals(const PeopleTexture& texture);

}  // namespace motex
