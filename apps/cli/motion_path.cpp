// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "model_sources.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/texton_paths.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"
#include "texton_argument.h"

namespace motex::cli {
namespace {

Value path_value(const TextonPath& path) {
  Value object;
  object["textons"] = path.textons;
  object["probability"] = std::exp(path.log_prob);
  object["log_probability"] = path.log_prob;
  object["min_frames"] = std::int64_t{path.shortest};
  object["max_frames"] = std::int64_t{path.longest};
  return object;
}

std::string path_text(const TextonPath& path) {
  std::string text;
  for (const int texton : path.textons) text += (text.empty() ? "" : ",") + std::to_string(texton);
  return text;
}

struct FindPath {
  std::string model_path;
  std::string from, to;
  int num_textons = 0;
  std::vector<std::string> outputs;
  SynthesizeOptions options;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.value("--from", "T", "the first texton, by number or name", from).required = true;
    arguments.value("--to", "T", "the last texton", to).required = true;
    arguments
        .value("--textons", "L", "exactly that many textons, both ends counted (default: as is likeliest)", num_textons)
        .set = [this](const std::string& text) {
      parse_value("--textons", text, num_textons);
      if (num_textons < 1) throw InvalidInput("--textons: " + text + " is below 1");
    };
    arguments.value("-o,--output", "OUT", "dance the path: motion, page or picture; may be given several times",
                    outputs);
    arguments.section("How it is danced");
    arguments.options(options);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    check_clip_outputs(outputs, adapt, session);
    const MotionTexture model = load_motion_texture(model_path);
    const TextonPaths paths =
        find_texton_paths(model, texton_number(model, "--from", from), texton_number(model, "--to", to), num_textons);
    Value object;
    object["best"] = path_value(paths.best);
    object["runner_up"] = paths.runner_up ? path_value(*paths.runner_up) : Value();
    if (!outputs.empty()) {
      object["output"] = outputs;
      if (session.flags.dry_run)
        session.say("would write " + enumerate(outputs));
      else
        dance(model, paths.best, object, session);
    }
    session.result(object, table(paths));
  }

 private:
  void dance(const MotionTexture& model, const TextonPath& path, Value& object, Session& session) const {
    SynthesizeReport report;
    Clip clip = synthesize_motion(model, 0, path.textons, options, report, session.job(0, 0.9));
    clip.name = "path_" + path_text(path);
    ClipPicture picture;
    picture.spans = played_spans(model, report, clip.num_frames());
    write_clip_outputs(outputs, clip, picture, adapt, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(clip.num_frames()) + " frames, seed " +
                std::to_string(options.seed));
    object["frames"] = std::int64_t{clip.num_frames()};
    object["frame_rate"] = clip.frame_rate();
    object["instances"] = played_value(model, report);
    object["options"] = options_value(options);
  }

  static std::string table(const TextonPaths& paths) {
    std::vector<std::vector<std::string>> rows{{"path", "textons", "log probability", "frames"}};
    const auto add = [&](const char* name, const TextonPath& path) {
      rows.push_back({name, path_text(path), fixed(path.log_prob, 3),
                      std::to_string(path.shortest) + "–" + std::to_string(path.longest)});
    };
    add("best", paths.best);
    if (paths.runner_up) add("runner-up", *paths.runner_up);
    return text_table(rows);
  }
};

}  // namespace

Command motion_path() {
  return make_command<FindPath>({"motion path", "the likeliest way from texton to texton",
                                 "Transitions are those of the model: as seen in the examples, and jumps between like "
                                 "poses. Without --textons no "
                                 "texton comes twice.",
                                 "motex motion path dance.motex --from 3 --to 11\n"
                                 "motex motion path dance.motex --from 3 --to 11 --textons 6 -o path.bvh"});
}

}  // namespace motex::cli
