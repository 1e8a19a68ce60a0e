// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/bird_flight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"

namespace motex {
namespace {

constexpr double kGlideAngle = 0.12;    // radians
constexpr double kVelocityFrames = 16;  // over which velocity is followed
constexpr double kWingOmega = 1.6;      // radians a frame; at 8 frames a beat 0.8 of the beat is left
constexpr double kTipOmega = 0.8;       // the outer wing is slower
constexpr double kBankOmega = 0.15;
constexpr double kGravity = 9.81;           // m/s²
constexpr double kSteepestBank = 1.05;      // radians
constexpr double kSteepestClimb = 0.6;      // sine
constexpr double kUsualPresence = 0.5;      // a coil that is there more often counts for the span
constexpr double kLeastSpan = 5;            // core scales, of a template that is a blob only
constexpr double kLongestDepthRate = 0.05;  // of the depth, a frame: more is noise of the scale
constexpr double kDegree = std::numbers::pi / 180;

/// Height of the coils beside the core, weighted by their light and distance, in core scales; up is positive.
double wing_height(const MovetonTemplate& birds, const TemplatePose& pose) {
  const double s = std::sin(birds.angle.mean), c = std::cos(birds.angle.mean);
  double sum = 0, weights = 1e-9;
  for (const TemplateCoil& coil : pose.coils) {
    const double away = std::hypot(coil.u.mean, coil.v.mean);
    double light = 0;  // in the colour in which most is seen of it
    for (const Spread& coefficient : coil.coefficient) light = std::max(light, std::abs(coefficient.mean));
    const double weight = coil.presence * light * away;
    sum -= weight * (coil.u.mean * s + coil.v.mean * c);  // the picture's y points down
    weights += weight;
  }
  return sum / weights;
}

/// Mean ln scale of each pose minus that of all frames of the species: a spread wing brings the core no nearer.
std::vector<double> log_scale_offsets(const TexturedMotion& model, int species, std::size_t num_poses) {
  std::vector<double> sums(num_poses), counts(num_poses);
  double total = 0, frames = 0;
  for (const Cable& cable : model.cables) {
    if (cable.species != species || cable.poses.size() != cable.core.size()) continue;
    for (std::size_t t = 0; t < cable.core.size(); ++t) {
      const auto pose = static_cast<std::size_t>(cable.poses[t]);
      if (cable.poses[t] < 0 || pose >= num_poses || !(cable.core[t].scale > 0)) continue;
      const double log_scale = std::log(cable.core[t].scale);
      sums[pose] += log_scale;
      counts[pose] += 1;
      total += log_scale;
      frames += 1;
    }
  }
  std::vector<double> offsets(num_poses);
  for (std::size_t k = 0; k < num_poses; ++k)
    if (counts[k] >= 5) offsets[k] = sums[k] / counts[k] - total / frames;
  return offsets;
}

template <typename Values>
double at_pose(const Values& values, int pose) {
  return values[static_cast<std::size_t>(std::clamp(pose, 0, static_cast<int>(values.size()) - 1))];
}

}  // namespace

void Follower::step(double target, double omega) {
  const double error = value - target, pull = rate + omega * error, decay = std::exp(-omega);
  value = target + (error + pull) * decay;
  rate = (rate - omega * pull) * decay;
}

std::vector<double> wing_angles(const MovetonTemplate& birds, double flap_angle) {
  if (birds.poses.size() < 2) return {kGlideAngle};
  std::vector<double> heights;
  for (const TemplatePose& pose : birds.poses) heights.push_back(wing_height(birds, pose));
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double lowest = *low, range = *high - *low;
  std::vector<double> angles;
  for (const double height : heights)
    angles.push_back(range > 1e-6 ? flap_angle * (2 * (height - lowest) / range - 1) : kGlideAngle);
  return angles;
}

double span_per_scale(const MovetonTemplate& birds) {
  double reach = kLeastSpan / 2;
  for (const TemplatePose& pose : birds.poses)
    for (const TemplateCoil& coil : pose.coils)
      if (coil.presence >= kUsualPresence)
        reach = std::max(reach, std::hypot(coil.u.mean, coil.v.mean) + 1.5 * std::exp(coil.log_scale.mean));
  return 2 * reach;
}

double focal_length(int width, double field_of_view) { return 0.5 * width / std::tan(0.5 * field_of_view * kDegree); }

BirdFlock::BirdFlock(const TexturedMotion& model, const BirdFlightOptions& options)
    : options_(options), width_(model.width), height_(model.height) {
  check_options(options);
  if (width_ < 1 || height_ < 1)
    throw InvalidInput("birds cannot fly in a model without a picture: its width or height is 0");
  focal_ = focal_length(width_, options.field_of_view);
  const double seconds = 1 / std::max(1.0, model.frames_per_sec);
  gravity_ = kGravity / options.wingspan_m * seconds * seconds;
  unknown_ = {kLeastSpan, {kGlideAngle}, {0}};
  for (std::size_t k = 0; k < model.templates.size(); ++k) {
    const MovetonTemplate& birds = model.templates[k];
    species_.push_back({span_per_scale(birds), wing_angles(birds, options.flap_angle * kDegree),
                        log_scale_offsets(model, static_cast<int>(k), std::max<std::size_t>(1, birds.poses.size()))});
  }
}

const BirdFlock::Species& BirdFlock::species_of(int species) const {
  const bool is_known = species >= 0 && species < static_cast<int>(species_.size());
  return is_known ? species_[static_cast<std::size_t>(species)] : unknown_;
}

const std::vector<BirdPose>& BirdFlock::advance(const MovetonFrame& frame) {
  birds_.clear();
  for (const Moveton& moveton : frame.movetons) {
    Flight& flight = flights_[moveton.track];
    birds_.push_back(advance_one(flight, moveton, frame.core_of(moveton)));
    flight.frame = frame.frame;
  }
  std::erase_if(flights_, [&](const auto& entry) { return entry.second.frame != frame.frame; });
  std::stable_sort(birds_.begin(), birds_.end(),
                   [](const BirdPose& a, const BirdPose& b) { return a.position.z() < b.position.z(); });
  return birds_;
}

BirdPose BirdFlock::advance_one(Flight& flight, const Moveton& moveton, const Base& core) const {
  const Species& species = species_of(moveton.species);
  const double log_scale = std::log(std::max(0.05, core.scale)) - at_pose(species.log_scale_offsets, moveton.pose);
  const double log_depth = std::log(focal_ / species.span) - log_scale;
  const double wing = at_pose(species.wing_angles, moveton.pose);
  const double follow = 2 * std::numbers::pi / kVelocityFrames;
  if (flight.is_new) {
    flight.vx.value = moveton.vx;
    flight.vy.value = moveton.vy;
    flight.log_depth.value = log_depth;
    flight.wing.value = flight.tip.value = wing;
  } else {
    flight.vx.step(core.x - flight.x, follow);
    flight.vy.step(core.y - flight.y, follow);
    flight.log_depth.step(log_depth, 2 * std::numbers::pi / options_.depth_frames);
    flight.wing.step(wing, kWingOmega);
    flight.tip.step(flight.wing.value, kTipOmega);
  }
  flight.x = core.x;
  flight.y = core.y;
  const double depth = std::exp(flight.log_depth.value);
  const double depth_rate = std::clamp(flight.log_depth.rate, -kLongestDepthRate, kLongestDepthRate);
  BirdPose bird;
  bird.track = moveton.track;
  bird.species = moveton.species;
  bird.position = depth * Vector3((core.x + 0.5 - 0.5 * width_) / focal_, (0.5 * height_ - core.y - 0.5) / focal_, -1);
  point_along(flight, depth / focal_ * Vector3(flight.vx.value, -flight.vy.value, 0) + depth_rate * bird.position);
  flight.is_new = false;
  bird.forward = flight.forward;
  bird.up = flight.up;
  const double rising = flight.wing.rate / std::max(0.05, options_.flap_angle * kDegree);
  bird.wings = {flight.wing.value, 0.9 * (flight.tip.value - flight.wing.value) - 0.08,
                std::clamp(1.3 * rising, 0.0, 1.0)};
  return bird;
}

void BirdFlock::point_along(Flight& flight, const Vector3& velocity) const {
  if (velocity.norm() > 1e-6) {
    flight.forward = velocity.normalized();
    if (const double climb = flight.forward.y(); std::abs(climb) > kSteepestClimb) {
      const double level = std::hypot(flight.forward.x(), flight.forward.z());
      const double shrink = std::sqrt(1 - kSteepestClimb * kSteepestClimb) / std::max(1e-9, level);
      flight.forward = level > 1e-6 ? Vector3(flight.forward.x() * shrink, std::copysign(kSteepestClimb, climb),
                                              flight.forward.z() * shrink)
                                    : Vector3(1, 0, 0);
    }
  }
  const Vector3 right = flight.forward.cross(Vector3(0, 1, 0)).normalized();
  const double sideways = flight.is_new ? 0 : (velocity - flight.velocity).dot(right);
  const double bank = std::clamp(std::atan(sideways / gravity_), -kSteepestBank, kSteepestBank);
  flight.bank += kBankOmega * (bank - flight.bank);
  flight.up = std::cos(flight.bank) * right.cross(flight.forward) + std::sin(flight.bank) * right;
  flight.velocity = velocity;
}

}  // namespace motex
