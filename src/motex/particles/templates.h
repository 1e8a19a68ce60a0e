// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/cable.h"
#include "motex/particles/moveton_template.h"

namespace motex {

struct LearnTemplatesOptions {
  std::uint64_t seed = 1;
  int max_species = 8;
  int max_poses = 5;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"seed", "", "random numbers; the same seed gives the same templates"}, self.seed, Range{0, 1.8e19});
    visit(Field{"max_species", "", "most templates"}, self.max_species, Range{1, 50});
    visit(Field{"max_poses", "", "most states of a template, such as positions of wings"}, self.max_poses,
          Range{1, 20});
  }
};

/// Step 3 of [TM02]'s loop: deformable templates Ψ by clustering movetons on the L2 distance of their rendered patches
/// (moveton_patch.h), of isolated movetons only. The species is constant along a cable: clusters are of the cables'
/// mean patches, and their number is what the patches show, 1 … max_species. Within a species states are found
/// (poses.h), and for each state its coils with distributions of offset, scale, angle, coefficient and presence.
///
/// Sets species and poses of every cable (poses stay empty where there is one state). Half turns that leave a core the
/// same are taken from the angles so that cables of one species look alike. Templates by falling share; none when there
/// are no cables. Cost: 20 µs an element and frame.
std::vector<MovetonTemplate> learn_templates(std::vector<Cable>& cables, int num_planes,
                                             const LearnTemplatesOptions& options = {}, const JobContext& job = {});

}  // namespace motex
