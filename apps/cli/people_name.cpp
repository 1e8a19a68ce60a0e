// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "commands.h"
#include "motex/core/error.h"
#include "motex/people/script.h"
#include "motex/project/people_model_file.h"
#include "output_file.h"

namespace motex::cli {
namespace {

struct Name {
  std::string path, word, name, output;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex people learn", path);
    arguments.positional("A", "letter or present name of the action", word);
    arguments.positional("NAME", "to be used in scripts; '' takes the name away", name).set =
        [this](const std::string& text) { name = text; };
    arguments.value("-o,--output", "OUT", "the model with that name (.motex); default: MODEL itself", output);
  }

  void run(Session& session) {
    if (!output.empty()) check_output(output, {".motex"}, session);
    PeopleModel model = load_people_model(path);
    MotifSet& alphabet = model.texture.alphabet;
    const int number = motif_named(word, alphabet);
    Motif& motif = alphabet.motifs[static_cast<std::size_t>(number)];
    check_name(alphabet, motif);
    Value object;
    object["letter"] = motif.letter;
    object["before"] = motif.name;
    object["name"] = name;
    const std::string before = motif.name;
    motif.name = name;
    const std::string target = output.empty() ? path : output;
    object["output"] = target;
    if (session.flags.dry_run)
      object["dry_run"] = true;
    else
      save_people_model(target, model);
    session.say((session.flags.dry_run ? "would change " : "changed ") + target + ": " + motif.letter +
                (name.empty() ? " has no name" : " is called '" + name + "'") +
                (before.empty() ? "" : "; it was '" + before + "'"));
    session.result(object, "");
  }

 private:
  void check_name(const MotifSet& alphabet, const Motif& motif) const {
    const auto is_bad = [](char c) { return c == ',' || c == ';' || static_cast<unsigned char>(c) < ' '; };
    if (std::any_of(name.begin(), name.end(), is_bad))
      throw InvalidInput("NAME: '" + name + "' has a comma, a semicolon or a control character, which scripts use");
    if (name == "idle" || name == "stand")
      throw InvalidInput("NAME: '" + name + "' means standing still in scripts; choose another");
    for (const Motif& other : alphabet.motifs)
      if (&other != &motif && !name.empty() && (other.name == name || other.letter == name))
        throw InvalidInput("NAME: '" + name + "' is what action " + other.letter + " is called");
  }
};

}  // namespace

Command people_name() {
  return make_command<Name>({"people name", "give an action a name", "",
                             "motex people name kata.motex A \"high kick\"\n"
                             "motex people name kata.motex \"high kick\" '' -o other.motex"});
}

}  // namespace motex::cli
