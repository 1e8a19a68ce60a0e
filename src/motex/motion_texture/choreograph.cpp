// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/choreograph.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/options_check.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/choreography_plan.h"
#include "motex/motion_texture/jumps.h"

namespace motex {
namespace {

constexpr std::size_t kMostListed = 12;
constexpr double kFar = 2;  // usual jump distances

std::string stem(const std::string& name) { return name.substr(0, name.rfind('.')); }

int find_clip(const MotionTexture& model, const std::string& name) {
  const auto& names = model.clip_names;
  for (const bool whole : {true, false}) {
    std::vector<int> found;
    for (std::size_t c = 0; c < names.size(); ++c)
      if (whole ? names[c] == name : stem(names[c]) == stem(name)) found.push_back(static_cast<int>(c));
    if (found.size() > 1) throw InvalidInput("the model has " + std::to_string(found.size()) + " clips named " + name);
    if (found.size() == 1) return found[0];
  }
  std::string list;
  for (std::size_t c = 0; c < std::min(names.size(), kMostListed); ++c) list += (c > 0 ? ", " : "") + names[c];
  if (names.size() > kMostListed) list += " … (" + std::to_string(names.size()) + " in all)";
  throw InvalidInput("the model has no clip " + name + "; it has " + list);
}

std::string described(const ClipFrame& pose) { return pose.clip + "@" + std::to_string(pose.frame); }

/// Corpus row at which the pair of frames begins whose frame number `offset` (0 or 1) is the pose.
Index pair_row(const MotionTexture& model, const ClipFrame& pose, Index offset) {
  const Index row = corpus_row(model, pose) - offset;
  for (const Run& run : model.runs)
    if (row >= run.row && row + 2 <= run.row + run.length) return row;
  throw InvalidInput(described(pose) + (offset == 0 ? ": no frame that was learned from follows it; take the one before"
                                                    : ": no frame that was learned from precedes it; take the next"));
}

/// Where the body stands in its clip at a row.
RootPlace place_at(const MotionTexture& model, Index row) {
  const Instance& instance = model.instances[static_cast<std::size_t>(instance_at(model, row))];
  RootPlace place = instance.place;
  Clip pose = make_held_clip(model.features, 1);
  for (Index r = instance.row + 1; r <= row; ++r) {
    const Vector features = model.corpus.row(r).transpose().cast<double>();
    decode_frame(model.features, features.data(), false, place, pose, 0);
  }
  return place;
}

/// A pose to be met.
struct Station {
  PlanPoses poses;
  Index frame = 0;  ///< of the output
  std::string name;
};

/// Start and end included.
std::vector<Station> stations_of(const MotionTexture& model, const ChoreographyRequest& request) {
  constexpr Index kMostFrames = 1'000'000;
  if (request.num_frames < 2 || request.num_frames > kMostFrames)
    throw InvalidInput("a choreography has 2 to 1000000 frames");
  std::vector<Station> out;
  const auto add = [&](const ClipFrame& pose, const std::optional<PosePair>& pair, Index frame, Index offset) {
    if (pair) {
      if (pair->features.rows() != 2 || pair->features.cols() != model.features.size() || !pair->features.allFinite())
        throw InvalidInput(pair->name + ": poses are 2 finite rows of the model's features");
      out.push_back({{pair->features, -1}, frame, pair->name});
    } else {
      out.push_back({poses_at(model, pair_row(model, pose, offset)), frame, described(pose)});
    }
  };
  add(request.start, request.first_two, 0, 0);
  for (const auto& via : request.via) {
    if (via.frame <= out.back().frame || via.frame >= request.num_frames - 2)
      throw InvalidInput(described(via.pose) + ": frame " + std::to_string(via.frame) +
                         " is not after the pose before it and before the end, frame " +
                         std::to_string(request.num_frames - 2));
    add(via.pose, {}, via.frame, 0);
  }
  add(request.end, request.last_two, request.num_frames - 2, 1);
  return out;
}

Plan plan_stretch(const ChoreographyPlanner& planner, const Station& from, const Station& to,
                  const ChoreographyOptions& options, const JobContext& job) {
  PlanRequest request;
  request.start = from.poses;
  request.end = to.poses;
  request.num_frames = to.frame + 2 - from.frame;
  request.stretch = options.stretch;
  request.nearness = options.nearness;
  try {
    return planner.plan(request, job);
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

void warn_when_far(const MotionTexture& model, const ChoreographyReport& report, const JobContext& job) {
  const double far = kFar * usual_jump_distance(model);
  const auto check = [&](const char* which, double distance) {
    if (distance > far)
      job.warn(std::string("the ") + which + " poses are " + std::to_string(std::lround(distance)) +
               " cm from those of the nearest example that fits; it was bent to them");
  };
  check("start", report.start_distance);
  check("end", report.end_distance);
}

}  // namespace

Index corpus_row(const MotionTexture& model, const ClipFrame& pose) {
  const int clip = find_clip(model, pose.clip);
  const Index length = model.clip_lengths[static_cast<std::size_t>(clip)];
  if (pose.frame < 0 || pose.frame >= length)
    throw InvalidInput(described(pose) + ": the clip has frames 0 … " + std::to_string(length - 1));
  Index nearest = -1, least = std::numeric_limits<Index>::max();
  for (const Run& run : model.runs) {
    if (run.clip_idx != clip) continue;
    const Index inside = std::clamp(pose.frame, run.clip_start, run.clip_start + run.length - 1);
    if (inside == pose.frame) return run.row + pose.frame - run.clip_start;
    if (std::abs(inside - pose.frame) < least) least = std::abs(inside - pose.frame), nearest = inside;
  }
  throw InvalidInput(described(pose) +
                     ": this frame was left out of learning (the body jumps there, or the stretch is " + "too short)" +
                     (nearest >= 0 ? "; the nearest that was not is " + std::to_string(nearest) : ""));
}

PosePair pose_pair(const FeatureSpace& space, const Clip& clip, Index frame) {
  if (frame < 0 || frame + 2 > clip.num_frames())
    throw InvalidInput(clip.name + ": has no frames " + std::to_string(frame) + " and " + std::to_string(frame + 1));
  const Index before = std::min<Index>(frame, 1);  // the step into the first frame
  return {clip.name + "@" + std::to_string(frame), encode(space, slice(clip, frame - before, before + 2)).bottomRows(2),
          root_place(space, clip, frame)};
}

Clip choreograph(const MotionTexture& model, const ChoreographyRequest& request, const ChoreographyOptions& options,
                 ChoreographyReport& report, const JobContext& job) {
  check_options(options);
  const std::vector<Station> stations = stations_of(model, request);
  const ChoreographyPlanner planner(model);
  report = {};
  SegmentSynthesis segments(model, options);
  FrameMatrix features(request.num_frames, model.features.size());
  std::vector<Index> pinned;
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    const Plan plan = plan_stretch(planner, stations[k], stations[k + 1], options, job);
    play_stretch(model, plan, stations[k], stations[k + 1], segments, features);
    append(plan, stations[k].frame, report);
    if (k == 0) report.start_distance = plan.start_distance;
    report.end_distance = plan.end_distance;
    job.progress("dancing", static_cast<double>(k + 1) / static_cast<double>(stations.size()));
  }
  for (const Station& station : stations) pinned.insert(pinned.end(), {station.frame, station.frame + 1});
  const RootPlace start = request.first_two ? request.first_two->place : place_at(model, stations[0].poses.row);
  Clip clip = decode(model.features, features, request.place.value_or(start));
  clip.name = "choreography";
  if (options.foot_fix && !model.feet.legs.empty()) fix_feet(clip, model.feet, {}, pinned);
  warn_when_far(model, report, job);
  return clip;
}

}  // namespace motex
