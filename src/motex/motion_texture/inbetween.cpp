// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/inbetween.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "motex/core/options_check.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/choreography_plan.h"

namespace motex {
namespace {

constexpr int kMeanExamples = 30;
constexpr double kMeanStrength = 0.7;
constexpr double kFootSecs = 0.5;  // of context that the feet are judged by

/// One side of the gap.
struct Side {
  FrameMatrix features;
  RootPlace place;  ///< of the frame beside the gap
};

/// A single pose has no speed: the mean is taken for it.
Side side_of(const MotionTexture& model, const Clip& clip, Index num_frames, bool at_end) {
  if (clip.num_frames() < num_frames)
    throw InvalidInput(clip.name + ": has " + std::to_string(clip.num_frames()) + " frames beside the gap instead of " +
                       std::to_string(num_frames));
  Side side;
  Clip part = slice(clip, at_end ? clip.num_frames() - num_frames : 0, num_frames);
  const bool is_pose = num_frames == 1;
  if (is_pose) {
    part.translations = part.translations.row(0).replicate(2, 1).eval();
    part.rotations = part.rotations.row(0).replicate(2, 1).eval();
  }
  side.features = encode(model.features, part);
  if (is_pose) {
    side.features.conservativeResize(1, Eigen::NoChange);
    for (const Index c : {0, 1, 3}) side.features(0, c) = model.global_subspace.mean[c];
  }
  side.place = root_place(model.features, part, at_end ? num_frames - 1 : 0);
  return side;
}

/// Rows t = 1 … n of the cubic with the given values at rows 0 and n + 1 and slopes per row there.
FrameMatrix cubic(Index n, const Eigen::RowVectorXd& first, const Eigen::RowVectorXd& first_slope,
                  const Eigen::RowVectorXd& last, const Eigen::RowVectorXd& last_slope) {
  FrameMatrix out(n, first.size());
  const auto steps = static_cast<double>(n + 1);
  for (Index t = 1; t <= n; ++t) {
    const double u = static_cast<double>(t) / steps, v = 1 - u;
    out.row(t - 1) = v * v * (1 + 2 * u) * first + u * v * v * steps * first_slope + u * u * (1 + 2 * v) * last -
                     u * u * v * steps * last_slope;
  }
  return out;
}

/// Features and root of the frames beside the gap as GapPath has them; rows −1, 0 and n + 1, n + 2 are set. Where a
/// side is a single pose its neighbour moves as `path` does.
GapPath ends_of(const FeatureSpace& space, const Side& before, const Side& after, const RootStep& step,
                const GapPath& path) {
  const Index length = path.features.rows();
  GapPath ends{FrameMatrix::Zero(length, path.features.cols()), FrameMatrix::Zero(length, 3)};
  const Index m = before.features.rows();
  ends.features.row(1) = before.features.row(m - 1);
  ends.features.row(length - 2) = after.features.row(0);
  ends.root.row(length - 2) = step.transpose();
  const auto step_at = [&](const FrameMatrix& features, Index row) {
    return RootStep(space.cm_per_unit * features(row, 0) / space.weights[0],
                    space.cm_per_unit * features(row, 1) / space.weights[1], features(row, 3) / space.weights[3]);
  };
  if (m > 1) {
    const RootStep last = step_at(before.features, m - 1);
    const double c = std::cos(last[2]), s = std::sin(last[2]);
    ends.features.row(0) = before.features.row(m - 2);
    ends.root.row(0) << -(c * last[0] - s * last[1]), -(s * last[0] + c * last[1]), -last[2];
  } else {
    ends.features.row(0) = ends.features.row(1) - path.features.row(1) + path.features.row(0);
    ends.root.row(0) = path.root.row(0) - path.root.row(1);
  }
  if (after.features.rows() > 1) {
    const RootStep next = step_at(after.features, 1);
    const double c = std::cos(step[2]), s = std::sin(step[2]);
    ends.features.row(length - 1) = after.features.row(1);
    ends.root.row(length - 1) << step[0] + c * next[0] + s * next[1], step[1] - s * next[0] + c * next[1],
        step[2] + next[2];
  } else {
    ends.features.row(length - 1) =
        ends.features.row(length - 2) - path.features.row(length - 2) + path.features.row(length - 1);
    ends.root.row(length - 1) = ends.root.row(length - 2) - path.root.row(length - 2) + path.root.row(length - 1);
  }
  return ends;
}

/// Adds the cubic that leads from the difference at one end to that at the other.
void meet(FrameMatrix& path, const FrameMatrix& ends) {
  const Index n = path.rows() - 4;
  const auto left = [&](Index row) -> Eigen::RowVectorXd { return ends.row(row) - path.row(row); };
  path.middleRows(2, n) += cubic(n, left(1), left(1) - left(0), left(n + 2), left(n + 3) - left(n + 2));
}

FollowedExample described(const MotionTexture& model, Index row, Index length) {
  for (const Run& run : model.runs)
    if (row >= run.row && row < run.row + run.length)
      return {model.clip_names[static_cast<std::size_t>(run.clip_idx)], run.clip_start + row - run.row, length,
              model.instances[static_cast<std::size_t>(instance_at(model, row + length / 2))].texton};
  throw InvalidInput("there is no row " + std::to_string(row) + " in the model");
}

/// Holds planted feet of the gap; the frames beside it stay.
void hold_feet(const MotionTexture& model, const Clip& before, const Clip& after, Clip& gap) {
  const auto most = static_cast<Index>(std::lround(kFootSecs / model.frame_time_secs()));
  const Index m = std::min(most, before.num_frames()), k = std::min(most, after.num_frames()), n = gap.num_frames();
  Clip whole = make_held_clip(model.features, m + n + k);
  const auto put = [&](Index at, const Clip& from, Index first, Index count) {
    whole.translations.middleRows(at, count) = from.translations.middleRows(first, count);
    whole.rotations.middleRows(at, count) = from.rotations.middleRows(first, count);
  };
  put(0, before, before.num_frames() - m, m);
  put(m, gap, 0, n);
  put(m + n, after, 0, k);
  std::vector<Index> pinned;
  for (Index t = 0; t < m; ++t) pinned.push_back(t);
  for (Index t = m + n; t < m + n + k; ++t) pinned.push_back(t);
  fix_feet(whole, model.feet, {}, pinned);
  gap.translations = whole.translations.middleRows(m, n);
  gap.rotations = whole.rotations.middleRows(m, n);
}

}  // namespace

Inbetweener::Inbetweener(const MotionTexture& model, const GapShape& shape, const InbetweenOptions& options)
    : model_(model), shape_(shape), options_(options), examples_(model, shape) {
  check_options(options);
}

Clip Inbetweener::fill(const Clip& before, const Clip& after, InbetweenReport& report) const {
  const FeatureSpace& space = model_.features;
  const Side here = side_of(model_, before, shape_.num_before, true);
  const Side there = side_of(model_, after, shape_.num_after, false);
  // The heading after the gap is known up to whole turns: the way round is that of the nearest example.
  RootStep step = root_step(space, here.place, there.place);
  const double turn = std::remainder(step[2], 2 * std::numbers::pi);
  double least = std::numeric_limits<double>::infinity();
  for (const double whole : {0.0, -2 * std::numbers::pi, 2 * std::numbers::pi}) {
    if (!shape_.is_end_placed && whole != 0) break;
    const RootStep candidate(step[0], step[1], turn + whole);
    const double distance = examples_.nearest_distance(examples_.seen(here.features, there.features, candidate));
    if (distance < least) least = distance, step[2] = candidate[2];
  }
  const bool is_lively = options_.aim == InbetweenAim::kLively;
  const GapExamples::Weights weights = examples_.weigh(examples_.seen(here.features, there.features, step),
                                                       is_lively ? 1 : kMeanExamples, is_lively ? 1 : kMeanStrength);
  GapPath path = examples_.mix(weights.weights);
  const Index n = shape_.num_frames;
  if (!shape_.is_end_placed) step = path.root.row(n + 2).transpose() - path.root.row(1).transpose();
  const GapPath ends = ends_of(space, here, there, step, path);
  meet(path.features, ends.features);
  meet(path.root, ends.root);
  Clip gap = make_held_clip(space, n);
  gap.name = "in-between";
  for (Index t = 0; t < n; ++t) {
    RootPlace place = place_after(space, here.place, path.root.row(t + 2).transpose());
    decode_frame(space, &path.features(t + 2, 0), true, place, gap, t);
  }
  report = {{}, weights.distance, place_after(space, here.place, step)};
  for (const int k : weights.nearest) report.followed.push_back(described(model_, examples_.row(k), n + 2));
  if (options_.foot_fix && !model_.feet.legs.empty()) hold_feet(model_, before, after, gap);
  return gap;
}

Clip inbetween(const MotionTexture& model, const Clip& before, const Clip& after, Index num_frames,
               const InbetweenOptions& options, InbetweenReport& report, const JobContext& job) {
  check_options(options);
  if (num_frames < 1) throw InvalidInput("a gap has at least one frame");
  if (before.num_frames() < 1 || after.num_frames() < 1) throw InvalidInput("there is no frame beside the gap");
  const auto most = std::max<Index>(2, std::lround(options.context / model.frame_time_secs()));
  GapShape shape{num_frames, std::min(most, before.num_frames()), std::min(most, after.num_frames()),
                 options.place_end};
  job.progress("looking at examples", 0);
  const Inbetweener inbetweener(model, shape, options);
  job.progress("looking at examples", 0.8);
  return inbetweener.fill(before, after, report);
}

}  // namespace motex
