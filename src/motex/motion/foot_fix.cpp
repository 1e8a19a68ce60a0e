// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/foot_fix.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/motion/foot_fix_solver.h"
#include "motex/motion/whole_clip.h"

namespace motex {
namespace {

/// The body follows the mean correction of the feet this far: less bending of the knees, no more shaking of the body.
constexpr double kPelvisShare = 0.15;
/// A foot in the air at kFastSpeed, cm/s, keeps its correction for about kFastHoldSecs.
constexpr double kFastSpeed = 300, kFastHoldSecs = 0.2;

using LegMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic>;

void check_model(const FootModel& model, const Skeleton& skeleton) {
  const auto parent = [&](int j) { return skeleton.joints[static_cast<std::size_t>(j)].parent_idx; };
  const int joints = skeleton.num_joints();
  bool good = model.pelvis_idx >= 0 && model.pelvis_idx < joints;
  for (const Leg& leg : model.legs)
    good = good && leg.ankle_idx > 0 && leg.ankle_idx < joints && parent(leg.ankle_idx) == leg.knee_idx &&
           leg.knee_idx > 0 && parent(leg.knee_idx) == leg.hip_idx && leg.hip_idx >= 0;
  if (!good) throw InvalidInput("the foot model belongs to another skeleton: its legs are not in this one");
}

/// Joints on the way from the roots to the ankles, parents first.
std::vector<int> leg_chains(const FootModel& model, const Skeleton& skeleton) {
  std::vector<bool> used(skeleton.joints.size(), false);
  for (const Leg& leg : model.legs)
    for (int j = leg.ankle_idx; j >= 0; j = skeleton.joints[static_cast<std::size_t>(j)].parent_idx)
      used[static_cast<std::size_t>(j)] = true;
  std::vector<int> chain;
  for (int j = 0; j < skeleton.num_joints(); ++j)
    if (used[static_cast<std::size_t>(j)]) chain.push_back(j);
  return chain;
}

}  // namespace

struct FootFixer::State {
  FootModel model;
  FootFixOptions options;
  double dt;
  Index delay, horizon;
  std::vector<int> parents, chain;
  Clip ring;               // the frames between input and output; frame t is in row t mod capacity
  FrameMatrix points;      // ring rows × 6·legs: ankle and toe in the world
  ContactMatrix contacts;  // ring rows × 2·legs
  std::vector<std::uint8_t> pinned;
  std::vector<ContactDetector> detectors;
  Index pushed = 0, popped = 0;
  bool finished = false;
  LegMatrix last, before_last;  // corrections of the two frames given out last, a column per leg
  FrameMatrix out_points;       // as points, of the last frame given out
  std::vector<std::uint8_t> out_contacts;
  CorrectionSolver solver;
  Pose pose;
  FootFixReport sums;
  double sum_correction = 0, sum_before = 0, sum_after = 0;
  Index num_contact_steps = 0;

  State(const FootModel& feet, const Skeleton& skeleton, double frame_time_secs, const FootFixOptions& fix);
  Index num_legs() const { return static_cast<Index>(model.legs.size()); }
  Index capacity() const { return ring.num_frames(); }
  Index row(Index frame) const { return frame % capacity(); }
  void push(const Clip& clip, Index frame, bool pin);
  void detect(Index frame, Index last_frame);
  bool pop(Clip& out, Index frame);
  void solve_corrections(LegMatrix& corrections);
  void find_pose(const Clip& clip, Index frame);
  void move_legs(const LegMatrix& corrections, Clip& out, Index frame);
  void count(const Clip& out, Index frame);
};

FootFixer::State::State(const FootModel& feet, const Skeleton& skeleton, double frame_time_secs,
                        const FootFixOptions& fix)
    : model(feet), options(fix), dt(frame_time_secs) {
  check_options(options);
  check_skeleton(skeleton);
  check_model(model, skeleton);
  model.begin_speed *= options.speed_factor;
  model.end_speed *= options.speed_factor;
  if (!(dt > 0)) throw InvalidInput("the frame time must be positive");
  const Index min_frames = std::max<Index>(1, std::lround(model.min_contact_secs / dt));
  delay = static_cast<Index>(options.lookahead / dt + 1e-9);
  delay = model.legs.empty() ? 0 : std::max(delay, min_frames + 1);
  // A contact is known min_frames after it began, by speeds that look one frame ahead.
  horizon = std::max<Index>(1, delay - min_frames + 1);
  for (const Joint& joint : skeleton.joints) parents.push_back(joint.parent_idx);
  chain = leg_chains(model, skeleton);
  ring = make_clip(skeleton, delay + 3, dt);
  points = FrameMatrix::Zero(capacity(), 6 * num_legs());
  contacts = ContactMatrix::Zero(capacity(), 2 * num_legs());
  pinned.assign(static_cast<std::size_t>(capacity()), 0);
  for (const Leg& leg : model.legs)
    for (const int point : {kAnkle, kToe}) detectors.push_back(make_contact_detector(model, leg, point, dt));
  last = before_last = LegMatrix::Zero(3, num_legs());
  out_points = FrameMatrix::Zero(1, 6 * num_legs());
  out_contacts.assign(static_cast<std::size_t>(2 * num_legs()), 0);
  solver.resize(horizon);
  pose.positions.setZero(3, skeleton.num_joints());
  pose.rotations.setZero(4, skeleton.num_joints());
}

/// World pose of the joints on the way to the ankles.
void FootFixer::State::find_pose(const Clip& clip, Index frame) {
  for (const int j : chain) {
    const int parent = parents[static_cast<std::size_t>(j)];
    const Quat above = parent < 0 ? Quat::Identity() : pose.rotation(parent);
    pose.positions.col(j) = above * clip.translation(frame, j);
    if (parent >= 0) pose.positions.col(j) += pose.positions.col(parent);
    pose.rotations.col(j) = (above * clip.rotation(frame, j)).coeffs();
  }
}

void FootFixer::State::push(const Clip& clip, Index frame, bool pin) {
  if (clip.rotations.cols() != ring.rotations.cols())
    throw InvalidInput(clip.name + ": the clip's skeleton is not the one that the feet are held for");
  if (finished || pushed - popped >= capacity()) throw InvalidInput("frames must be popped before more are pushed");
  const Index r = row(pushed);
  ring.translations.row(r) = clip.translations.row(frame);
  ring.rotations.row(r) = clip.rotations.row(frame);
  pinned[static_cast<std::size_t>(r)] = pin ? 1 : 0;
  contacts.row(r).setZero();
  find_pose(ring, r);
  for (Index l = 0; l < num_legs(); ++l) {
    const Leg& leg = model.legs[static_cast<std::size_t>(l)];
    const Vector3 ankle = pose.positions.col(leg.ankle_idx);
    points.block<1, 3>(r, 6 * l) = ankle.transpose();
    points.block<1, 3>(r, 6 * l + 3) = (ankle + pose.rotation(leg.ankle_idx) * leg.toe_offset).transpose();
  }
  ++pushed;
  if (pushed >= 2) detect(pushed - 2, pushed - 1);
}

/// As detect_contacts, with the speeds times options.speed_factor.
void FootFixer::State::detect(Index frame, Index last_frame) {
  const Index a = std::max<Index>(frame - 1, 0), b = std::min(frame + 1, last_frame);
  if (a == b) return;
  for (Index c = 0; c < contacts.cols(); ++c) {
    const double speed = std::hypot(points(row(b), 3 * c) - points(row(a), 3 * c),
                                    points(row(b), 3 * c + 2) - points(row(a), 3 * c + 2)) /
                         (static_cast<double>(b - a) * dt);
    const int planted = detectors[static_cast<std::size_t>(c)].push(points(row(frame), 3 * c + 1), speed);
    for (int back = 0; back < planted; ++back) contacts(row(frame - back), c) = 1;
  }
}

/// The first step of the smoothest way to hold each foot through the frames that are in sight (CorrectionSolver).
void FootFixer::State::solve_corrections(LegMatrix& corrections) {
  const Index frames = std::min(horizon, pushed - popped);
  const double limit = options.max_correction / model.cm_per_unit;
  for (Index l = 0; l < num_legs(); ++l) {
    const double excess = last.col(l).squaredNorm() / (limit * limit);
    const double hold = options.hold * options.hold / (1 + excess * excess);
    for (Index s = 0; s < frames; ++s) {
      const Index t = popped + s, now = row(t), before = row(t + capacity() - 1);
      double weight = 0;
      Eigen::Vector2d slide = Eigen::Vector2d::Zero();
      for (Index p = 2 * l; t > 0 && p < 2 * l + 2; ++p) {
        if (contacts(now, p) == 0 || contacts(before, p) == 0) continue;
        const Eigen::Vector2d step(points(now, 3 * p) - points(before, 3 * p),
                                   points(now, 3 * p + 2) - points(before, 3 * p + 2));
        weight += 1;
        slide += step;
      }
      if (weight > 0) {
        solver.step(s) = {hold * weight / (dt * dt), slide / weight, false};
      } else {
        // A correction that changes while the foot is fast would make its fastest step faster.
        const double speed =
            t > 0 ? (points.block<1, 3>(now, 6 * l) - points.block<1, 3>(before, 6 * l)).norm() / dt : 0;
        const double secs = kFastHoldSecs * speed * model.cm_per_unit / kFastSpeed;
        solver.step(s) = {secs * secs / (dt * dt), slide, false};
      }
      solver.step(s).pinned = pinned[static_cast<std::size_t>(now)] != 0;
    }
    const double bend = std::pow(options.ease / dt, 4);
    const Eigen::Vector2d first =
        solver.solve(frames, bend, {last(0, l), last(2, l)}, {before_last(0, l), before_last(2, l)});
    corrections.col(l) = Vector3(first[0], 0, first[1]);
  }
}

void FootFixer::State::move_legs(const LegMatrix& corrections, Clip& out, Index frame) {
  find_pose(out, frame);
  const Vector3 shift = kPelvisShare * corrections.rowwise().mean();
  double lower = 0, slope = 0;
  for (Index l = 0; l < num_legs(); ++l) {
    const Leg& leg = model.legs[static_cast<std::size_t>(l)];
    const LegSolution leg_now = solve_leg(pose, leg, shift, corrections.col(l));
    lower += leg_now.missing * leg_now.steepness;
    slope += leg_now.steepness * leg_now.steepness;
  }
  const Vector3 body = shift - Vector3(0, slope > 0.1 ? lower / slope : 0, 0);
  const int above = parents[static_cast<std::size_t>(model.pelvis_idx)];
  const Vector3 body_in_parent = above < 0 ? body : Vector3(pose.rotation(above).conjugate() * body);
  out.set_translation(frame, model.pelvis_idx, out.translation(frame, model.pelvis_idx) + body_in_parent);
  for (Index l = 0; l < num_legs(); ++l) {
    const Leg& leg = model.legs[static_cast<std::size_t>(l)];
    const LegSolution solved = solve_leg(pose, leg, body, corrections.col(l));
    const int over = parents[static_cast<std::size_t>(leg.hip_idx)];
    const Quat base = over < 0 ? Quat::Identity() : pose.rotation(over);
    out.set_rotation(frame, leg.hip_idx, (base.conjugate() * solved.thigh).normalized());
    out.set_rotation(frame, leg.knee_idx, (solved.thigh.conjugate() * solved.shank).normalized());
    out.set_rotation(frame, leg.ankle_idx, (solved.shank.conjugate() * pose.rotation(leg.ankle_idx)).normalized());
  }
}

bool FootFixer::State::pop(Clip& out, Index frame) {
  if (popped >= pushed || (!finished && popped + delay >= pushed)) return false;
  if (out.rotations.cols() != ring.rotations.cols())
    throw InvalidInput(out.name + ": the clip's skeleton is not the one that the feet are held for");
  const Index r = row(popped);
  out.translations.row(frame) = ring.translations.row(r);
  out.rotations.row(frame) = ring.rotations.row(r);
  if (num_legs() > 0) {
    LegMatrix& corrections = before_last;  // its old values are used up by the solver, leg by leg
    solve_corrections(corrections);
    if (pinned[static_cast<std::size_t>(r)] != 0) corrections.setZero();
    before_last.swap(last);
    if (last.cwiseAbs().maxCoeff() > 1e-9) move_legs(last, out, frame);
    count(out, frame);
  }
  ++popped;
  return true;
}

void FootFixer::State::count(const Clip& out, Index frame) {
  find_pose(out, frame);
  const Index r = row(popped), before = row(popped + capacity() - 1);
  for (Index l = 0; l < num_legs(); ++l) {
    const Leg& leg = model.legs[static_cast<std::size_t>(l)];
    const Vector3 ankle = pose.positions.col(leg.ankle_idx);
    const Vector3 place[2] = {ankle, ankle + pose.rotation(leg.ankle_idx) * leg.toe_offset};
    const double moved = (ankle.transpose() - points.block<1, 3>(r, 6 * l)).norm();
    sum_correction += moved;
    sums.max_correction = std::max(sums.max_correction, moved);
    for (Index p = 2 * l; p < 2 * l + 2; ++p) {
      const bool was = out_contacts[static_cast<std::size_t>(p)] != 0, is = contacts(r, p) != 0;
      sums.num_contacts += is && !was;
      const auto& now = place[p - 2 * l];
      if (is && was) {
        ++num_contact_steps;
        sum_before +=
            std::hypot(points(r, 3 * p) - points(before, 3 * p), points(r, 3 * p + 2) - points(before, 3 * p + 2));
        sum_after += std::hypot(now.x() - out_points(0, 3 * p), now.z() - out_points(0, 3 * p + 2));
      }
      out_contacts[static_cast<std::size_t>(p)] = is ? 1 : 0;
      out_points.block<1, 3>(0, 3 * p) = now.transpose();
    }
  }
  ++sums.num_frames;
}

FootFixer::FootFixer(const FootModel& model, const Skeleton& skeleton, double frame_time_secs,
                     const FootFixOptions& options)
    : state_(std::make_unique<State>(model, skeleton, frame_time_secs, options)) {}
FootFixer::~FootFixer() = default;
FootFixer::FootFixer(FootFixer&&) noexcept = default;

void FootFixer::push(const Clip& clip, Index frame, bool pinned) { state_->push(clip, frame, pinned); }
void FootFixer::finish() {
  if (!state_->finished && state_->pushed > 0) state_->detect(state_->pushed - 1, state_->pushed - 1);
  state_->finished = true;
}
bool FootFixer::pop(Clip& out, Index frame) { return state_->pop(out, frame); }
Index FootFixer::delay() const { return state_->delay; }

FootFixReport FootFixer::report() const {
  FootFixReport report = state_->sums;
  const auto legs_frames = static_cast<double>(report.num_frames * state_->num_legs());
  if (legs_frames > 0) report.mean_correction = state_->sum_correction / legs_frames;
  const double secs = static_cast<double>(state_->num_contact_steps) * state_->dt;
  if (secs > 0) report.contact_speed_before = state_->sum_before / secs;
  if (secs > 0) report.contact_speed_after = state_->sum_after / secs;
  return report;
}

FootFixReport fix_feet(Clip& clip, const FootModel& model, const FootFixOptions& options,
                       std::span<const Index> pinned) {
  FootFixer fixer(model, clip.skeleton, clip.frame_time_secs, options);
  fix_whole_clip(fixer, clip, pinned);
  return fixer.report();
}

}  // namespace motex
