// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/choreograph.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motex/core/options_check.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/choreography_plan.h"
#include "motex/motion_texture/choreography_stations.h"
#include "motex/motion_texture/jumps.h"

namespace motex {
namespace {

constexpr double kFar = 2;           // usual jump distances
constexpr double kDull = 0.04;       // of the mean speed of the examples
constexpr double kLeastWorth = 0.6;  // of a second of liveliness, in transitions: the first that is tried
constexpr int kLivelySteps = 6;
constexpr double kSliding = 3;                 // bending the way of the root against transitions
constexpr double kSlides = 1.5;                // a root that goes so much farther than its examples lets feet slide
constexpr std::uint64_t kMostVariations = 16;  // ways that are tried where the root has somewhere to go

PlanRequest plan_request(const Station& from, const Station& to, const ChoreographyOptions& options) {
  PlanRequest request;
  request.start = from.poses;
  request.end = to.poses;
  request.num_frames = to.frame + 2 - from.frame;
  request.stretch = options.stretch;
  request.nearness = options.nearness;
  return request;
}

/// The way from station to station. The likeliest dance keeps to slow parts, where everything is near everything:
/// lively examples are made cheaper until the dance is as lively as the mean of all examples. What a second of
/// liveliness is worth stays for other variations of the same stretch.
Plan plan_stretch(const ChoreographyPlanner& planner, const Station& from, const Station& to, PlanRequest& request,
                  const ChoreographyOptions& options, const JobContext& job) {
  try {
    Plan best = planner.plan(request, job);
    if (!options.lively || request.variation != 0) return best;
    double liveliness = planner.mean_liveliness(best), low = 0, high = 0;
    for (int k = 0; k < kLivelySteps && std::abs(liveliness) > kDull && (k > 0 || liveliness < 0); ++k) {
      const double worth = high > 0 ? 0.5 * (low + high) : kLeastWorth * std::exp2(k);
      PlanRequest other = request;
      other.liveliness = worth;
      Plan plan = planner.plan(other, job);
      const double now = planner.mean_liveliness(plan);
      (now < 0 ? low : high) = worth;
      if (std::abs(now) >= std::abs(liveliness)) continue;
      best = std::move(plan), liveliness = now, request.liveliness = worth;
    }
    return best;
  } catch (const InvalidInput& error) {
    throw InvalidInput(from.name + " to " + to.name + ": " + error.what());
  }
}

/// Plays a plan into the rows of `features` from the first of its stations on.
void play_stretch(const MotionTexture& model, const Plan& plan, const Station& from, const Station& to,
                  SegmentSynthesis& segments, FrameMatrix& features) {
  Index frame = from.frame;
  for (std::size_t k = 0; k < plan.segments.size(); ++k) {
    const Piece& piece = plan.segments[k].piece;
    const FrameMatrix first = k == 0 ? from.poses.features : poses_at(model, piece.first_row).features;
    const FrameMatrix last =
        k + 1 == plan.segments.size() ? to.poses.features : poses_at(model, piece.last_row).features;
    features.middleRows(frame, piece.length) = segments.play(piece, first, last);
    frame += piece.length - 2;
  }
}

void append(const Plan& plan, Index first_frame, ChoreographyReport& report) {
  Index start = first_frame;
  for (const PlannedSegment& s : plan.segments) {
    report.played.push_back({s.piece.texton, s.instance, start, s.piece.length, s.piece.source_row,
                             s.piece.source_length, s.first_distance, s.last_distance});
    start += s.piece.length - 2;
  }
  report.log_prob += plan.log_prob;
  report.cost += plan.cost;
}

/// A dance before it is decoded.
struct Take {
  FrameMatrix features;
  ChoreographyReport report;
};

Take play_take(const MotionTexture& model, const ChoreographyPlanner& planner, const std::vector<Station>& stations,
               std::vector<PlanRequest>& requests, const ChoreographyOptions& options, std::uint64_t variation,
               const JobContext& job) {
  Take take;
  take.features.resize(stations.back().frame + 2, model.features.size());
  SegmentSynthesis segments(model, options);
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    requests[k].variation = variation;
    const Plan plan = plan_stretch(planner, stations[k], stations[k + 1], requests[k], options, job);
    play_stretch(model, plan, stations[k], stations[k + 1], segments, take.features);
    append(plan, stations[k].frame, take.report);
    if (k == 0) take.report.start_distance = plan.start_distance;
    take.report.end_distance = plan.end_distance;
  }
  return take;
}

/// Bends the way of the root to the places asked for and around boxes.
void bend_take(const MotionTexture& model, const ChoreographyRequest& request, const std::vector<Station>& stations,
               RootPlace start, const ChoreographyOptions& options, Take& take) {
  std::vector<Index> fixed;
  for (const Station& station : stations) fixed.insert(fixed.end(), {station.frame, station.frame + 1});
  RootPath path = root_path(model.features, take.features, start);
  take.report.path = bend_root_path(path, model.frame_time_secs(), model.features.cm_per_unit, request.at,
                                    request.avoid, fixed, options.path);
  if (take.report.path.cost > 0) set_root_path(model.features, path, take.features);
}

/// The take in which examples and the bending of their way together cost least. Where the root has nowhere to go: the
/// cheapest plan.
Take best_take(const MotionTexture& model, const ChoreographyRequest& request, const std::vector<Station>& stations,
               RootPlace start, const ChoreographyOptions& options, const JobContext& job) {
  const ChoreographyPlanner planner(model);
  std::vector<PlanRequest> requests;
  for (std::size_t k = 0; k + 1 < stations.size(); ++k)
    requests.push_back(plan_request(stations[k], stations[k + 1], options));
  if (request.at.empty() && request.avoid.empty())
    return play_take(model, planner, stations, requests, options, 0, job);
  Take best;
  std::string failure;
  const auto cost = [](const Take& take) { return take.report.cost + kSliding * take.report.path.cost; };
  for (std::uint64_t variation = 0; variation < kMostVariations; ++variation) {
    Take take = play_take(model, planner, stations, requests, options, variation, job);
    job.progress("dancing", static_cast<double>(variation + 1) / static_cast<double>(kMostVariations));
    try {
      bend_take(model, request, stations, start, options, take);
    } catch (const InvalidInput& error) {
      if (failure.empty()) failure = error.what();
      continue;
    }
    if (best.features.size() == 0 || cost(take) < cost(best)) best = std::move(take);
  }
  if (best.features.size() == 0) throw InvalidInput(failure);
  return best;
}

void warn_when_far(const MotionTexture& model, const ChoreographyReport& report, const JobContext& job) {
  const double far = kFar * usual_jump_distance(model);
  const auto cm = [](double distance) { return std::to_string(std::lround(distance)) + " cm"; };
  const auto check = [&](const std::string& which, double bent, double from_model) {
    if (bent <= far) return;
    std::string nearest;
    if (from_model > 0) nearest = " (of all poses in the model the nearest is " + cm(from_model) + " away)";
    job.warn("the " + which + " poses are " + cm(bent) + " from those of the nearest example that fits" + nearest +
             "; it was bent to them");
  };
  check("start", report.start_distance, report.start_from_model);
  check("end", report.end_distance, report.end_from_model);
  if (report.path.way > kSlides || report.path.way < 1 / kSlides)
    job.warn("to be there in time the root goes " + std::to_string(report.path.way).substr(0, 4) +
             " times as far as in the examples; feet may slide");
}

}  // namespace

Clip choreograph(const MotionTexture& model, const ChoreographyRequest& request, const ChoreographyOptions& options,
                 ChoreographyReport& report, const JobContext& job) {
  check_options(options);
  const std::vector<Station> stations = stations_of(model, request);
  const RootPlace start = request.place       ? *request.place
                          : request.first_two ? request.first_two->place
                                              : place_at(model, stations[0].poses.row);
  Take take = best_take(model, request, stations, start, options, job);
  report = std::move(take.report);
  if (request.first_two) report.start_from_model = distance_from_model(model, stations.front().poses.features);
  if (request.last_two) report.end_from_model = distance_from_model(model, stations.back().poses.features);
  std::vector<Index> pinned;
  for (const Station& station : stations) pinned.insert(pinned.end(), {station.frame, station.frame + 1});
  for (const RootTarget& target : request.at) pinned.push_back(target.frame);
  Clip clip = decode(model.features, take.features, start);
  clip.name = "choreography";
  if (options.foot_fix && !model.feet.legs.empty()) fix_feet(clip, model.feet, {}, pinned);
  if (options.floor_fix) report.floor = keep_above_floor(clip, model.feet, pinned);
  report.reached = reach_targets(clip, request.reach, options.reach, pinned, job);
  warn_when_far(model, report, job);
  return clip;
}

}  // namespace motex
