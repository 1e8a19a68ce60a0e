// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/footage_motifs.h"

#include <algorithm>
#include <cstddef>

namespace motex {

FrameMatrix motif_series(const MotifSignals& signals) {
  const auto num_kept =
      std::count_if(signals.weights.begin(), signals.weights.end(), [](double weight) { return weight > 0; });
  const Index num_frames = signals.signals.empty() ? 0 : static_cast<Index>(signals.signals[0].values.size());
  FrameMatrix series(num_frames, num_kept);
  Index column = 0;
  for (std::size_t k = 0; k < signals.signals.size(); ++k) {
    if (signals.weights[k] <= 0) continue;
    series.col(column++) = Eigen::Map<const Vector>(signals.signals[k].values.data(), num_frames);
  }
  return series;
}

MotifReport find_footage_motifs(const PeopleTexture& texture, FindMotifsOptions options, const JobContext& job) {
  const MotifSignals signals = default_motif_signals(texture);
  const FrameMatrix series = motif_series(signals);
  if (series.cols() == 0) {
    MotifReport report;
    report.set.idle = signals.stretches;
    return report;
  }
  options.frames_per_sec = texture.frames_per_sec;
  return find_motifs(series, options, signals.stretches, job);
}

}  // namespace motex
