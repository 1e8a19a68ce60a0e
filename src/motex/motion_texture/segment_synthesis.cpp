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
constexpr Index kStepChannels[] = {0, 1, 3};  // v_x, v_z, Δψ: movement since the frame before

/// Speeds of `steps` steps that together cover `way` steps of the source: 1 at both ends, changed smoothly between.
Vector speeds(Index steps, Index way) {
  Vector change = Vector::Zero(steps);
  const double ramp = std::max(1.0, static_cast<double>(steps) / 5);
  for (Index k = 1; k + 1 < steps; ++k) {
    const double u = std::min(1.0, static_cast<double>(std::min(k, steps - 1 - k)) / ramp);
    change[k] = u * u * (3 - 2 * u);
  }
  return Vector::Ones(steps) + change * (static_cast<double>(way - steps) / change.sum());
}

/// The source in `length` frames (cubic interpolation). Its two first and two last rows stay.
FrameMatrix paced(FrameMatrix source, Index length) {
  if (length == source.rows()) return source;
  const Vector speed = speeds(length - 1, source.rows() - 1);
  FrameMatrix out(length, source.cols());
  out.topRows(2) = source.topRows(2);
  double time = 1;
  for (Index t = 2; t < length - 2; ++t) {
    time += speed[t - 1];
    const Index k = std::clamp<Index>(static_cast<Index>(time), 1, source.rows() - 3);
    const double u = time - static_cast<double>(k);
    const auto p = source.middleRows(k - 1, 4);
    out.row(t) = p.row(1) + 0.5 * u *
                                (p.row(2) - p.row(0) +
                                 u * (2 * p.row(0) - 5 * p.row(1) + 4 * p.row(2) - p.row(3) +
                                      u * (3 * (p.row(1) - p.row(2)) + p.row(3) - p.row(0))));
    for (const Index c : kStepChannels) out(t, c) *= speed[t - 1];
  }
  out.bottomRows(2) = source.bottomRows(2);
  return out;
}

}  // namespace

SegmentSynthesis::SegmentSynthesis(const MotionTexture& model, const PlayOptions& options)
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
  const Index end = hand_over_row(model_, a), l = end + 2 - a.row;
  return play({a.texton, a.row, l, a.row, next < 0 ? end : model_.instances[static_cast<std::size_t>(next)].row, l});
}

const FrameMatrix& SegmentSynthesis::play(const Piece& piece) {
  return play(piece, model_.corpus.middleRows(piece.first_row, 2).cast<double>(),
              model_.corpus.middleRows(piece.last_row, 2).cast<double>());
}

const FrameMatrix& SegmentSynthesis::play(const Piece& piece, const FrameMatrix& first, const FrameMatrix& last) {
  for (const FrameMatrix* ends : {&first, &last})
    if (ends->rows() != 2 || ends->cols() != model_.features.size() || !ends->allFinite())
      throw InvalidInput("SegmentSynthesis::play: end poses are 2 finite rows of " +
                         std::to_string(model_.features.size()) + " features each");
  const Subspace& space = model_.subspace(piece.texton);
  const Index l = piece.length, d = space.basis.cols();
  const FrameMatrix source =
      paced(model_.corpus.middleRows(piece.source_row, piece.source_length).cast<double>(), piece.length);
  if (l < 4) return out_ = source;
  const bool replay = source_ == NoiseSource::kReplay;
  states_.resize(l, d);
  if (replay) {
    states_.topRows(2) = (first - source.topRows(2)) * space.basis;
    states_.bottomRows(2) = (last - source.bottomRows(2)) * space.basis;
  } else {
    states_.topRows(2) = (first.rowwise() - space.mean.transpose()) * space.basis;
    states_.bottomRows(2) = (last.rowwise() - space.mean.transpose()) * space.basis;
  }
  draw_noise(l - 2, d, noise_);
  bridge(piece.texton).solve(states_, noise_rows_);
  if (replay)
    out_ = source;
  else
    out_ = space.mean.transpose().replicate(l, 1);
  gemm(false, true, l, out_.cols(), d, 1.0, states_.data(), d, FrameMatrix(space.basis).data(), d, 1.0, out_.data(),
       out_.cols());
  const FrameMatrix left_last = last - out_.bottomRows(2), left_first = first - out_.topRows(2);
  blend(l - 2, left_last.row(0).transpose(), (left_last.row(1) - left_last.row(0)).transpose(), true);
  blend(1, left_first.row(1).transpose(), (left_first.row(0) - left_first.row(1)).transpose(), false);
  out_.topRows(2) = first;
  out_.bottomRows(2) = last;
  if (!out_.allFinite())
    throw NumericalFailure("texton " + std::to_string(piece.texton) + " is unstable: its motion leaves all bounds");
  return out_;
}

}  // namespace motex
