// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_alphabet.h"

#include <algorithm>

#include "text_table.h"

namespace motex::cli {

Value motifs_value(const MotifSet& alphabet) {
  Value list = Value::List();
  for (const Motif& motif : alphabet.motifs) {
    Value one;
    one["letter"] = motif.letter;
    one["name"] = motif.name;
    one["window"] = motif.window;
    one["distance"] = motif.distance;
    one["radius"] = motif.radius;
    one["exemplar"] = motif.exemplar;
    one["starts"] = Value::List();
    one["lengths"] = Value::List();
    for (const Occurrence& occurrence : motif.occurrences) {
      one["starts"].append(occurrence.start);
      one["lengths"].append(occurrence.length);
    }
    list.append(std::move(one));
  }
  return list;
}

std::string alphabet_table(const PeopleTexture& texture) {
  if (texture.alphabet.motifs.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"action", "name", "times", "seconds", "distance", "first frames"}};
  for (const Motif& motif : texture.alphabet.motifs) {
    std::string starts;
    constexpr std::size_t kMost = 6;
    for (std::size_t k = 0; k < std::min(kMost, motif.occurrences.size()); ++k)
      starts += (k == 0 ? "" : " ") + std::to_string(motif.occurrences[k].start);
    if (motif.occurrences.size() > kMost) starts += " …";
    rows.push_back({motif.letter, motif.name, std::to_string(motif.occurrences.size()),
                    fixed(motif.window / texture.frames_per_sec, 2), fixed(motif.distance, 3), starts});
  }
  return text_table(rows);
}

}  // namespace motex::cli
