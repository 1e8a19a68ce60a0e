// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion_texture/model.h"

namespace motex {

struct EngineExportOptions {
  bool all_examples = false;
  double blend = 0.25;
  int most_transitions = 24;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"all_examples", "", "every example of every texton, instead of the one that joins the others best"},
          self.all_examples, Range{});
    visit(Field{"blend", "s", "longest cross-fade between two clips"}, self.blend, Range{0, 2});
    visit(Field{"most_transitions", "", "the likeliest so many from a clip"}, self.most_transitions, Range{1, 1000});
  }
};

/// A texton as a clip of its own. It begins at the origin, looking along +Z, and ends with the two frames with which
/// the next clip begins (where the transition's distance is 0; near them otherwise).
struct EngineClip {
  std::string name;  ///< the texton's own or "texton_3", with "_0" … when there are several; letters, digits, "_", "-"
  int texton = 0;
  int instance = 0;
  Clip clip;  ///< named alike
};

struct EngineTransition {
  int from = 0, to = 0;           ///< clips
  double probability = 0;         ///< of those that leave `from`: they add up to 1
  double texton_probability = 0;  ///< M of their textons
  double distance_cm = 0;         ///< between the last two frames of one and the first two of the other
  double blend_secs = 0;          ///< cross-fade that hides it: blend · min(1, distance / the usual jump), 0 at 0
};

/// What an engine needs to dance by itself.
struct EnginePack {
  std::vector<EngineClip> clips;
  std::vector<EngineTransition> transitions;  ///< by `from`, likeliest first
  std::string graph;                          ///< graph.json (docs/formats.md)
};

/// Of a texton, without all_examples, the example e is taken that makes
///   Σ_j M_ij d(end of e, start of e_j) + M_ji d(end of e_j, start of e)
/// least, one texton after another until nothing changes. Between clips a and b of textons i and j the probability is
/// that of the endless dance (InstanceWalk) without its memory: ∝ M_ij exp(−d(a, b) / τ), τ the usual jump, followers
/// farther than 1.25 τ left out where two nearer ones exist. Throws InvalidInput when the model has no texton that can
/// be played.
EnginePack make_engine_pack(const MotionTexture& model, const std::string& name,
                            const EngineExportOptions& options = {}, const JobContext& job = {});

/// All clips as animations of one skeleton; with the model's skin, where it has one.
std::string engine_glb(const EnginePack& pack);

}  // namespace motex
