// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "motex/core/options_check.h"
#include "motex/motion/floor.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion/retime.h"
#include "motex/motion_texture/choreography_plan.h"
#include "motex/motion_texture/liveliness.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/placing.h"

namespace motex {
namespace {

constexpr int kCandidates = 24;
constexpr double kFarCm = 40, kFarTurn = 0.5;  // a way that must be bent by this costs 1
constexpr double kLiveliness = 8;              // cost of e times more or less movement than usual
constexpr double kSettleSecs = 4;              // after which held feet have forgotten how the motion began

/// First rows of instances from which a loop may begin: drawn without repetition.
std::vector<Index> draw_starts(const MotionTexture& model, std::uint64_t seed) {
  std::vector<Index> rows;
  for (const Instance& instance : model.instances)
    if (instance.length >= 4) rows.push_back(instance.row);
  if (rows.empty()) throw InvalidInput("the model has no example of 4 frames");
  Rng rng = Rng(seed).fork(3);
  const std::size_t count = std::min<std::size_t>(rows.size(), kCandidates);
  for (std::size_t k = 0; k < count; ++k) std::swap(rows[k], rows[k + rng.below(rows.size() - k)]);
  rows.resize(count);
  return rows;
}

ClipFrame clip_frame(const MotionTexture& model, Index row) {
  for (const Run& run : model.runs)
    if (row >= run.row && row < run.row + run.length)
      return {model.clip_names[static_cast<std::size_t>(run.clip_idx)], run.clip_start + row - run.row};
  throw InvalidInput("there is no row " + std::to_string(row) + " in the model");
}

/// Where the examples of a plan lead, each at its own length.
RootStep natural_step(const MotionTexture& model, const Plan& plan) {
  RootPlace place;
  const Vector& w = model.features.weights;
  for (const PlannedSegment& s : plan.segments)
    for (Index r = s.piece.source_row + 1; r < s.piece.source_row + s.piece.source_length - 1; ++r) {
      const double vx = static_cast<double>(model.corpus(r, 0)) / w[0],
                   vz = static_cast<double>(model.corpus(r, 1)) / w[1];
      place.x += std::cos(place.heading) * vx + std::sin(place.heading) * vz;
      place.z += -std::sin(place.heading) * vx + std::cos(place.heading) * vz;
      place.heading += static_cast<double>(model.corpus(r, 3)) / w[3];
    }
  return root_step(model.features, {}, place);
}

/// Of a plan: how far its way must be bent, and how much less or more than usual it moves.
double loop_cost(const MotionTexture& model, const Plan& plan, const RootStep& step,
                 const ChoreographyPlanner& planner) {
  const RootStep leads = natural_step(model, plan);
  const double way = std::hypot(leads[0] - step[0], leads[1] - step[1]) / kFarCm;
  const double turn = std::remainder(leads[2] - step[2], 2 * std::numbers::pi) / kFarTurn;
  const double lively = std::log(std::max(1e-6, 1 + planner.mean_liveliness(plan)));
  return plan.cost + way * way + turn * turn + kLiveliness * lively * lively;
}

/// The drawn start from which a loop costs least.
Index cheapest_start(const MotionTexture& model, Index num_frames, const RootStep& step,
                     const ChoreographyOptions& options, const JobContext& job) {
  const ChoreographyPlanner planner(model);
  double least = std::numeric_limits<double>::infinity();
  Index best = -1;
  std::string refusal;
  const std::vector<Index> rows = draw_starts(model, options.seed);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    PlanRequest request;
    request.start = request.end = poses_at(model, rows[k]);
    request.num_frames = num_frames + 2;
    request.stretch = options.stretch;
    request.nearness = options.nearness;
    try {
      const double cost = loop_cost(model, planner.plan(request, job), step, planner);
      if (cost < least) least = cost, best = rows[k];
    } catch (const InvalidInput& error) {
      if (refusal.empty()) refusal = error.what();
    }
    job.progress("looking for a loop", 0.5 * static_cast<double>(k + 1) / static_cast<double>(rows.size()));
  }
  if (best < 0) throw InvalidInput("no loop of " + std::to_string(num_frames) + " frames: " + refusal);
  return best;
}

/// Largest second difference of a joint's position around frames first … first + count − 1.
double largest_bend(const FrameMatrix& positions, Index first, Index count) {
  double largest = 0;
  for (Index t = first; t < first + count; ++t)
    for (Index j = 0; j + 3 <= positions.cols(); j += 3)
      largest = std::max(largest, (positions.row(t - 1).segment<3>(j) - 2 * positions.row(t).segment<3>(j) +
                                   positions.row(t + 1).segment<3>(j))
                                      .norm());
  return largest;
}

double seam_ratio(const FeatureSpace& space, const Clip& loop, const RootStep& step) {
  const Index n = loop.num_frames();
  const FrameMatrix positions = world_positions(repeat_loop(space, loop, step, 2));
  const double inside = largest_bend(positions, 1, n - 2);
  return largest_bend(positions, n - 1, 2) / std::max(1e-12, inside);
}

/// Feet and floor as in an endless repetition.
Clip grounded(const MotionTexture& model, const Clip& loop, const RootStep& step, const ChoreographyOptions& options) {
  if (model.feet.legs.empty() || !(options.foot_fix || options.floor_fix)) return loop;
  const double secs = static_cast<double>(loop.num_frames()) * loop.frame_time_secs;
  const int before = static_cast<int>(std::ceil(kSettleSecs / secs));
  Clip rounds = repeat_loop(model.features, loop, step, 2 * before + 1);
  if (options.foot_fix) fix_feet(rounds, model.feet);
  if (options.floor_fix) keep_above_floor(rounds, model.feet);
  Clip out = slice(rounds, before * loop.num_frames(), loop.num_frames());
  RootPlace place = root_place(model.features, loop, 0);
  RootPlace there = place;
  for (int k = 0; k < before; ++k) there = place_after(model.features, there, step);
  // Turned back as the round stands, not by where its first frame was put by the feet.
  const RootPlace moved = root_place(model.features, out, 0);
  const RootStep off = root_step(model.features, there, moved);
  out = stand_at(model.features, out, place_after(model.features, place, off));
  out.name = loop.name;
  return out;
}

}  // namespace

Clip repeat_loop(const FeatureSpace& space, const Clip& loop, const RootStep& step, int rounds) {
  if (rounds < 1) throw InvalidInput("a loop is played at least once");
  const Index n = loop.num_frames();
  Clip out = make_held_clip(space, rounds * n);
  out.name = loop.name;
  RootPlace place = root_place(space, loop, 0);
  for (int k = 0; k < rounds; ++k) {
    const Clip round = k == 0 ? loop : stand_at(space, loop, place);
    out.translations.middleRows(k * n, n) = round.translations;
    out.rotations.middleRows(k * n, n) = round.rotations;
    place = place_after(space, place, step);
  }
  return out;
}

Clip loop_at_speed(const FeatureSpace& space, const Clip& loop, const RootStep& step, double speed) {
  if (!(speed >= 0.01 && speed <= 100)) throw InvalidInput("a clip is played at 0.01 to 100 times its speed");
  const auto n = static_cast<double>(loop.num_frames());
  const auto frames = std::max<Index>(1, std::llround(n / speed));
  const Clip rounds = repeat_loop(space, loop, step, 3);
  std::vector<double> moments;
  for (Index t = 0; t < frames; ++t) moments.push_back(n + n * static_cast<double>(t) / static_cast<double>(frames));
  Clip out = stand_at(space, retime(rounds, moments), root_place(space, loop, 0));
  out.name = loop.name;
  return out;
}

Clip synthesize_loop(const MotionTexture& model, Index num_frames, const RootStep& step,
                     const ChoreographyOptions& options, LoopReport& report, const JobContext& job) {
  check_options(options);
  if (num_frames < 2 || num_frames > 100'000) throw InvalidInput("a loop has 2 to 100000 frames");
  if (!step.allFinite()) throw InvalidInput("the step of a loop must be finite");
  const Index row = cheapest_start(model, num_frames, step, options, job);
  ChoreographyRequest request;
  report = {};
  report.start = request.start = clip_frame(model, row);
  request.end = clip_frame(model, row + 1);
  request.num_frames = num_frames + 2;
  request.place = RootPlace{};
  const RootPlace end = place_after(model.features, {}, step);
  request.at = {{num_frames, end.x, end.z, end.heading}};
  ChoreographyOptions way = options;
  way.foot_fix = way.floor_fix = false;
  ChoreographyReport choreography;
  const Clip round = choreograph(model, request, way, choreography, job);
  report.played = choreography.played;
  report.cost = choreography.cost;
  Clip loop = slice(round, 0, num_frames);
  loop.name = "loop";
  loop = grounded(model, loop, step, options);
  report.seam_ratio = seam_ratio(model.features, loop, step);
  return loop;
}

}  // namespace motex
