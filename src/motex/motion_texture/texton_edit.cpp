// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_edit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "motex/core/options_check.h"
#include "motex/lds/pinned_path.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion/keep_feet.h"
#include "motex/motion_texture/segment_synthesis.h"
#include "motex/motion_texture/texton_stretch.h"

namespace motex {
namespace {

constexpr Index kHeight = 2, kTilt = 4, kRootChannels = 6;
constexpr double kLargeStrain = 5, kNoNoise = 1e-12;
constexpr double kNothing = 1e-9;  // cm
constexpr double kPriorFrames = 300, kLeastMovement = 0.5;

/// Rows of the corpus that follow one another.
struct Stretch {
  Index row = 0, length = 0;
};

/// Channels that are edited together.
struct Part {
  std::string name;
  Index first = 0, count = 0;
  std::map<Index, Vector> wanted;  ///< frame → weighted features
};

class Editor {
 public:
  Editor(const MotionTexture& model, const Instance& instance, FrameMatrix base)
      : model_(model), instance_(instance), features_(std::move(base)) {}

  void add(const PoseEdit& edit);
  const FrameMatrix& unedited() const { return features_; }
  /// The edited features.
  FrameMatrix solve(EditReport& report) const;
  std::vector<Index> pinned_frames() const;
  /// The body alone was moved on its legs, which stand where they stood.
  bool moves_on_legs() const;

 private:
  void want(const std::string& name, Index first, const Vector& value, Index frame);
  void want_rotation(const PoseEdit& edit);
  void want_pose(const PoseEdit& edit);
  void want_vector(std::size_t joint, const Quat& relative, Index frame);
  Lds dynamics(const Part& part) const;
  bool moves_feet(Index first) const;
  Vector change_of(const Part& part, Index frame) const {
    return part.wanted.at(frame) - features_.row(frame).segment(part.first, part.count).transpose();
  }
  Vector3 vector_at(Index frame, Index first) const {
    return features_.row(frame).segment<3>(first).transpose().cwiseQuotient(space().weights.segment<3>(first));
  }
  const FeatureSpace& space() const { return model_.features; }

  const MotionTexture& model_;
  const Instance& instance_;
  FrameMatrix features_;         ///< y₀
  std::map<Index, Part> parts_;  ///< by first channel
};

void Editor::want(const std::string& name, Index first, const Vector& value, Index frame) {
  Part& part = parts_[first];
  part.name = name, part.first = first, part.count = value.size();
  if (!value.allFinite())
    throw InvalidInput("the edit of " + name + " at frame " + std::to_string(frame) + " is not finite");
  if (!part.wanted.emplace(frame, value.cwiseProduct(space().weights.segment(first, value.size()))).second)
    throw InvalidInput(name + " is edited twice at frame " + std::to_string(frame));
}

/// The joint's q_ref⁻¹ q, as the exponential map nearest to what it was.
void Editor::want_vector(std::size_t joint, const Quat& relative, Index frame) {
  const Index first = kRootChannels + 3 * static_cast<Index>(joint);
  const int j = space().joints[joint];
  want(space().skeleton.joints[static_cast<std::size_t>(j)].name, first,
       log_map_near(relative, vector_at(frame, first)), frame);
}

void Editor::want_rotation(const PoseEdit& edit) {
  const auto& joints = space().joints;
  const auto num_joints = space().skeleton.num_joints();
  if (edit.joint < 0 || edit.joint >= num_joints)
    throw InvalidInput("there is no joint " + std::to_string(edit.joint) + " to edit");
  const std::string& name = space().skeleton.joints[static_cast<std::size_t>(edit.joint)].name;
  if (edit.joint == space().travelling_joint)
    throw InvalidInput(name +
                       " carries the body: edit its height or tilt, its place and heading follow from the steps");
  const auto found = std::find(joints.begin(), joints.end(), edit.joint);
  if (found == joints.end()) throw InvalidInput(name + " does not move in the model and cannot be edited");
  const double norm = edit.rotation.norm();
  if (!(norm > 1e-9 && std::isfinite(norm))) throw InvalidInput("the rotation of " + name + " is none");
  const auto k = static_cast<std::size_t>(found - joints.begin());
  const double* r = &space().references(edit.joint, 0);
  const Quat reference(r[0], r[1], r[2], r[3]), given = edit.rotation.normalized();
  const Vector3 now = vector_at(edit.frame, kRootChannels + 3 * static_cast<Index>(k));
  const Quat rotation = edit.kind == EditKind::kSetJoint ? given : given * reference * exp_map(now);
  want_vector(k, reference.conjugate() * rotation, edit.frame);
}

void Editor::want_pose(const PoseEdit& edit) {
  if (edit.pose.size() != space().size())
    throw InvalidInput("a pose has " + std::to_string(space().size()) + " features, not " +
                       std::to_string(edit.pose.size()));
  const Vector y = edit.pose.cwiseQuotient(space().weights);
  want("height", kHeight, y.segment(kHeight, 1), edit.frame);
  want("tilt", kTilt, y.segment(kTilt, 2), edit.frame);
  for (std::size_t k = 0; k < space().joints.size(); ++k)
    want_vector(k, exp_map(y.segment<3>(kRootChannels + 3 * static_cast<Index>(k))), edit.frame);
}

void Editor::add(const PoseEdit& edit) {
  const Index l = features_.rows();
  if (edit.frame < 2 || edit.frame > l - 3)
    throw InvalidInput("frame " + std::to_string(edit.frame) + " cannot be edited: frames 2 … " +
                       std::to_string(l - 3) + " can, the two at each end do not move");
  const Vector now = features_.row(edit.frame).transpose().cwiseQuotient(space().weights);
  const bool moves = edit.kind == EditKind::kMoveHeight || edit.kind == EditKind::kMoveTilt;
  switch (edit.kind) {
    case EditKind::kSetJoint:
    case EditKind::kTurnJoint:
      return want_rotation(edit);
    case EditKind::kSetHeight:
    case EditKind::kMoveHeight:
      return want("height", kHeight,
                  Vector::Constant(1, edit.height + (moves ? now[kHeight] : -space().reference_height)), edit.frame);
    case EditKind::kSetTilt:
    case EditKind::kMoveTilt: {
      Vector tilt(2);
      tilt << edit.tilt_x, edit.tilt_z;
      if (moves) tilt += now.segment(kTilt, 2);
      return want("tilt", kTilt, tilt, edit.frame);
    }
    case EditKind::kSetPose:
      return want_pose(edit);
  }
}

/// Moments of single channels about their means, added up.
LdsStatistics pooled(const MotionTexture& model, Index first, Index count, std::span<const Stretch> stretches) {
  LdsStatistics sum(1);
  for (Index c = first; c < first + count; ++c) {
    const FrameMatrix channel = model.corpus.col(c).cast<double>();
    LdsStatistics statistics(1);
    for (const Stretch& s : stretches)
      if (s.length > 2) statistics.add(channel, s.row + 2, s.length - 2);
    const CentredMoments moments = centred(statistics);
    sum.moments.topLeftCorner<3, 3>() += moments.scatter;
    sum.moments(3, 3) += moments.count;
  }
  return sum;
}

/// The same of all that moves, from the states of the corpus.
LdsStatistics pooled_body(const MotionTexture& model) {
  const CentredMoments moments = centred(model.global_statistics);
  const Index d = moments.mean.size() / 3;
  LdsStatistics sum(1);
  for (Index a = 0; a < 3; ++a)
    for (Index b = 0; b < 3; ++b) sum.moments(a, b) = moments.scatter.block(a * d, b * d, d, d).trace();
  sum.moments(3, 3) = moments.count * static_cast<double>(d);
  return sum;
}

/// Dynamics of one channel of the part, all its channels taken together, so that a change goes straight to where it is
/// asked for. Prior: these channels in the whole corpus, and half a centimetre of what the whole body does, for parts
/// that hardly move.
Lds Editor::dynamics(const Part& part) const {
  std::vector<Stretch> all, own;
  for (const Run& run : model_.runs) all.push_back({run.row, run.length});
  for (const int i : model_.textons[static_cast<std::size_t>(instance_.texton)].instances)
    own.push_back(
        {model_.instances[static_cast<std::size_t>(i)].row, model_.instances[static_cast<std::size_t>(i)].length});
  const LdsPrior body = make_prior(pooled_body(model_), kPriorFrames);
  LdsPrior prior = make_prior(pooled(model_, part.first, part.count, all), kPriorFrames);
  prior.covariance += kLeastMovement * kLeastMovement / body.covariance(0, 0) * body.covariance;
  Lds lds = fit_lds(pooled(model_, part.first, part.count, own), prior);
  lds.offset.setZero();
  return lds;
}

FrameMatrix Editor::solve(EditReport& report) const {
  FrameMatrix out = features_;
  const Index l = out.rows();
  for (const auto& [first, part] : parts_) {
    EditedPart edited{part.name, {}, 0, 0};
    FrameMatrix change = FrameMatrix::Zero(l, part.count);
    std::vector<bool> pinned(static_cast<std::size_t>(l), false);
    for (const Index t : {Index{0}, Index{1}, l - 2, l - 1}) pinned[static_cast<std::size_t>(t)] = true;
    for (const auto& [frame, value] : part.wanted) {
      pinned[static_cast<std::size_t>(frame)] = true;
      change.row(frame) = change_of(part, frame).transpose();
      edited.frames.push_back(frame);
      edited.size = std::max(edited.size, change.row(frame).norm());
    }
    if (edited.size > kNothing) {
      const Lds lds = dynamics(part);
      double energy = 0;
      for (Index c = 0; c < part.count; ++c) {
        FrameMatrix channel = change.col(c);
        energy += least_noise_path(lds, pinned, channel);
        change.col(c) = channel;
      }
      edited.strain = std::sqrt(energy / static_cast<double>(part.count * std::ssize(part.wanted)));
      out.middleCols(first, part.count) += change;
      for (const auto& [frame, value] : part.wanted) out.row(frame).segment(first, part.count) = value.transpose();
    }
    report.parts.push_back(std::move(edited));
  }
  return out;
}

/// Frames that the foot pass must leave alone: the ends, and where legs or what carries them were edited.
std::vector<Index> Editor::pinned_frames() const {
  const Index l = features_.rows();
  std::vector<Index> frames{0, 1, l - 2, l - 1};
  for (const auto& [first, part] : parts_)
    for (const auto& [frame, value] : part.wanted)
      if (moves_feet(first) && !change_of(part, frame).isZero(kNothing)) frames.push_back(frame);
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

bool Editor::moves_on_legs() const {
  bool moves_body = false;
  for (const auto& [first, part] : parts_) {
    moves_body = moves_body || first < kRootChannels;
    if (first >= kRootChannels && moves_feet(first)) return false;
  }
  return moves_body;
}

bool Editor::moves_feet(Index first) const {
  if (first < kRootChannels) return true;
  const int joint = space().joints[static_cast<std::size_t>((first - kRootChannels) / 3)];
  const auto& joints = space().skeleton.joints;
  for (const Leg& leg : model_.feet.legs)
    for (int j = leg.ankle_idx; j >= 0; j = joints[static_cast<std::size_t>(j)].parent_idx)
      if (j == joint) return true;
  return false;
}

void warn_when_strained(const EditReport& report, const JobContext& job) {
  for (const EditedPart& part : report.parts) {
    if (part.strain <= kLargeStrain) continue;
    std::string frames;
    for (const Index frame : part.frames) frames += (frames.empty() ? "" : ", ") + std::to_string(frame);
    job.warn("the edit of " + part.name + " at frame " + frames + " is " + std::to_string(std::lround(part.strain)) +
             " times what this texton varies; it is met, but the way there is not one that was learned");
  }
}

}  // namespace

Clip edit_texton(const MotionTexture& model, int instance_idx, std::span<const PoseEdit> edits,
                 const EditOptions& options, EditReport& report, const JobContext& job) {
  check_options(options);
  check_instance(model, instance_idx);
  const Instance& instance = model.instances[static_cast<std::size_t>(instance_idx)];
  PlayOptions synthesis;
  synthesis.noise = options.noise > 0 ? options.noise : kNoNoise;
  synthesis.seed = options.seed;
  const Index end = instance.row + instance.length - 2;
  Editor editor(model, instance,
                SegmentSynthesis(model, synthesis)
                    .play({instance.texton, instance.row, instance.length, instance.row, end, instance.length}));
  for (const PoseEdit& edit : edits) editor.add(edit);
  report = {};
  Clip clip = decode(model.features, editor.solve(report), instance.place);
  clip.name = "texton";
  if (options.foot_fix && editor.moves_on_legs())
    keep_feet(decode(model.features, editor.unedited(), instance.place), model.feet, clip);
  if (options.foot_fix && !model.feet.legs.empty()) fix_feet(clip, model.feet, {}, editor.pinned_frames());
  warn_when_strained(report, job);
  return clip;
}

}  // namespace motex
