// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/segmentation.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "motex/core/rng.h"

using motex::Index;

namespace {

constexpr std::array<double, 3> kLevels = {0.0, 1.0, 2.5};  // what each state sounds like: its level + unit noise

// log N(x; level, 1) of every frame in every state.
motex::FrameMatrixF log_likelihoods(const std::vector<double>& series) {
  motex::FrameMatrixF result(static_cast<Index>(series.size()), static_cast<Index>(kLevels.size()));
  for (Index t = 0; t < result.rows(); ++t) {
    for (Index i = 0; i < result.cols(); ++i) {
      const double distance = series[static_cast<std::size_t>(t)] - kLevels[static_cast<std::size_t>(i)];
      result(t, i) = static_cast<float>(-0.5 * distance * distance - 0.9189);
    }
  }
  return result;
}

}  // namespace

int main() {
  // A series that stays in a state for 30 frames or more; single frames overlap too much to tell.
  const std::vector<motex::Segment> planted = {{0, 0, 40}, {2, 40, 35}, {1, 75, 50}, {0, 125, 30}, {1, 155, 45}};
  motex::Rng rng(7);
  std::vector<double> series;
  motex::TransitionMatrix transitions(3, 1.0);  // prior: one pseudo-count a row
  for (std::size_t k = 0; k < planted.size(); ++k) {
    for (Index t = 0; t < planted[k].length; ++t) {
      series.push_back(kLevels[static_cast<std::size_t>(planted[k].state)] + rng.normal());
    }
    if (k > 0) transitions.add_count(planted[k - 1].state, planted[k].state);
  }

  const motex::FrameMatrixF emissions = log_likelihoods(series);
  const motex::SegmentOptions options{.min_length = 20};
  const auto report = motex::segment_sequence({emissions, {}, transitions, options});

  bool found = report.segments.size() == planted.size();
  std::printf("state  start  length   planted start\n");
  for (std::size_t k = 0; k < report.segments.size(); ++k) {
    const auto& segment = report.segments[k];
    const Index truth = k < planted.size() ? planted[k].start : -1;
    std::printf("%5d  %5td  %6td   %13td\n", segment.state, segment.start, segment.length, truth);
    found = found && segment.state == planted[k].state && std::abs(segment.start - truth) <= 5;
  }
  std::printf("log-likelihood %.2f; %s\n", report.score, found ? "every segment found" : "segments differ");
  return found ? 0 : 1;
}
