// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_motifs_footage.h"

#include <utility>

#include "closest.h"
#include "motex/people/footage_motifs.h"
#include "motex/people/paper_motifs.h"
#include "motex/project/motif_pictures.h"
#include "options_value.h"
#include "output_file.h"
#include "people_alphabet.h"
#include "people_motifs_paper.h"

namespace motex::cli {
namespace {

bool are_default(const FindMotifsOptions& options) {
  return to_json(options_value(options)) == to_json(options_value(FindMotifsOptions{}));
}

/// With collision matrices what they show can be drawn even where nothing repeats.
Drawing picture_of(const LoadedPeople& people, const std::vector<PaperSearch>& searches) {
  if (people.texture.alphabet.motifs.empty()) return draw_collisions(searches);
  return draw_motif_page(people.texture, *people.pictures, searches);
}

}  // namespace

bool is_series_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".csv" || extension == ".tsv" || extension == ".txt";
}

void FootageMotifs::run(const std::string& path, const MotifRequest& request, Session& session) {
  check_outputs(request.pictures, {".png", ".svg"}, session);
  source.path = path;
  source.check();
  if (session.flags.dry_run) return would_write(request.pictures, -1, session);
  LoadedPeople people = source.load(session.job(0, 0.6));
  const JobContext job = session.job(0.6, request.pictures.empty() ? 1 : 0.9);
  std::vector<MotifCandidate> candidates;
  std::vector<PaperSearch> searches;
  if (request.paper) {
    PaperMotifReport report = find_paper_motifs(people.texture, request.options, job);
    people.texture.alphabet = std::move(report.set);
    candidates = std::move(report.candidates);
    searches = std::move(report.searches);
    say_searches(searches, session);
  } else if (people.texture.alphabet.motifs.empty() || !are_default(request.options)) {
    MotifReport report = find_footage_motifs(people.texture, request.options, job);
    people.texture.alphabet = std::move(report.set);
    candidates = std::move(report.candidates);
  }
  const PeopleTexture& texture = people.texture;
  if (!request.pictures.empty() && texture.alphabet.motifs.empty() && searches.empty()) {
    session.warn("nothing repeats, so " + enumerate(request.pictures) + " is not written");
  } else if (!request.pictures.empty()) {
    const Drawing drawing = picture_of(people, searches);
    for (const std::string& picture : request.pictures) write_picture(picture, drawing);
    session.say("wrote " + enumerate(request.pictures));
  }
  Value object;
  object["input"] = path;
  object["frames"] = texture.num_frames();
  object["frames_per_sec"] = texture.frames_per_sec;
  object["takes"] = takes_value(texture);
  object["motifs"] = motifs_value(texture.alphabet);
  object["idle"] = spans_value(texture.alphabet.idle);
  object["candidates"] = candidates_value(candidates);
  if (request.paper) object["searches"] = searches_value(searches);
  object["options"] = options_value(request.options);
  session.result(object, alphabet_text(texture.alphabet, candidates, texture.frames_per_sec));
}

}  // namespace motex::cli
