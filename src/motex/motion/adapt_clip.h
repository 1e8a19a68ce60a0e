// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion/clip.h"
#include "motex/motion/length_unit.h"
#include "motex/motion/markers.h"

namespace motex {

enum class RootMotion { kKeep, kInPlace, kBone };
enum class OutputUp { kY, kZ };

/// What becomes of a clip on its way out, for the program that takes it.
struct AdaptClipOptions {
  RootMotion root = RootMotion::kKeep;
  std::string joints, without;
  double scale = 1;
  double out_fps = 0;
  LengthUnit out_unit = LengthUnit::kAuto;
  OutputUp out_up = OutputUp::kY;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"root", "",
                "travel of the body: as it is; taken away, the body turning and rising on the spot; or moved to a new "
                "bone on the floor, \"root_motion\", from which the body hangs"},
          self.root, Choices{{"keep", "in-place", "bone"}});
    visit(Field{"joints", "", "write these joints only, NAME,NAME,… (* stands for any letters)"}, self.joints, Range{});
    visit(Field{"without", "", "leave these joints out; what hangs from them hangs from the next above"}, self.without,
          Range{});
    visit(Field{"scale", "", "make the body so many times as large"}, self.scale, Range{1e-6, 1e6});
    visit(Field{"out_fps", "Hz", "frame rate of the written clip; auto = as it is"}, self.out_fps,
          Range{0.001, 1e5, true});
    visit(Field{"out_unit", "", "unit of length of the written numbers; auto = as it is"}, self.out_unit,
          Choices{{"auto", "m", "cm", "mm", "inch", "ft"}});
    visit(Field{"out_up", "", "axis that points up in the written file"}, self.out_up, Choices{{"y", "z"}});
  }
};

/// Applies, in this order, root, joints and without, out_fps, scale and out_unit. out_up is left to the writer's side
/// (turn_y_up_to_z_up), since y is up in every Clip. A unit that is not known and has to be is guessed from the body,
/// which is said. Throws InvalidInput for joints that do not exist.
Clip adapt_clip(Clip clip, const AdaptClipOptions& options, const JobContext& job = {});
/// Markers: joints and without name markers; root must be kKeep (InvalidInput); a unit must be known to be changed.
MarkerSet adapt_markers(MarkerSet markers, const AdaptClipOptions& options);

/// Takes the horizontal travel away: the first root stays over x = z = 0, other roots move by as much as it. Height,
/// tilt and heading are kept.
void hold_in_place(Clip& clip);

/// A new first joint "root_motion" (or the like, when there is one already) on the floor, y = 0, with the travel and
/// heading of the first root: x and z of its position, R_y(ψ) of its rotation, ψ continuous. All roots hang from it;
/// world positions and rotations are unchanged. What engines call root motion.
Clip with_root_bone(const Clip& clip);

/// The clip with those joints only (one flag a joint). A joint whose parent is left out hangs from the next one above
/// that is kept, its local transforms composed; without one it becomes a root. World positions and rotations of the
/// joints that stay are unchanged but for rounding. A joint that loses all its children gets their offsets as end
/// sites. Throws InvalidInput when no joint is left.
Clip keep_joints(const Clip& clip, const std::vector<char>& keep);

/// One flag a name: whether it is in `only` (empty: all are) and not in `without`. Both are names between commas, in
/// which * stands for any letters. Throws InvalidInput naming the first that fits nothing; what: "joint" or "marker".
std::vector<char> chosen_names(const std::vector<std::string>& names, const std::string& only,
                               const std::string& without, const std::string& what);

/// Whether the whole of text fits the pattern, in which * stands for any letters, none included.
bool fits_pattern(std::string_view pattern, std::string_view text);

}  // namespace motex
