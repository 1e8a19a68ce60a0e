// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/model.h"

namespace motex {

enum class EditKind {
  kSetJoint,    ///< the joint's rotation in its parent's frame is `rotation`
  kTurnJoint,   ///< it is turned by `rotation` about its parent's axes
  kSetHeight,   ///< height of the travelling joint, in the skeleton's unit
  kMoveHeight,  ///< that much higher
  kSetTilt,     ///< lean of the body: exp(tilt_x, 0, tilt_z) after the heading, radians
  kMoveTilt,
  kSetPose,  ///< height, tilt and all joints are those of `pose`
};

/// What a frame of a texton shall be. Which of the fields count is said by the kind.
struct PoseEdit {
  EditKind kind = EditKind::kTurnJoint;
  Index frame = 0;  ///< of the texton, 0 … length − 1
  int joint = 0;
  Quat rotation = Quat::Identity();
  double height = 0, tilt_x = 0, tilt_z = 0;
  Vector pose;  ///< D weighted features, as encode() makes them
};

struct EditOptions {
  double noise = 0;
  bool foot_fix = true;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"noise", "", "strength of fresh noise in the motion that is edited (auto: none, the example as it is)"},
          self.noise, Range{1e-9, 3, true});
    visit(Field{"foot_fix", "", "hold planted feet"}, self.foot_fix, Range{});
    visit(Field{"seed", "", "random seed"}, self.seed, Range{0, 1.8e19});
  }
};

/// One joint, the height or the tilt, and how it was edited.
struct EditedPart {
  std::string name;
  std::vector<Index> frames;
  double size = 0;    ///< largest change at these frames, cm of body movement (weighted)
  double strain = 0;  ///< noise that the change takes, in deviations of what it takes by chance
};

struct EditReport {
  std::vector<EditedPart> parts;
};

/// A texton with poses changed inside as hard constraints [MT02 6.2, Figure 11]. The motion is y = y₀ + Σ_j S_j e_j: y₀
/// is the unedited one (SegmentSynthesis, same noise), S_j the channels of an edited part (a joint, the height, the
/// tilt) and e_j its change: the least-noise path, from 0 at both ends through what was asked for, of the second-order
/// dynamics that the texton's frames show in these channels, one and the same for each: it goes straight to the edit,
/// as fast as that part of the body moves here. Edits are met to rounding, end frames and parts that are not edited do
/// not move, and an edit by nothing changes nothing. Projected into the texton's subspace, as in the paper, some 40 %
/// of an edit would be lost or move other joints [docs/papers/motion-texture.md].
///
/// Edits that need more noise than chance ever makes (strain > 5) are met all the same, with a warning. The foot
/// pass leaves frames alone where legs or what carries them were edited; where height or tilt alone were, legs bend so
/// that feet stay where they were. Throws InvalidInput for a frame that does not
/// exist or is one of the two at each end, a joint that has no channels, numbers that are not finite, or two edits of
/// one part and frame.
Clip edit_texton(const MotionTexture& model, int instance, std::span<const PoseEdit> edits, const EditOptions& options,
                 EditReport& report, const JobContext& job = {});

}  // namespace motex
