// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motion_texton.h"

#include "closest.h"
#include "command.h"
#include "commands.h"
#include "motex/project/motion_texture_file.h"
#include "output_file.h"
#include "text_table.h"
#include "texton_argument.h"

namespace motex::cli {
namespace {

using Kind = ModelEdit::Kind;

std::string labels(const MotionTexture& model, const std::vector<int>& textons) {
  std::vector<std::string> words;
  for (const int texton : textons) words.push_back(texton_label(model, texton));
  return (words.size() == 1 ? "texton " : "textons ") + enumerate(words);
}

}  // namespace

Value edits_value(const MotionTexture& model) {
  Value list = Value::List();
  for (const ModelEdit& edit : model.edits) list.append(edit_text(edit));
  return list;
}

void ModelEditing::declare_model(Arguments& arguments) {
  arguments.positional("MODEL", "made by motex motion learn", model_path);
}

void ModelEditing::declare_output(Arguments& arguments) {
  arguments.value("-o,--output", "OUT", "the edited model (.motex); default: MODEL itself, where undo takes it back",
                  output);
}

void ModelEditing::open(Session& session) {
  if (!output.empty()) check_output(output, {".motex"}, session);
  learned = load_learned_motion_texture(model_path);
  applied = apply_edits(learned);
}

void ModelEditing::write(Value object, const std::string& said, Session& session) {
  const std::string target = output.empty() ? model_path : output;
  object["output"] = target;
  object["edits"] = edits_value(learned);
  if (session.flags.dry_run)
    object["dry_run"] = true;
  else
    save_motion_texture(target, learned);
  session.say((session.flags.dry_run ? "would change " : "changed ") + target + ": " + said);
  session.result(object, "");
}

void ModelEditing::commit(const ModelEdit& edit, const std::string& done, Session& session) {
  const EditReport report = add_edit(learned, edit);
  if (!report.lost.empty())
    session.warn("the endless dance does not reach " + labels(applied, report.lost) + " any more");
  if (!report.gained.empty()) session.warn("the endless dance now reaches " + labels(applied, report.gained));
  Value object;
  object["edit"] = edit_text(edit);
  object["lost"] = report.lost;
  object["gained"] = report.gained;
  write(object, done + "; motex motion texton undo takes it back", session);
}

namespace {

struct NameTexton : ModelEditing {
  std::string texton, name;

  void declare(Arguments& arguments) {
    declare_model(arguments);
    arguments.positional("T", "number or present name", texton);
    arguments.positional("NAME", "to be used wherever a texton's number is; '' takes the name away", name).set =
        [this](const std::string& text) { name = text; };
    declare_output(arguments);
  }

  void run(Session& session) {
    open(session);
    const int number = texton_number(applied, "T", texton);
    commit({Kind::kName, {number}, 1, name},
           name.empty() ? "texton " + std::to_string(number) + " has no name"
                        : "texton " + std::to_string(number) + " is called '" + name + "'",
           session);
  }
};

/// drop, keep and merge: a verb and textons.
struct ManyTextons : ModelEditing {
  std::vector<std::string> textons;
  std::vector<int> numbers;

  void declare(Arguments& arguments) {
    declare_model(arguments);
    arguments.positional("T", "number or name; several", textons).required = true;
    declare_output(arguments);
  }

  void open_with_textons(Session& session) {
    open(session);
    numbers = texton_numbers(applied, "T", textons);
  }
};

struct DropTextons : ManyTextons {
  void run(Session& session) {
    open_with_textons(session);
    commit({Kind::kDrop, numbers}, "dropped " + labels(applied, numbers), session);
  }
};

struct KeepTextons : ManyTextons {
  void run(Session& session) {
    open_with_textons(session);
    commit({Kind::kKeep, numbers}, "kept " + labels(applied, numbers) + " alone", session);
  }
};

struct MergeTextons : ManyTextons {
  void run(Session& session) {
    open_with_textons(session);
    if (numbers.size() < 2) throw InvalidInput("T: merging needs two textons or more; the first takes in the others");
    const std::vector<int> others(numbers.begin() + 1, numbers.end());
    commit({Kind::kMerge, numbers}, "merged " + labels(applied, others) + " into " + texton_label(applied, numbers[0]),
           session);
  }
};

struct WeighTransition : ModelEditing {
  std::string from, to;
  double factor = 1;

  void declare(Arguments& arguments) {
    declare_model(arguments);
    arguments.value("--from", "T", "the texton before (default: any)", from);
    arguments.value("--to", "T", "the texton after", to).required = true;
    arguments
        .value("--factor", "F", "how much likelier than now, against its alternatives: 0 forbids, 10 prefers", factor)
        .required = true;
    declare_output(arguments);
  }

  void run(Session& session) {
    if (!(factor >= 0 && factor <= 1e6)) throw InvalidInput("--factor: " + fixed(factor, 6) + " is outside 0 … 1e6");
    open(session);
    const int b = texton_number(applied, "--to", to);
    const int a = from.empty() ? -1 : texton_number(applied, "--from", from);
    const std::string what =
        a < 0 ? "the transitions to " + texton_label(applied, b)
              : "the transition from " + texton_label(applied, a) + " to " + texton_label(applied, b);
    commit({Kind::kWeight, {a, b}, factor}, factor == 0 ? "forbade " + what : "weighed " + what, session);
  }
};

struct UndoEdit : ModelEditing {
  int edit = -1;

  void declare(Arguments& arguments) {
    declare_model(arguments);
    arguments.value("--edit", "K", "that one, as list numbers them (default: the last)", edit).set =
        [this](const std::string& text) {
          parse_value("--edit", text, edit);
          if (edit < 0) throw InvalidInput("--edit: " + text + " is below 0");
        };
    declare_output(arguments);
  }

  void run(Session& session) {
    if (!output.empty()) check_output(output, {".motex"}, session);
    learned = load_learned_motion_texture(model_path);
    const ModelEdit undone = undo_edit(learned, edit);
    Value object;
    object["undone"] = edit_text(undone);
    const std::size_t left = learned.edits.size();
    write(object,
          "took back '" + edit_text(undone) + "'; " +
              (left == 0   ? "the model is as it was learned"
               : left == 1 ? "1 edit is left"
                           : std::to_string(left) + " edits are left"),
          session);
  }
};

}  // namespace

Command motion_texton_name() {
  return make_command<NameTexton>({"motion texton name", "give a texton a name", "",
                                   "motex motion texton name dance.motex 3 turn\n"
                                   "motex motion path dance.motex --from turn --to 7"});
}

Command motion_texton_drop() {
  return make_command<DropTextons>({"motion texton drop", "take textons out of the dance",
                                    "They keep their numbers. What led to them leads to the next nearest poses.",
                                    "motex motion texton drop dance.motex 4 5\nmotex motion texton undo dance.motex"});
}

Command motion_texton_keep() {
  return make_command<KeepTextons>({"motion texton keep", "drop all other textons", "",
                                    "motex motion texton keep dance.motex 3 7 turn -o three.motex"});
}

Command motion_texton_merge() {
  return make_command<MergeTextons>(
      {"motion texton merge", "make one texton of several",
       "The first takes the examples and transitions of the others and is fitted anew to all of them.",
       "motex motion texton merge dance.motex 2 9"});
}

Command motion_texton_weight() {
  return make_command<WeighTransition>(
      {"motion texton weight", "forbid a transition, or make it likelier or rarer",
       "The transition's count is multiplied by the factor; the row is normalised again.",
       "motex motion texton weight dance.motex --from 3 --to 7 --factor 10\n"
       "motex motion texton weight dance.motex --from 3 --to turn --factor 0\n"
       "motex motion texton weight dance.motex --to 7 --factor 0.2"});
}

Command motion_texton_undo() {
  return make_command<UndoEdit>({"motion texton undo", "take an edit of the textons back", "",
                                 "motex motion texton undo dance.motex\n"
                                 "motex motion texton undo dance.motex --edit 0 -o other.motex"});
}

}  // namespace motex::cli
