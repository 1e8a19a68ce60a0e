// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>

#include "closest.h"
#include "commands.h"
#include "film_output.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/project/crowd.h"
#include "motex/project/film_video.h"
#include "motex/project/video_outputs.h"
#include "options_value.h"
#include "output_file.h"

namespace motex::cli {
namespace {

struct MakeCrowd {
  std::vector<std::string> models, outputs;
  std::string background, cues_path;
  double secs = 0;
  CrowdOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex people learn; several take turns", models).required = true;
    declare_film_output(arguments, outputs);
    arguments.value("--secs", "S", "length in seconds", secs).required = true;
    arguments.value("--background", "FILE|COLOUR", "what they stand before: a picture, a video, #rrggbb, black, …",
                    background);
    arguments.value("--cues", "FILE",
                    "when each one comes and what is done then, one line a person from the farthest: seconds, then a "
                    "script as of people direct, if any (\"1.5 stand 2s, high kick x2\"); afterwards free play",
                    cues_path);
    arguments.section("Crowd");
    arguments.options(options);
  }

  void run(Session& session) {
    check_options(options);
    if (!(secs > 0 && secs <= 36000)) throw InvalidInput("--secs: a film is longer than 0 and at most 36000 seconds");
    check_film_output(outputs, background, session);
    const std::vector<Cue> cues = cues_path.empty() ? std::vector<Cue>{} : parse_cues(read_file(cues_path), cues_path);
    std::vector<PeopleModel> loaded;
    for (const std::string& path : models)
      complete_cuts(loaded.emplace_back(load_people_model(path)), session.job(0, 0));
    const double rate = loaded[0].texture.frames_per_sec;
    const int num_frames = std::max(1, static_cast<int>(std::lround(secs * rate)));
    if (session.flags.dry_run) return would_write(outputs, num_frames, session);
    Crowd crowd(loaded, num_frames, options, {}, {}, session.job(), cues);
    write(crowd, num_frames, rate, session.job());
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(num_frames) + " frames, " +
                std::to_string(options.people) + " people, seed " + std::to_string(options.seed));
    session.result(value(crowd, num_frames), "");
  }

 private:
  void write(Crowd& crowd, int num_frames, double rate, const JobContext& job) const {
    std::optional<Backdrop> backdrop = backdrop_of(background, crowd.width(), crowd.height(), job);
    VideoOutputs videos({outputs.begin(), outputs.end()}, crowd.width(), crowd.height(), {rate, !backdrop}, job);
    for (int t = 0; t < num_frames; ++t) {
      job.check_cancelled();
      job.progress("drawing frames", static_cast<double>(t) / num_frames);
      Image picture = backdrop ? backdrop->frame(t) : Image(crowd.width(), crowd.height());
      crowd.next(picture);
      videos.write(picture);
    }
    videos.finish();
  }

  Value value(const Crowd& crowd, int num_frames) const {
    Value object;
    object["output"] = outputs;
    object["frames"] = num_frames;
    object["people"] = Value::List();
    for (const Extra& extra : crowd.extras()) {
      Value one;
      one["model"] = models[static_cast<std::size_t>(extra.model)];
      one["mirrored"] = extra.mirrored;
      one["scale"] = extra.scale;
      one["x"] = extra.x;
      one["feet"] = extra.feet;
      one["start"] = extra.start;
      one["cuts"] = static_cast<std::int64_t>(extra.edits.cuts.size());
      object["people"].append(std::move(one));
    }
    object["options"] = options_value(options);
    object["seed"] = options.seed;
    return object;
  }
};

}  // namespace

Command people_crowd() {
  return make_command<MakeCrowd>(
      {"people crowd", "a crowd of extras out of one actor or several, one behind the other in one picture",
       "Each plays on its own (as people play does) at a place of its own: who is farther away is smaller, stands "
       "higher and is hidden by who is nearer.",
       "motex people crowd kata.motex -o crowd.mp4 --secs 10 --background street.png\n"
       "motex people crowd kata.motex -o march.mov --secs 20 --people 3 --cues entrances.txt\n"
       "motex people crowd one.motex two.motex -o extras.mov --secs 20 --people 12 --depth 0.7 --seed 4"});
}

}  // namespace motex::cli
