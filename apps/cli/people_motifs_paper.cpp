// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_motifs_paper.h"

#include <limits>
#include <string>
#include <utility>

#include "text_table.h"

namespace motex::cli {
namespace {

double distance_of(const WindowPair& pair) {
  return pair.first < 0 ? std::numeric_limits<double>::quiet_NaN() : pair.distance;
}

}  // namespace

Value searches_value(const std::vector<PaperSearch>& searches) {
  Value list = Value::List();
  for (const PaperSearch& search : searches) {
    Value one;
    one["window"] = search.window;
    one["distance_found"] = distance_of(search.found.in_matrix);
    one["distance_searched"] = distance_of(search.found.closest);
    one["distance_exact"] = search.exact;
    one["found_over_exact"] = search.matrix_over_exact();
    one["searched_over_exact"] = search.closest_over_exact();
    one["radius"] = search.found.radius;
    one["alphabet"] = search.found.alphabet;
    one["compared"] = search.found.num_compared;
    one["collisions"] = static_cast<std::int64_t>(search.found.collisions.back().cells.size());
    list.append(std::move(one));
  }
  return list;
}

void say_searches(const std::vector<PaperSearch>& searches, Session& session) {
  for (const PaperSearch& search : searches) {
    const std::string frames = std::to_string(search.window) + " frames: ";
    if (search.found.in_matrix.first < 0) {
      session.say(frames + "no two windows collide");
      continue;
    }
    session.say(frames + "closest pair of the collision matrix " + fixed(search.found.in_matrix.distance, 4) + ", " +
                fixed(search.matrix_over_exact(), 3) + " × the exact " + fixed(search.exact, 4) +
                "; after a search around it " + fixed(search.closest_over_exact(), 3) + " ×; R " +
                fixed(search.found.radius, 4));
  }
}

}  // namespace motex::cli
