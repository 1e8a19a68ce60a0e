// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_motifs_footage.h"

#include <utility>

#include "closest.h"
#include "motex/core/options_check.h"
#include "motex/people/footage_motifs.h"
#include "motex/project/motif_pictures.h"
#include "options_value.h"
#include "output_file.h"
#include "people_alphabet.h"
#include "text_table.h"

namespace motex::cli {
namespace {

bool are_default(const FindMotifsOptions& options) {
  return to_json(options_value(options)) == to_json(options_value(FindMotifsOptions{}));
}

Value candidates_value(const std::vector<MotifCandidate>& candidates) {
  Value list = Value::List();
  for (const MotifCandidate& candidate : candidates) {
    Value one;
    one["window"] = candidate.window;
    one["distance"] = candidate.distance;
    one["count"] = static_cast<std::int64_t>(candidate.starts.size());
    one["starts"] = candidate.starts;
    one["reason"] = candidate.reason;
    list.append(std::move(one));
  }
  return list;
}

std::string text_of(const PeopleTexture& texture, const std::vector<MotifCandidate>& candidates) {
  if (texture.alphabet.motifs.empty()) return "nothing repeats more often than by chance\n";
  std::string text = alphabet_table(texture);
  int idle = 0;
  for (const FrameSpan& span : texture.alphabet.idle) idle += span.length;
  text += "idle: " + fixed(idle / texture.frames_per_sec, 1) + " s in " + std::to_string(texture.alphabet.idle.size()) +
          " stretches\n";
  for (const MotifCandidate& candidate : candidates)
    if (!candidate.starts.empty())
      text += "no motif: " + std::to_string(candidate.starts.size()) + " × " + std::to_string(candidate.window) +
              " frames at " + std::to_string(candidate.starts[0]) + ": " + candidate.reason + "\n";
  return text;
}

}  // namespace

bool is_series_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".csv" || extension == ".tsv" || extension == ".txt";
}

void FootageMotifs::declare(Arguments& arguments) {
  arguments.value("--picture", "FILE",
                  "of footage: draw the alphabet, two performances of each action as curves and film strips (.png or "
                  ".svg); may be given several times",
                  pictures);
  source.declare_keying(arguments);
}

void FootageMotifs::run(const std::string& path, const FindMotifsOptions& options, Session& session) {
  check_options(options);
  check_outputs(pictures, {".png", ".svg"}, session);
  source.path = path;
  source.check();
  if (session.flags.dry_run) return would_write(pictures, -1, session);
  LoadedPeople people = source.load(session.job(0, 0.6));
  std::vector<MotifCandidate> candidates;
  if (people.texture.alphabet.motifs.empty() || !are_default(options)) {
    MotifReport report = find_footage_motifs(people.texture, options, session.job(0.6, pictures.empty() ? 1 : 0.9));
    people.texture.alphabet = std::move(report.set);
    candidates = std::move(report.candidates);
  }
  const PeopleTexture& texture = people.texture;
  if (!pictures.empty() && texture.alphabet.motifs.empty()) {
    session.warn("nothing repeats, so " + enumerate(pictures) + " is not written");
  } else if (!pictures.empty()) {
    const Drawing drawing = draw_motif_page(texture, *people.pictures);
    for (const std::string& picture : pictures) write_picture(picture, drawing);
    session.say("wrote " + enumerate(pictures));
  }
  Value object;
  object["input"] = path;
  object["frames"] = texture.num_frames();
  object["frames_per_sec"] = texture.frames_per_sec;
  object["takes"] = takes_value(texture);
  object["motifs"] = motifs_value(texture.alphabet);
  object["idle"] = spans_value(texture.alphabet.idle);
  object["candidates"] = candidates_value(candidates);
  object["options"] = options_value(options);
  session.result(object, text_of(texture, candidates));
}

}  // namespace motex::cli
