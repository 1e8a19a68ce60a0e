// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <filesystem>

#include "commands.h"
#include "motex/core/options_check.h"
#include "motex/project/learn_people.h"
#include "options_value.h"
#include "output_file.h"
#include "people_alphabet.h"
#include "people_source.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Learn {
  std::vector<std::string> videos;
  std::string output;
  PeopleSourceArguments source;
  LearnPeopleOptions options;
  FindMotifsOptions motifs;
  FindCutsOptions cuts;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO", "of a fixed camera; several are clips of one actor", videos).required = true;
    arguments.value("-o,--output", "MODEL", "model to write (.motex)", output).required = true;
    arguments.options(options);
    source.declare_keying(arguments);
    arguments.section("Alphabet of actions");
    arguments.options(motifs);
    arguments.section("Cuts");
    arguments.options(cuts);
  }

  void run(Session& session) {
    check_output(output, {".motex"}, session);
    check_options(motifs);
    check_options(cuts);
    for (const std::string& video : videos) {
      source.path = video;
      source.check();
      if (is_people_model(video)) throw InvalidInput(video + ": a model; learning starts from videos");
    }
    if (session.flags.dry_run) return would_write({output}, -1, session);
    PeopleFootageOptions footage = source.options;
    footage.key.plate_picture = source.plate_picture;
    footage.key.garbage_mask = source.garbage_mask;
    footage.cuts = !source.one_shot;
    const LearnedPeople learned =
        learn_people({videos.begin(), videos.end()}, footage, motifs, cuts, options, session.job(0, 0.99));
    session.job().check_cancelled();
    save_people_model(output, learned.model);
    tell(learned, session);
    session.result(value(learned), alphabet_table(learned.model.texture));
  }

 private:
  void tell(const LearnedPeople& learned, Session& session) const {
    const PeopleTexture& texture = learned.model.texture;
    session.say("wrote " + output + ": " + std::to_string(texture.num_frames()) + " frames, " +
                std::to_string(texture.takes.size()) + (texture.takes.size() == 1 ? " take, " : " takes, ") +
                std::to_string(texture.alphabet.motifs.size()) + " actions, " +
                fixed(static_cast<double>(learned.model.footage_bytes()) / 1e6 / learned.report.footage_secs, 2) +
                " MB a second, " + fixed(session.secs(), 1) + " s");
    if (texture.alphabet.motifs.empty())
      session.warn("nothing is repeated in the footage, so there is no action to ask for; play still works");
    else
      session.say("next: motex people direct " + output + " --script \"" + texture.alphabet.motifs[0].letter +
                  "\" -o film.mp4");
  }

  Value value(const LearnedPeople& learned) const {
    const PeopleTexture& texture = learned.model.texture;
    Value object;
    object["model"] = output;
    object["clips"] = Value::List();
    for (const LearnPeopleReport::Clip& clip : learned.report.clips) {
      Value one;
      one["video"] = clip.video.string();
      one["frames"] = clip.num_frames;
      one["shots"] = clip.num_shots;
      one["takes"] = clip.num_takes;
      object["clips"].append(std::move(one));
    }
    object["frames"] = texture.num_frames();
    object["frames_per_sec"] = texture.frames_per_sec;
    object["footage_secs"] = learned.report.footage_secs;
    object["footage_bytes"] = learned.model.footage_bytes();
    object["takes"] = takes_value(texture);
    object["motifs"] = motifs_value(texture.alphabet);
    object["idle"] = spans_value(texture.alphabet.idle);
    object["cuts"] = static_cast<std::int64_t>(texture.cuts.cuts.size());
    Value stages;
    stages["keying"] = learned.report.keying_secs;
    stages["motifs"] = learned.report.motif_secs;
    stages["cuts"] = learned.report.cut_secs;
    object["stage_secs"] = std::move(stages);
    object["options"] = options_value(options);
    object["secs"] = Session::secs();
    return object;
  }
};

}  // namespace

Command people_learn() {
  return make_command<Learn>(
      {"people learn", "learn an actor: cut out, what he or she repeats, where films can be cut",
       "For an actor before a green, blue or plain screen, or any scene that stands still. Every action should be "
       "performed several times, with a moment of standing in between. Hard cuts split the footage; several people "
       "apart from one another are takes of their own. Clips must agree in frame rate; pictures of another size are "
       "scaled to fit into the first clip's.",
       "motex people learn kata.mp4 -o kata.motex\n"
       "motex people learn take1.mov take2.mov -o yoga.motex --mirror\n"
       "motex people learn stage.mp4 -o stage.motex --plate empty.png --lossless --json"});
}

}  // namespace motex::cli
