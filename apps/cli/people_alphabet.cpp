// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_alphabet.h"

#include <algorithm>
#include <utility>

#include "text_table.h"

namespace motex::cli {
namespace {

std::string first_frames(const std::vector<Occurrence>& occurrences) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, occurrences.size()); ++k)
    text += (k > 0 ? " " : "") + std::to_string(occurrences[k].start);
  return occurrences.size() > kMost ? text + " …" : text;
}

}  // namespace

Value motifs_value(const MotifSet& alphabet) {
  Value list = Value::List();
  for (const Motif& motif : alphabet.motifs) {
    std::vector<int> starts, lengths;
    std::vector<double> distances;
    for (const Occurrence& occurrence : motif.occurrences) {
      starts.push_back(occurrence.start);
      lengths.push_back(occurrence.length);
      distances.push_back(occurrence.distance);
    }
    Value one;
    one["letter"] = motif.letter;
    one["name"] = motif.name;
    one["window"] = motif.window;
    one["distance"] = motif.distance;
    one["radius"] = motif.radius;
    one["count"] = static_cast<std::int64_t>(starts.size());
    one["exemplar"] = motif.exemplar;
    one["starts"] = starts;
    one["lengths"] = lengths;
    one["distances"] = distances;
    list.append(std::move(one));
  }
  return list;
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

std::string alphabet_table(const MotifSet& alphabet, double frames_per_sec) {
  if (alphabet.motifs.empty()) return "";
  const bool has_names = std::any_of(alphabet.motifs.begin(), alphabet.motifs.end(),
                                     [](const Motif& motif) { return !motif.name.empty(); });
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](std::vector<std::string> row, const std::string& name, const std::string& seconds) {
    if (frames_per_sec > 0) row.insert(row.begin() + 3, seconds);
    if (has_names) row.insert(row.begin() + 1, name);
    rows.push_back(std::move(row));
  };
  add({"action", "times", "frames", "distance", "R", "first frames"}, "name", "seconds");
  for (const Motif& motif : alphabet.motifs)
    add({motif.letter, std::to_string(motif.occurrences.size()), std::to_string(motif.window), fixed(motif.distance, 3),
         fixed(motif.radius, 3), first_frames(motif.occurrences)},
        motif.name, frames_per_sec > 0 ? fixed(motif.window / frames_per_sec, 2) : "");
  return text_table(rows);
}

std::string alphabet_table(const PeopleTexture& texture) {
  return alphabet_table(texture.alphabet, texture.frames_per_sec);
}

std::string alphabet_text(const MotifSet& alphabet, const std::vector<MotifCandidate>& candidates,
                          double frames_per_sec) {
  std::string text = alphabet.motifs.empty() ? "nothing repeats more often than by chance\n"
                                             : alphabet_table(alphabet, frames_per_sec);
  int idle = 0;
  for (const FrameSpan& span : alphabet.idle) idle += span.length;
  text += "idle: " + (frames_per_sec > 0 ? fixed(idle / frames_per_sec, 1) + " s" : std::to_string(idle) + " frames") +
          " in " + std::to_string(alphabet.idle.size()) + " stretches\n";
  for (const MotifCandidate& candidate : candidates)
    if (!candidate.starts.empty())
      text += "no motif: " + std::to_string(candidate.starts.size()) + " × " + std::to_string(candidate.window) +
              " frames at " + std::to_string(candidate.starts[0]) + ": " + candidate.reason + "\n";
  return text;
}

}  // namespace motex::cli
