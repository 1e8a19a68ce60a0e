// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/segment_synthesis.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"
#include "motex/core/gemm.h"
#include "motex/motion_texture/jumps.h"

namespace motex {
namespace {

constexpr double kBlendSecs = 1.0 / 3;
constexpr double kReplayNoise = 0.2;

}  // namespace

SegmentSynthesis::SegmentSynthesis(const MotionTexture& model, const SynthesizeOptions& options)
    : model_(model),
      source_(options.noise_source),
      noise_(options.noise > 0                              ? options.noise
             : options.noise_source == NoiseSource::kReplay ? kReplayNoise
                                                            : 1),
      rng_(Rng(options.seed).fork(2)),
      blend_frames_(std::max<Index>(2, std::lround(kBlendSecs / model.frame_time_secs()))),
      bridges_(model.textons.size()) {}

Bridge& SegmentSynthesis::bridge(int texton) {
  auto& slot = bridges_[static_cast<std::size_t>(texton)];
  if (!slot) {
    Lds dynamics = model_.textons[static_cast<std::size_t>(texton)].dynamics;
    if (source_ == NoiseSource::kReplay) dynamics.offset.setZero();
    slot = std::make_unique<Bridge>(dynamics);
  }
  return *slot;
}

void SegmentSynthesis::draw_noise(Index rows, Index cols, double strength) {
  noise_rows_.resize(rows, cols);
  for (Index t = 0; t < rows; ++t)
    for (Index c = 0; c < cols; ++c) noise_rows_(t, c) = strength * rng_.normal();
}

/// Adds the cubic that leaves 0 without slope blend_frames_ away and arrives at `value` with `slope` at first_row.
void SegmentSynthesis::blend(Index first_row, const Vector& value, const Vector& slope, bool at_end) {
  const Index room = at_end ? first_row : out_.rows() - 1 - first_row;
  const Index width = std::min(blend_frames_, room);
  for (Index k = 1; k < width; ++k) {
    const double u = 1 - static_cast<double>(k) / static_cast<double>(width);
    const double h = u * u * (3 - 2 * u), g = u * u * (u - 1) * static_cast<double>(width);
    out_.row(at_end ? first_row - k : first_row + k) += (h * value + g * slope).transpose();
  }
}

const FrameMatrix& SegmentSynthesis::play(int instance, int next) {
  const Instance& a = model_.instances[static_cast<std::size_t>(instance)];
  const Subspace& space = model_.subspace(a.texton);
  const Index l = hand_over_row(model_, a) + 2 - a.row, d = space.basis.cols();
  const Index end_row = next < 0 ? a.row + l - 2 : model_.instances[static_cast<std::size_t>(next)].row;
  const auto source = model_.corpus.middleRows(a.row, l);
  const FrameMatrix first = source.topRows(2).cast<double>();
  const FrameMatrix last = model_.corpus.middleRows(end_row, 2).cast<double>();
  const bool replay = source_ == NoiseSource::kReplay;
  states_.resize(l, d);
  if (replay) {
    states_.topRows(2).setZero();
    states_.bottomRows(2) = (last - source.bottomRows(2).cast<double>()) * space.basis;
  } else {
    states_.topRows(2) = (first.rowwise() - space.mean.transpose()) * space.basis;
    states_.bottomRows(2) = (last.rowwise() - space.mean.transpose()) * space.basis;
  }
  draw_noise(l - 2, d, noise_);
  bridge(a.texton).solve(states_, noise_rows_);
  if (replay)
    out_ = source.cast<double>();
  else
    out_ = space.mean.transpose().replicate(l, 1);
  gemm(false, true, l, out_.cols(), d, 1.0, states_.data(), d, FrameMatrix(space.basis).data(), d, 1.0, out_.data(),
       out_.cols());
  if (!out_.allFinite())
    throw NumericalFailure("texton " + std::to_string(a.texton) + " is unstable: its motion leaves all bounds");
  const FrameMatrix left_last = last - out_.bottomRows(2), left_first = first - out_.topRows(2);
  blend(l - 2, left_last.row(0).transpose(), (left_last.row(1) - left_last.row(0)).transpose(), true);
  if (!replay) blend(1, left_first.row(1).transpose(), (left_first.row(0) - left_first.row(1)).transpose(), false);
  out_.topRows(2) = first;
  out_.bottomRows(2) = last;
  return out_;
}

}  // namespace motex
