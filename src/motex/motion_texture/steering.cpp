// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/steering.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "motex/core/options_check.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/instance_walk.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/segment_synthesis.h"
#include "motex/motion_texture/texton_paths.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReplanSecs = 0.5;      // a rest shorter than this is played to its end
constexpr double kTurnGainPerSec = 2.5;  // of the angle that is left
constexpr double kTurnRampSecs = 0.25;   // from rest to the fastest turn
constexpr double kStandingCm = 1.5;      // feet this much higher than the lower one carry 1/e of the weight
constexpr double kNoWayCm = 8;           // ways shorter than this hardly have a direction
constexpr double kFacingAngle = kPi / 4;

double wrap(double angle) { return std::remainder(angle, 2 * kPi); }

/// Goes on from `a` (in its heading frame) by what comes after it.
Excursion joined(const Excursion& a, const Excursion& b) {
  const double c = std::cos(a.turn), s = std::sin(a.turn);
  return {a.x + c * b.x + s * b.z, a.z - s * b.x + c * b.z, a.turn + b.turn, a.secs + b.secs};
}

/// From row to row of weighted features: the step into row `features`.
template <typename Row>
Excursion step_of(const FeatureSpace& space, const Row& features) {
  const Vector& w = space.weights;
  return {static_cast<double>(features[0]) / w[0], static_cast<double>(features[1]) / w[1],
          static_cast<double>(features[3]) / w[3], space.frame_time_secs};
}

double length(const Excursion& e) { return std::hypot(e.x, e.z); }
double angle(const Excursion& e) { return std::atan2(e.x, e.z); }

}  // namespace

Excursion excursion(const MotionTexture& model, int instance) {
  const Instance& a = model.instances[static_cast<std::size_t>(instance)];
  Excursion sum;
  for (Index r = a.row + 1; r < hand_over_row(model, a) + 2; ++r)
    sum = joined(sum, step_of(model.features, model.corpus.row(r)));
  return sum;
}

struct SteeredSynthesizer::State {
  State(const MotionTexture& m, const SynthesizeOptions& options, const SteerOptions& steer_options)
      : model(m),
        steer(steer_options),
        walk(m, options, {}, true),
        segments(m, options),
        pose(make_held_clip(m.features, 1)) {
    if (options.foot_fix && !m.feet.legs.empty()) fixer.emplace(m.feet, m.features.skeleton, m.frame_time_secs());
    std::vector<double> speeds;
    for (int i = 0; i < static_cast<int>(m.instances.size()); ++i) {
      ways.push_back(excursion(m, i));
      speeds.push_back(length(ways.back()) / std::max(ways.back().secs, 1e-9));
    }
    const auto fast = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() * 9 / 10);
    std::nth_element(speeds.begin(), fast, speeds.end());
    usual_speed = std::max(*fast, 1e-9);
    coming = walk.next();
    place = m.instances[static_cast<std::size_t>(coming)].place;
    advance();
  }

  void advance();
  void replan();
  void take_rows(const FrameMatrix& played);
  void make();
  void turn();
  double taste(int instance, const Excursion& before) const;
  Vector3 standing_point();
  bool is_steered() const { return wanted.direction || wanted.facing || wanted.speed; }
  double units_per_m() const { return 100 / model.features.cm_per_unit; }
  void choose_after(const Excursion& before) {
    if (is_steered())
      coming = walk.next([&](int b) { return taste(b, before); });
    else
      coming = walk.next();
  }
  Index paced(Index length) const { return std::max<Index>(4, std::lround(static_cast<double>(length) / wanted.pace)); }

  const MotionTexture& model;
  SteerOptions steer;
  Steering wanted;
  InstanceWalk walk;
  SegmentSynthesis segments;
  std::optional<FootFixer> fixer;
  Clip pose;
  Pose world;
  std::vector<Excursion> ways;  ///< by instance
  double usual_speed = 1;       ///< v₀, units/s

  int playing = -1, coming = -1;
  Index source_end = 0;         ///< corpus row behind the last of the example that is played
  FrameMatrix rows;             ///< features of the example that is played
  std::vector<Excursion> left;  ///< by row: from there to the end of rows
  Index row = 0, end = 0, num_made = 0;
  bool should_replan = false;
  RootPlace place;
  double turn_rate = 0;  ///< rad/s
  std::vector<PlayedTexton> begun;
};

void SteeredSynthesizer::State::take_rows(const FrameMatrix& played) {
  rows = played;
  row = 0, end = rows.rows() - 2;
  left.assign(static_cast<std::size_t>(rows.rows()), {});
  for (Index r = rows.rows() - 1; r-- > 0;)
    left[static_cast<std::size_t>(r)] =
        joined(step_of(model.features, rows.row(r + 1)), left[static_cast<std::size_t>(r) + 1]);
}

void SteeredSynthesizer::State::advance() {
  playing = coming;
  const Instance& a = model.instances[static_cast<std::size_t>(playing)];
  choose_after(ways[static_cast<std::size_t>(playing)]);
  source_end = hand_over_row(model, a) + 2;
  const Index l = source_end - a.row;
  take_rows(
      segments.play({a.texton, a.row, l, a.row, model.instances[static_cast<std::size_t>(coming)].row, paced(l)}));
  begun.push_back({a.texton, playing, num_made, end});
}

/// The rest of the example leads to another one than was planned.
void SteeredSynthesizer::State::replan() {
  should_replan = false;
  const Index rest = rows.rows() - row + 2;
  if (row < 2 || static_cast<double>(rest) * model.frame_time_secs() < kReplanSecs + 4 * model.frame_time_secs())
    return;
  const Instance& a = model.instances[static_cast<std::size_t>(playing)];
  const double share = static_cast<double>(rest) / static_cast<double>(rows.rows());
  const Index source_rest =
      std::clamp<Index>(std::lround(share * static_cast<double>(source_end - a.row)), 4, source_end - a.row);
  walk.take_back();
  choose_after(left[static_cast<std::size_t>(row - 1)]);
  const Index next_row = model.instances[static_cast<std::size_t>(coming)].row;
  const FrameMatrix first = rows.middleRows(row - 2, 2), last = model.corpus.middleRows(next_row, 2).cast<double>();
  const Index first_row = source_end - source_rest;
  take_rows(segments.play({a.texton, first_row, source_rest, first_row, next_row, rest}, first, last));
  row = 2;
  if (!begun.empty()) begun.back().length = num_made - begun.back().start + end - row;
}

/// u(b), to the exponential: `before` leads from here to where b would begin.
double SteeredSynthesizer::State::taste(int instance, const Excursion& before) const {
  const Excursion& way = ways[static_cast<std::size_t>(instance)];
  const double secs = std::max(way.secs, 1e-9), speed = length(way) / secs;
  const double could_turn = steer.max_turn * kPi / 180 * (0.5 * secs + 0.5 * before.secs);
  const auto angle_left = [&](double error) { return std::max(0.0, std::abs(wrap(error)) - could_turn); };
  const double start = place.heading + before.turn;
  double u = 0;
  if (wanted.direction) {
    const double error = angle_left(*wanted.direction - start - angle(way));
    const double along = speed * std::cos(error) / usual_speed, across = speed * std::sin(error) / usual_speed;
    const double speed_wanted = wanted.speed ? *wanted.speed * units_per_m() / usual_speed : 0;
    u = wanted.speed ? -(along - speed_wanted) * (along - speed_wanted) - across * across : along;
  } else if (wanted.speed) {
    const double off = (speed - *wanted.speed * units_per_m()) / usual_speed;
    u = -off * off;
  }
  if (wanted.facing && !wanted.direction) {
    const double error = angle_left(*wanted.facing - start - way.turn) / kFacingAngle;
    u -= error * error;
  }
  return std::exp(steer.pull * std::clamp(u, -2.0, 2.0));
}

/// Between the feet, near the one that stands; under the body where there are no feet.
Vector3 SteeredSynthesizer::State::standing_point() {
  if (model.feet.legs.empty()) return {place.x, 0, place.z};
  forward_kinematics(pose, 0, world);
  double low = 1e300, sum = 0;
  for (const Leg& leg : model.feet.legs) low = std::min(low, world.positions(1, leg.ankle_idx));
  Vector3 point = Vector3::Zero();
  for (const Leg& leg : model.feet.legs) {
    const double above_cm = (world.positions(1, leg.ankle_idx) - low) * model.features.cm_per_unit;
    const double weight = std::exp(-above_cm / kStandingCm);
    point += weight * world.positions.col(leg.ankle_idx);
    sum += weight;
  }
  return point / sum;
}

/// Turns `place` about the standing foot of the frame made last, so that what comes leads where it is wanted.
void SteeredSynthesizer::State::turn() {
  const double dt = model.frame_time_secs(), fastest = steer.max_turn * kPi / 180;
  const Excursion ahead =
      joined(left[static_cast<std::size_t>(std::max<Index>(0, row - 1))], ways[static_cast<std::size_t>(coming)]);
  double wanted_rate = 0;
  if (wanted.direction) {
    const double cm = length(ahead) * model.features.cm_per_unit;
    wanted_rate = kTurnGainPerSec * wrap(*wanted.direction - place.heading - angle(ahead)) * cm / (cm + kNoWayCm);
  } else if (wanted.facing) {
    wanted_rate = kTurnGainPerSec * wrap(*wanted.facing - place.heading - left[static_cast<std::size_t>(row)].turn);
  }
  wanted_rate = std::clamp(wanted_rate, -fastest, fastest);
  const double change = fastest * dt / kTurnRampSecs;
  turn_rate += std::clamp(wanted_rate - turn_rate, -change, change);
  if (turn_rate == 0) return;
  const Vector3 pivot = standing_point();
  const double angle = turn_rate * dt, c = std::cos(angle), s = std::sin(angle);
  const double x = place.x - pivot.x(), z = place.z - pivot.z();
  place.x = pivot.x() + c * x + s * z;
  place.z = pivot.z() - s * x + c * z;
  place.heading += angle;
}

void SteeredSynthesizer::State::make() {
  if (should_replan) replan();
  if (row == end) advance();
  if (num_made > 0) turn();
  decode_frame(model.features, &rows(row, 0), num_made == 0, place, pose, 0);
  ++row;
  ++num_made;
}

SteeredSynthesizer::SteeredSynthesizer(const MotionTexture& model, const SynthesizeOptions& options,
                                       const SteerOptions& steer) {
  check_options(options);
  check_options(steer);
  state_ = std::make_unique<State>(model, options, steer);
}
SteeredSynthesizer::~SteeredSynthesizer() = default;
SteeredSynthesizer::SteeredSynthesizer(SteeredSynthesizer&&) noexcept = default;

void SteeredSynthesizer::steer(const Steering& steering) {
  for (const auto& value : {steering.direction, steering.facing, steering.speed})
    if (value && !(std::abs(*value) < 1e6)) throw InvalidInput("a direction, facing or speed is not a finite number");
  if (steering.speed && *steering.speed < 0) throw InvalidInput("a speed is negative");
  if (!(steering.pace >= 0.8 && steering.pace <= 1.25)) throw InvalidInput("the pace is outside 0.8 … 1.25");
  state_->wanted = steering;
  state_->should_replan = true;
}

void SteeredSynthesizer::request(int texton) {
  State& s = *state_;
  check_playable(s.model, texton);
  std::vector<int> path{texton};
  try {
    const int from = s.model.instances[static_cast<std::size_t>(s.playing)].texton;
    path = find_texton_paths(s.model, from, texton).best.textons;
    if (path.size() > 1) path.erase(path.begin());
  } catch (const InvalidInput&) {
    // nothing leads there: jump
  }
  s.walk.lead(std::move(path));
  s.should_replan = true;
}

void SteeredSynthesizer::next(Clip& out, Index frame) {
  State& s = *state_;
  if (!s.fixer) {
    s.make();
    out.translations.row(frame) = s.pose.translations.row(0);
    out.rotations.row(frame) = s.pose.rotations.row(0);
    return;
  }
  while (!s.fixer->pop(out, frame)) {
    s.make();
    s.fixer->push(s.pose, 0);
  }
}

std::vector<PlayedTexton> SteeredSynthesizer::take_played() { return std::exchange(state_->begun, {}); }

Index SteeredSynthesizer::delay() const { return state_->fixer ? state_->fixer->delay() : 0; }

}  // namespace motex
