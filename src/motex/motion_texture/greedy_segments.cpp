// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "motex/motion_texture/initial_segments.h"

namespace motex {
namespace {

constexpr double kPriorFrames = 30;  // short segments: a strong prior would make all systems alike

/// Open-loop prediction of frames from the two before them; errors are distances in cm.
class Rollout {
 public:
  Rollout(const FrameMatrix& features, const TextonFit& fit, const Subspace& subspace, Index row)
      : features_(features), fit_(fit), subspace_(subspace), row_(row) {
    before_ = state(row);
    now_ = state(row + 1);
  }
  /// Error of the next frame.
  double step() {
    const Index d = now_.size();
    const Vector y = features_.row(row_ + ++done_ + 1).transpose() - subspace_.mean;
    const Vector x = subspace_.basis.transpose() * y;
    const Vector next = fit_.dynamics.transition.leftCols(d) * now_ + fit_.dynamics.transition.rightCols(d) * before_ +
                        fit_.dynamics.offset;
    before_ = now_;
    now_ = next;
    return std::sqrt(std::max(0.0, y.squaredNorm() - x.squaredNorm()) + (x - now_).squaredNorm());
  }

 private:
  Vector state(Index row) const {
    return subspace_.basis.transpose() * (features_.row(row).transpose() - subspace_.mean);
  }
  const FrameMatrix& features_;
  const TextonFit& fit_;
  const Subspace& subspace_;
  Index row_, done_ = 0;
  Vector before_, now_;
};

/// Sum of the errors of the first min_frames frames; stops once it exceeds `budget`.
double start_error(Rollout rollout, Index min_frames, double budget) {
  double sum = 0;
  for (Index t = 2; t < min_frames && sum <= budget; ++t) sum += rollout.step();
  return sum;
}

}  // namespace

Segmentation greedy_segments(const Corpus& corpus, const TextonFitter& fitter, double threshold, Index min_frames,
                             Index max_frames, const JobContext& job) {
  Segmentation segments;
  std::vector<TextonFit> fits;
  const auto rollout = [&](std::size_t i, Index row) {
    return Rollout(corpus.features, fits[i], fitter.is_shared() ? fitter.shared() : fits[i].subspace, row);
  };
  const auto scored = static_cast<double>(min_frames - 2);
  for (std::size_t r = 0; r < corpus.runs.size(); ++r) {
    const Run& run = corpus.runs[r];
    const Index end = run.row + run.length;
    for (Index row = run.row; row < end;) {
      job.check_cancelled();
      double best = threshold * scored;
      std::size_t label = fits.size();
      for (std::size_t i = 0; i < fits.size(); ++i) {
        const double error = start_error(rollout(i, row), min_frames, best);
        if (error <= best) best = error, label = i;
      }
      LabelledSegment segment{static_cast<int>(label), static_cast<int>(r), row, min_frames};
      if (label == fits.size()) fits.push_back(fitter.fit({&segment, 1}, kPriorFrames));
      Rollout grown = rollout(label, row);
      double sum = 0;
      for (Index t = 2; t < min_frames; ++t) sum += grown.step();
      while (row + segment.length < end && segment.length < max_frames) {
        sum += grown.step();
        if (sum > threshold * static_cast<double>(segment.length - 1)) break;
        ++segment.length;
      }
      if (end - (row + segment.length) < min_frames) segment.length = end - row;
      row += segment.length;
      segments.push_back(segment);
    }
    job.progress("finding segments", 0.3 * static_cast<double>(end) / static_cast<double>(corpus.features.rows()));
  }
  return segments;
}

}  // namespace motex
