// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/motion_texture/texton_vary.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"
#include "texton_example.h"

namespace motex::cli {
namespace {

struct Vary {
  std::string model_path;
  std::vector<std::string> outputs;
  TextonExample example;
  VaryOptions options;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    example.declare(arguments);
    declare_clip_outputs(arguments, outputs).required = true;
    arguments.section("How");
    arguments.options(options);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    example.check();
    check_clip_outputs(outputs, adapt, session);
    const MotionTexture model = load_motion_texture(model_path);
    const int instance = example.choose(model);
    if (session.flags.dry_run) return would_write(outputs, -1, session);
    VaryReport report;
    const Clip clip = vary_texton(model, instance, options, report);
    const std::string seed = "seed " + std::to_string(options.seed);
    write_clip_outputs(outputs, clip, example_picture(model, instance, seed, clip.num_frames()), adapt, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(clip.num_frames()) + " frames, " +
                fixed(report.mean_distance, 1) + " cm from the example on average, " +
                fixed(report.largest_distance, 1) + " cm at frame " + std::to_string(report.farthest_frame) + ", " +
                seed);
    session.result(report_value(model, instance, clip, report, session), "");
  }

 private:
  Value report_value(const MotionTexture& model, int instance, const Clip& clip, const VaryReport& report,
                     const Session& session) const {
    Value object;
    object["frames"] = std::int64_t{clip.num_frames()};
    object["seed"] = options.seed;
    object["output"] = outputs;
    describe_example(model, instance, object);
    object["mean_distance_cm"] = report.mean_distance;
    object["largest_distance_cm"] = report.largest_distance;
    object["farthest_frame"] = std::int64_t{report.farthest_frame};
    object["speed_ratio"] = report.speed_ratio;
    object["options"] = options_value(options);
    object["secs"] = session.secs();
    return object;
  }
};

}  // namespace

Command motion_vary() {
  return make_command<Vary>(
      {"motion vary", "the same texton with other fine details",
       "Fresh noise moves the example as its dynamics allow; first and last poses stay. Another --seed makes another "
       "variant.",
       "motex motion vary dance.motex --texton 7 -o variant.bvh --seed 2\n"
       "motex motion vary dance.motex --example salsa_01@100 --noise 1 -o wilder.html"});
}

}  // namespace motex::cli
