// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"

namespace motex {

/// A leg of two bones and a foot. Each joint is the parent of the next. Lengths are in the skeleton's unit.
struct Leg {
  int hip_idx = 0, knee_idx = 0, ankle_idx = 0;
  Vector3 toe_offset = Vector3::Zero();     ///< in the ankle's frame; zero when the foot has no toe
  Vector3 knee_axis = Vector3::UnitX();     ///< in the hip joint's frame: the knee bends about it, thigh × shank
  double ankle_floor = 0, toe_floor = 0;    ///< 2nd height percentiles: where they are when planted
  double ankle_height = 0, toe_height = 0;  ///< a contact begins no higher than this above the floor
  bool has_toe() const { return !toe_offset.isZero(0); }
};

/// What is known of the feet of one skeleton, learned from examples. Plain data; without legs nothing has contact.
struct FootModel {
  std::vector<Leg> legs;
  int pelvis_idx = 0;        ///< the joint that carries the body: the lowest with a translation above all hips
  double cm_per_unit = 1;    ///< of a body that stands 1.7 m where the unit is unknown
  double begin_speed = 0;    ///< units/s, horizontal: a contact begins below it
  double end_speed = 0;      ///< units/s: and ends above this one
  double height_margin = 0;  ///< units: and ends this much above the height at which one may begin
  double min_contact_secs = 0.08;
};

/// Finds legs and learns where their feet stand. names: one joint of each foot (ankle or toe); empty: the two lowest
/// limbs whose tips are lowest (5th height percentile) and that part above the hips. Thigh and shank are the two
/// consecutive bones whose shorter one is longest on the way from the tip to the body.
/// Heights: floor = 2nd percentile; a contact begins below floor + max(2.5 cm, 1.5 (median − floor)). Speeds: begin =
/// 3 × the 25th percentile of low feet, within 10 … 30 cm/s; end = 1.5 × begin.
/// Clips share one skeleton. A body without such legs gives a model without legs and a warning. Throws InvalidInput for
/// a name that is no joint, or whose limb has no two bones.
FootModel learn_foot_model(std::span<const Clip> clips, std::span<const std::string> names = {},
                           const JobContext& job = {});

/// The two points of a foot that can be planted.
enum FootPoint : int { kAnkle = 0, kToe = 1 };

/// Frames × 2·legs (ankle, toe of each leg): 1 while the point is planted: low and slow, by the thresholds of FootModel
/// with hysteresis, for at least min_contact_secs.
using ContactMatrix = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
ContactMatrix detect_contacts(const Clip& clip, const FootModel& model);

/// The state machine behind detect_contacts for one point, frame after frame.
class ContactDetector {
 public:
  ContactDetector(double begin_height, double end_height, double begin_speed, double end_speed, int min_frames);
  /// Takes the next frame's height and horizontal speed. Returns how many of the latest frames, this one included,
  /// are now known to be planted: 0, min_frames (a contact has lasted long enough) or 1 (it goes on).
  int push(double height, double speed);

 private:
  double begin_height_, end_height_, begin_speed_, end_speed_;
  int min_frames_;
  int run_ = 0;
};
/// point: kAnkle or kToe.
ContactDetector make_contact_detector(const FootModel& model, const Leg& leg, int point, double frame_time_secs);

}  // namespace motex
