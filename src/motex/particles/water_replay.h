// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/options.h"
#include "motex/core/rng.h"
#include "motex/particles/cable.h"
#include "motex/particles/flow_field.h"
#include "motex/particles/moveton_frame.h"

namespace motex {

struct WaterReplayOptions {
  double cell_size = 32;
  double cell_life = 40;
  double blend_frames = 0;
  int candidates = 40;
  double choice_spread = 0.08;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"cell_size", "pixels", "of the patches of water whose light comes from one moment of the clip"},
          self.cell_size, Range{4, 4096});
    visit(Field{"cell_life", "frames", "that such a patch lives, about"}, self.cell_life, Range{2, 1e6});
    visit(Field{"blend_frames", "frames", "that a patch takes to come and to go; auto: until the water has passed it"},
          self.blend_frames, Range{1, 1000, true});
    visit(Field{"candidates", "", "moments of the clip that are compared when a patch begins"}, self.candidates,
          Range{1, 100000});
    visit(Field{"choice_spread", "", "how much worse a moment may fit than the best and still be taken"},
          self.choice_spread, Range{0, 100});
  }
};

/// Water synthesized from carried bases: their cables are born again, jointly.
///
/// P_B of [TM02] may be a joint density "for a large number of movetons": bases of water come and go together, each
/// making up for its neighbours, and drawn one by one they give blotches. Here cells about cell_size apart drift along
/// the flow field; each shows one moment of the clip, frame by frame, where it is. A base at x of cell k has the weight
///   w_k(x) = s_k e_k(x) / √(Σ_j s_j² e_j(x)²),   e_k(x) = exp(−|x − x_k|² / 2τ²),   τ = 0.3 cell_size,
/// so that the variance of the light is the clip's and no seam shows; s_k rises and falls over blend_frames. Cells are
/// begun where the flow leaves a hole (sources), ended where it crowds them (sinks) and after their life; the moment of
/// a new one is drawn among those whose light is like that which is there, and which bring the mean light of the place
/// back to the clip's: without that, moments that are alike follow one another for ever, and the picture stays too
/// bright or too dark where water is slow.
class WaterReplay {
 public:
  /// cables, flow: kept by reference. num_frames: of the clip they come from, ≥ 12. Throws InvalidInput.
  WaterReplay(const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height, const FlowField& flow,
              const WaterReplayOptions& options, std::uint64_t seed);

  /// The next frame: one moveton a cable, its bases weighted.
  void next(MovetonFrame& frame);
  int num_cells() const { return static_cast<int>(cells_.size()); }

 private:
  struct Cell {
    double x = 0, y = 0;
    std::int64_t moment = 0;  ///< frame of the clip that is shown now
    std::int64_t last = 0;    ///< moment at which it begins to fade
    double strength = 0;      ///< s_k
    bool ending = false;
    std::int64_t first_track = 0;  ///< number of the moveton that cable 0 would be
  };
  void move_cells();
  void end_crowded();
  void begin_in_holes();
  void begin_cell(double x, double y);
  std::int64_t choose_moment(double x, double y);
  double mismatch(std::int64_t moment, double x, double y) const;
  void sum_energies();
  double weight_of(const Cell& cell, double x, double y) const;
  void show_cell(const Cell& cell, MovetonFrame& frame) const;
  double falloff(const Cell& cell, double x, double y) const;

  const std::vector<Cable>& cables_;
  const FlowField& flow_;
  WaterReplayOptions options_;
  std::int64_t num_frames_;
  int width_, height_;
  std::vector<std::vector<int>> alive_in_;  ///< [frame of the clip] → cables
  std::vector<Plane> seen_;                 ///< light of the bases of the clip, small
  std::vector<Plane> sums_;                 ///< [t] Σ seen_ of the frames before t
  Plane drift_;                             ///< mean of the last frames given (fading over num_frames), less the clip's
  Plane now_;                               ///< of the frame given last, small
  Plane energies_;                          ///< Σ s² e², small
  std::vector<Cell> cells_;
  std::int64_t num_begun_ = 0, num_shown_ = 0;
  Rng rng_;
};

}  // namespace motex
