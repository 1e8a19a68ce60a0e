// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "motex/core/options.h"
#include "motex/motion/contacts.h"

namespace motex {

/// How planted feet are held.
struct FootFixOptions {
  double lookahead = 0.4;
  double ease = 0.1;
  double hold = 1.5;
  double max_correction = 6;
  double speed_factor = 1.5;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"lookahead", "s", "how far ahead contacts are seen; streaming is late by this"}, self.lookahead,
          Range{0.15, 0.5});
    visit(Field{"ease", "s", "time in which a correction comes and goes"}, self.ease, Range{0.02, 1});
    visit(Field{"hold", "s", "a planted foot that slides for much longer than this is let go slowly"}, self.hold,
          Range{0.1, 100});
    visit(Field{"max_correction", "cm", "corrections that grow beyond this are let go"}, self.max_correction,
          Range{0.1, 100});
    visit(Field{"speed_factor", "", "feet up to this many times faster than planted feet of the examples are held too"},
          self.speed_factor, Range{0.1, 10});
  }
};

struct FootFixReport {
  Index num_frames = 0;
  Index num_contacts = 0;           ///< stretches of planted frames, ankles and toes counted apart
  double mean_correction = 0;       ///< units: movement of the ankle, mean over frames and legs
  double max_correction = 0;        ///< units
  double contact_speed_before = 0;  ///< units/s: mean horizontal speed of planted ankles and toes
  double contact_speed_after = 0;
};

/// Holds planted feet in a stream of frames, late by at most options.lookahead, in constant memory.
class FootFixer {
 public:
  /// Throws InvalidInput when the model's joints are not the skeleton's, or an option is out of range.
  FootFixer(const FootModel& model, const Skeleton& skeleton, double frame_time_secs,
            const FootFixOptions& options = {});
  ~FootFixer();
  FootFixer(FootFixer&&) noexcept;

  /// Takes row `frame` of the clip. A pinned frame comes out as it went in.
  void push(const Clip& clip, Index frame, bool pinned = false);
  /// No more frames will come: the rest can be popped.
  void finish();
  /// Writes the next frame into row `frame` of `out` (same skeleton). False when it is not decided yet, or all are out.
  bool pop(Clip& out, Index frame);
  /// Frames by which the output is late.
  Index delay() const;
  /// Of the frames popped so far.
  FootFixReport report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// FootFixer over a whole clip, in place. pinned: frames that must not change.
FootFixReport fix_feet(Clip& clip, const FootModel& model, const FootFixOptions& options = {},
                       std::span<const Index> pinned = {});

}  // namespace motex
