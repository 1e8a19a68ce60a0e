// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion/clip.h"
#include "motex/motion_texture/gap_examples.h"

namespace motex {

enum class InbetweenAim { kLively, kMean };

struct InbetweenOptions {
  InbetweenAim aim = InbetweenAim::kLively;
  double context = 1.0 / 3;
  bool place_end = true;
  bool foot_fix = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"aim", "",
                "lively: follow the example that fits best, as lively as the data; mean: what is expected from all "
                "examples, with the least error"},
          self.aim, Choices{{"lively", "mean"}});
    visit(Field{"context", "s", "how much before and after the gap is looked at"}, self.context, Range{0.01, 2});
    visit(Field{"place_end", "", "the end stands where its clip says; without: where the motion leads"}, self.place_end,
          Range{});
    visit(Field{"foot_fix", "", "hold planted feet"}, self.foot_fix, Range{});
  }
};

/// An example that was followed: frames of a clip of the model, those on both sides of the gap included.
struct FollowedExample {
  std::string clip;
  Index start = 0, length = 0;
  int texton = 0;  ///< of its middle
};

struct InbetweenReport {
  std::vector<FollowedExample> followed;  ///< nearest first
  double distance = 0;                    ///< cm, root mean square over what is seen of the gap, to the nearest example
  RootPlace end;                          ///< where the frame after the gap stands
};

/// Fills gaps of one length. Body and root lead from the two frames before the gap into the two frames after it without
/// a jump of pose or speed: the path of the weighted examples (GapExamples), plus the cubic that makes up for what is
/// left of the difference of poses and speeds at both ends.
class Inbetweener {
 public:
  /// The model must outlive it. Throws InvalidInput when the examples are too short for such a gap.
  Inbetweener(const MotionTexture& model, const GapShape& shape, const InbetweenOptions& options);

  /// The gap's frames. before ends and after begins with the frames beside the gap; of each at least the shape's number
  /// of frames, of the model's skeleton and rate. Throws InvalidInput.
  Clip fill(const Clip& before, const Clip& after, InbetweenReport& report) const;

 private:
  const MotionTexture& model_;
  GapShape shape_;
  InbetweenOptions options_;
  GapExamples examples_;
};

/// num_frames frames that lead from the last frame of `before` to the first of `after`. Either may be a single pose.
Clip inbetween(const MotionTexture& model, const Clip& before, const Clip& after, Index num_frames,
               const InbetweenOptions& options, InbetweenReport& report, const JobContext& job = {});

}  // namespace motex
