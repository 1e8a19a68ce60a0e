// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion/clip.h"
#include "motex/motion/length_unit.h"

namespace motex {

enum class UpAxis { kAuto, kY, kZ };

/// How a clip file is to be understood where it does not say, or says it wrongly.
struct ReadClipOptions {
  double fps = 0;
  double resample = 0;
  int skip_frames = 0;
  UpAxis up = UpAxis::kAuto;
  LengthUnit unit = LengthUnit::kAuto;
  std::string asf;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"fps", "Hz", "true frame rate, where the file states none or a wrong one"}, self.fps,
          Range{0.001, 1e5, true});
    visit(Field{"resample", "Hz", "change to this frame rate after reading"}, self.resample, Range{0.001, 1e5, true});
    visit(Field{"skip_frames", "frames", "leave out the first frames (a T-pose, say)"}, self.skip_frames,
          Range{0, 1e9});
    visit(Field{"up", "", "axis that points up in the file; auto = y"}, self.up, Choices{{"auto", "y", "z"}});
    visit(Field{"unit", "", "unit of length in the file; auto = as the format says, else unknown"}, self.unit,
          Choices{{"auto", "m", "cm", "mm", "inch", "ft"}});
    visit(Field{"asf", "", "skeleton file of an AMC clip; empty = found beside it"}, self.asf, Range{});
  }
};

/// Applies skip_frames, up, unit and resample to a clip as a reader of one format returned it (readers themselves apply
/// fps only). up = z turns the whole clip −90° about x, rest pose and channel names included, so that z becomes y.
/// Throws InvalidInput when skip_frames leaves no frame.
void apply_read_options(const ReadClipOptions& options, Clip& clip);

/// Whether the body stretches along z much more than along y and x in most frames, as in files whose z axis is up.
/// A hint for a warning: somebody may lie on the floor.
bool looks_z_up(const Clip& clip);

}  // namespace motex
