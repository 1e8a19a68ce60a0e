// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_film.h"

#include <algorithm>
#include <optional>

#include "closest.h"
#include "film_output.h"
#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/project/edit_list_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

const char* const kPlate = "plate";

Value cuts_value(const EditList& edits, const std::vector<CutReport>& reports) {
  Value cuts = Value(Value::List{});
  for (std::size_t k = 0; k < edits.cuts.size(); ++k) {
    const Cut& cut = edits.cuts[k];
    Value entry;
    entry["from"] = cut.from;
    entry["to"] = cut.to;
    entry["difference"] = cut.difference;
    entry["smoothness"] = cut.smoothness;
    for (const CutReport& report : reports) {
      if (report.cut != static_cast<int>(k)) continue;
      entry["transition_frames"] = report.transition_frames;
      entry["renderer"] = name_of(report.renderer);
    }
    cuts.append(entry);
  }
  return cuts;
}

Value performances_value(const PeopleTexture& texture, const EditList& edits) {
  Value performances = Value(Value::List{});
  for (const Performance& performance : edits.performances) {
    Value entry;
    entry["motif"] = performance.motif < 0 ? Value() : Value(motif_text(texture, performance.motif));
    entry["start"] = performance.start;
    entry["frames"] = performance.length;
    performances.append(entry);
  }
  return performances;
}

std::string performances_table(const PeopleTexture& texture, const EditList& edits) {
  std::vector<std::vector<std::string>> rows{{"action", "from s", "to s"}};
  const double rate = texture.frames_per_sec;
  for (const Performance& performance : edits.performances)
    rows.push_back({motif_text(texture, performance.motif), fixed(performance.start / rate, 2),
                    fixed((performance.start + performance.length) / rate, 2)});
  return edits.performances.empty() ? "" : text_table(rows);
}

}  // namespace

std::string motif_text(const PeopleTexture& texture, int motif) {
  if (motif < 0) return "stand";
  const Motif& found = texture.alphabet.motifs.at(static_cast<std::size_t>(motif));
  return found.name.empty() ? found.letter : found.name;
}

void FilmArguments::declare(Arguments& arguments) {
  declare_film_output(arguments, outputs);
  arguments.value("--edits", "FILE", "writes the shots and cuts too: .json or .otio (OpenTimelineIO); several times",
                  edit_outputs);
  arguments.value("--background", "FILE|COLOUR",
                  "puts the actor before a picture, a video (which starts again at its end), #rrggbb, black, white, "
                  "gray, green, blue, or the empty scene that was filmed (plate)",
                  background);
}

void FilmArguments::declare_looks(Arguments& arguments) {
  arguments.section("Transitions");
  arguments.options(render);
}

void FilmArguments::check(const Session& session) const {
  check_options(render);
  check_film_output(outputs, background, session);
  check_outputs(edit_outputs, {".json", ".otio"}, session);
}

std::vector<std::string> FilmArguments::paths() const {
  std::vector<std::string> all = outputs;
  all.insert(all.end(), edit_outputs.begin(), edit_outputs.end());
  return all;
}

void FilmArguments::write(const PeopleModel& model, const EditList& edits, std::optional<std::uint64_t> seed,
                          Value object, Session& session) const {
  if (background == kPlate && model.plate.pixels.empty())
    throw InvalidInput("--background plate: the model keeps no empty scene; name a picture or a colour");
  std::optional<Backdrop> backdrop;
  if (background == kPlate)
    backdrop.emplace(model.plate);
  else
    backdrop = backdrop_of(background, model.texture.width, model.texture.height, session.job());
  const FilmVideoReport report = write_film_video(model, edits, render, backdrop ? &*backdrop : nullptr,
                                                  {outputs.begin(), outputs.end()}, session.job(0.2, 1));
  for (const std::string& path : edit_outputs) write_edit_list(path, model.texture, edits);
  const double secs = report.num_frames / model.texture.frames_per_sec;
  session.say("wrote " + enumerate(paths()) + ": " + std::to_string(report.num_frames) + " frames, " + fixed(secs, 1) +
              " s, " + std::to_string(edits.cuts.size()) + (edits.cuts.size() == 1 ? " cut" : " cuts") +
              ", without sound" + (seed ? ", seed " + std::to_string(*seed) : ""));
  if (seed) object["seed"] = *seed;
  object["output"] = paths();
  object["frames"] = report.num_frames;
  object["film_secs"] = secs;
  object["width"] = model.texture.width;
  object["height"] = model.texture.height;
  object["loop"] = edits.loop;
  object["sound"] = false;
  object["shots"] = static_cast<int>(edits.shots.size());
  object["cuts"] = cuts_value(edits, report.cuts);
  object["performances"] = performances_value(model.texture, edits);
  object["transitions"] = options_value(render);
  object["secs"] = Session::secs();
  session.result(object, performances_table(model.texture, edits));
}

}  // namespace motex::cli
