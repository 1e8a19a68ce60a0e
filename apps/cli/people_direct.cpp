// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/project/edit_list_file.h"
#include "motex/project/load_beats.h"
#include "options_value.h"
#include "output_file.h"
#include "people_film.h"

namespace motex::cli {
namespace {

struct Direct {
  std::string model_path, script, beats_path, from_edits;
  FilmArguments film;
  DirectOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex people learn", model_path);
    arguments.value("--script", "TEXT",
                    "actions by name or letter, with commas: \"stand, high kick x2, bow\"; x2 = twice, 'stand 3s' = "
                    "so long, * = free play ('* 10s')",
                    script);
    arguments.value("--from-edits", "JSON", "instead of a script: an edit list that --edits wrote, perhaps changed",
                    from_edits);
    film.declare(arguments);
    arguments.value("--beats", "FILE",
                    "times in seconds, one a line, or a .wav to listen to: cuts and the accents of actions are drawn "
                    "to them",
                    beats_path);
    arguments.section("Direction");
    arguments.options(options);
    film.declare_looks(arguments);
  }

  void run(Session& session) {
    if (script.empty() == from_edits.empty())
      throw InvalidInput(script.empty() ? "--script TEXT (or --from-edits JSON) says what is to be done"
                                        : "--script and --from-edits exclude each other");
    check_options(options);
    film.check(session);
    const std::vector<double> beats =
        beats_path.empty() ? std::vector<double>{} : load_beats(beats_path, session.job());
    PeopleModel model = load_people_model(model_path);
    Value object;
    EditList edits;
    if (from_edits.empty()) {
      const std::vector<Direction> directions = parse_script(script, model.texture.alphabet);
      complete_cuts(model, session.job(0, 0.15));
      const DirectReport report = direct(model.texture, directions, options, beats, session.job(0.15, 0.2));
      edits = report.edits;
      object["script"] = script;
      object["longest_latency_secs"] = report.longest_latency_secs();
      object["latency_secs"] = report.latency_secs;
      object["options"] = options_value(options);
    } else {
      edits = parse_edit_list(read_file(from_edits), from_edits, model.texture);
    }
    if (session.flags.dry_run) return would_write(film.paths(), edits.num_frames(), session);
    film.write(model, edits, from_edits.empty() ? std::optional(options.seed) : std::nullopt, object, session);
  }
};

}  // namespace

Command people_direct() {
  return make_command<Direct>(
      {"people direct", "make a film of an actor after a script of the actions that the model knows",
       "Between actions the film goes the way that is cheapest in cuts and waiting; at each action it may fork from "
       "one "
       "performance to another where both are alike. A cut is carried by a morph while both takes play on. Models hold "
       "no sound, so films have none. motex people info MODEL lists the actions.",
       "motex people direct kata.motex --script \"stand, high kick x2, bow\" -o film.mov\n"
       "motex people direct kata.motex --script \"A B A\" -o film.mp4 --background beach.png --edits film.otio\n"
       "motex people direct kata.motex --script \"bow, *\" -o loop.webm --loop\n"
       "motex people direct kata.motex --script \"* 30s\" --beats song.wav -o dance.mov --edits dance.json\n"
       "motex people direct kata.motex --from-edits dance.json -o dance.mkv --force"});
}

}  // namespace motex::cli
