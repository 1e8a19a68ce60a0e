// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "motex/core/error.h"
#include "motex/motion_texture/mix_models.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/project/motion_texture_file.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct MixModels {
  std::string path_a, path_b, output;

  void declare(Arguments& arguments) {
    arguments.positional("A", "made by motex motion learn", path_a);
    arguments.positional("B", "another of the same skeleton and frame rate", path_b);
    arguments.value("-o,--output", "OUT", "the mixed model (.motex)", output).required = true;
  }

  void run(Session& session) {
    check_output(output, {".motex"}, session);
    const MotionTexture a = load_motion_texture(path_a), b = load_motion_texture(path_b);
    MixReport report;
    const MotionTexture mixed = mix_models(a, b, report, session.job());
    const int first_of_b = first(report.textons_of_b);
    if (!session.flags.dry_run) save_motion_texture(output, mixed);
    session.say((session.flags.dry_run ? "would write " : "wrote ") + output + ": " +
                std::to_string(mixed.textons.size()) + " textons, those of " + path_b + " from " +
                std::to_string(first_of_b) + " on; " + std::to_string(report.num_crossings) +
                " transitions lead across, over " + fixed(report.crossing_distance, 1) + " cm (within a model " +
                fixed(report.usual_distance, 1) + " cm)");
    session.result(value(mixed, report), "");
  }

 private:
  static int first(const std::vector<int>& numbers) {
    for (const int number : numbers)
      if (number >= 0) return number;
    return -1;
  }

  Value value(const MotionTexture& mixed, const MixReport& report) const {
    Value object;
    object["output"] = output;
    object["textons"] = static_cast<int>(mixed.textons.size());
    object["segments"] = static_cast<int>(mixed.instances.size());
    object["frames"] = std::int64_t{mixed.corpus.rows()};
    object["textons_of_a"] = report.textons_of_a;
    object["textons_of_b"] = report.textons_of_b;
    object["crossings"] = report.num_crossings;
    object["crossing_distance_cm"] = report.crossing_distance;
    object["usual_distance_cm"] = report.usual_distance;
    object["textons_in_endless_dance"] = static_cast<int>(danced_textons(mixed).size());
    return object;
  }
};

}  // namespace

Command motion_mix() {
  return make_command<MixModels>(
      {"motion mix", "make one model of two of the same skeleton",
       "The textons of both, in one feature space, each fitted anew to its own examples; transitions of both, and "
       "jumps "
       "from each example to the nearest one of the other model. Edits of A and B are taken over as they act.",
       "motex motion mix salsa.motex waltz.motex -o both.motex\n"
       "motex motion synthesize both.motex -o new.bvh --secs 60"});
}

}  // namespace motex::cli
