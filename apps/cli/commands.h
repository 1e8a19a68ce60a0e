// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "command.h"

/// Every command has a file of its own name.
namespace motex::cli {

Command motion_learn();
Command motion_info();
Command motion_synthesize();
Command motion_path();
Command motion_choreograph();
Command motion_inbetween();
Command motion_stretch();
Command motion_vary();
Command motion_edit();
Command motion_segment();
Command motion_score();
Command motion_compare();
Command motion_features();
Command motion_view();
Command motion_convert();
Command motion_retarget();
Command motion_play();
Command motion_export();
Command motion_mix();
Command motion_texton_list();
Command motion_texton_name();
Command motion_texton_drop();
Command motion_texton_keep();
Command motion_texton_merge();
Command motion_texton_weight();
Command motion_texton_undo();
Command particles_decompose();
Command particles_score();
Command particles_learn();
Command particles_info();
Command particles_tracks();
Command particles_explain();
Command particles_compress();
Command particles_decompress();
Command particles_synthesize();
Command particles_maps();
Command particles_simulate_snow();
Command particles_simulate_birds();
Command particles_simulate_fireworks();
Command people_key();
Command people_signals();
Command people_learn();
Command people_info();
Command people_name();
Command people_export();
Command people_crowd();
Command people_simulate();
Command people_motifs();
Command people_direct();
Command people_play();
Command doctor();

}  // namespace motex::cli
