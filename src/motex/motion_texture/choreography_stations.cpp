// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/choreography_stations.h"

#include <algorithm>
#include <limits>

namespace motex {
namespace {

constexpr std::size_t kMostListed = 12;

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

}  // namespace motex
