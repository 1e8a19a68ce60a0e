// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_vary.h"

#include <string>

#include "motex/core/options_check.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/segment_synthesis.h"
#include "motex/motion_texture/texton_stretch.h"

namespace motex {

Clip vary_texton(const MotionTexture& model, int instance_idx, const VaryOptions& options, VaryReport& report) {
  check_options(options);
  check_instance(model, instance_idx);
  const Instance& a = model.instances[static_cast<std::size_t>(instance_idx)];
  PlayOptions play;
  play.noise = options.noise;
  play.seed = options.seed;
  const FrameMatrix features =
      SegmentSynthesis(model, play).play({a.texton, a.row, a.length, a.row, a.row + a.length - 2, a.length});
  Clip clip = decode(model.features, features, a.place);
  clip.name = "texton";
  const Index ends[] = {0, 1, a.length - 2, a.length - 1};
  if (options.foot_fix && !model.feet.legs.empty()) fix_feet(clip, model.feet, {}, ends);
  const Vector distances = (features - model.corpus.middleRows(a.row, a.length).cast<double>()).rowwise().norm();
  report.mean_distance = distances.mean();
  report.largest_distance = distances.maxCoeff(&report.farthest_frame);
  const double speed = mean_joint_speed(example_clip(model, instance_idx));
  report.speed_ratio = speed > 0 ? mean_joint_speed(clip) / speed : 1;
  return clip;
}

}  // namespace motex
