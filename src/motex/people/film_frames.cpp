// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/film_frames.h"

#include <algorithm>
#include <string>

#include "motex/core/error.h"
#include "motex/people/cut_smoothness.h"

namespace motex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void check(const PeopleTexture& texture, const EditList& edits) {
  const std::size_t num_shots = edits.shots.size();
  if (num_shots == 0) throw InvalidInput("an edit list needs at least one shot");
  if (edits.cuts.size() != num_shots - (edits.loop ? 0 : 1))
    throw InvalidInput("an edit list of " + std::to_string(num_shots) + " shots has " +
                       std::to_string(num_shots - (edits.loop ? 0 : 1)) + " cuts, not " +
                       std::to_string(edits.cuts.size()));
  for (const Shot& shot : edits.shots)
    if (shot.last < shot.first || shot.last >= take_of(texture, shot.first).frames.end())
      throw InvalidInput("the shot of frames " + std::to_string(shot.first) + " to " + std::to_string(shot.last) +
                         " does not lie within one take");
  for (std::size_t c = 0; c < edits.cuts.size(); ++c) {
    const Cut& cut = edits.cuts[c];
    if (cut.from != edits.shots[c].last || cut.to != edits.shots[(c + 1) % num_shots].first)
      throw InvalidInput("cut " + std::to_string(c) + " goes from frame " + std::to_string(cut.from) + " to " +
                         std::to_string(cut.to) + ", which are not the ends of the shots that it joins");
    if (cut.transition_frames < 0) throw InvalidInput("a transition cannot have less than 0 frames");
  }
}

/// First half of T frames plays in the shot that is left, the rest in the one that is entered.
int before(int transition) { return (transition + 1) / 2; }
int after(int transition) { return transition / 2; }

}  // namespace

std::vector<int> transition_lengths(const PeopleTexture& texture, const EditList& edits) {
  check(texture, edits);
  const std::size_t num_shots = edits.shots.size();
  // A shot with a cut at both ends gives each half of it.
  const auto room = [&](std::size_t shot) {
    const int length = edits.shots[shot].last - edits.shots[shot].first + 1;
    const bool entered = edits.loop || shot > 0, left = edits.loop || shot + 1 < num_shots;
    return entered && left ? length / 2 : length;
  };
  std::vector<int> lengths;
  for (std::size_t c = 0; c < edits.cuts.size(); ++c) {
    const Cut& cut = edits.cuts[c];
    const int most_before = std::min(cut.to - take_of(texture, cut.to).frames.start, room(c));
    const int most_after = std::min(take_of(texture, cut.from).frames.end() - 1 - cut.from, room((c + 1) % num_shots));
    int length = cut.transition_frames;
    while (length > 0 && (before(length) > most_before || after(length) > most_after)) --length;
    lengths.push_back(length);
  }
  return lengths;
}

std::vector<FilmFrame> film_frames(const PeopleTexture& texture, const EditList& edits) {
  const std::vector<int> lengths = transition_lengths(texture, edits);
  std::vector<FilmFrame> film;
  std::vector<std::size_t> start_of_shot;
  for (std::size_t s = 0; s < edits.shots.size(); ++s) {
    start_of_shot.push_back(film.size());
    for (int frame = edits.shots[s].first; frame <= edits.shots[s].last; ++frame) {
      film.emplace_back();
      film.back().frame = frame, film.back().shot = static_cast<int>(s);
    }
  }
  for (std::size_t c = 0; c < lengths.size(); ++c) {
    const std::size_t entered = c + 1 < edits.shots.size() ? start_of_shot[c + 1] : film.size();
    for (int k = 0; k < lengths[c]; ++k) {
      FilmFrame& frame = film[(entered - at(before(lengths[c])) + at(k)) % film.size()];
      frame.frame = edits.cuts[c].from - before(lengths[c]) + 1 + k;
      frame.next_frame = edits.cuts[c].to - before(lengths[c]) + k;
      frame.weight = (k + 1.0) / (lengths[c] + 1.0);
      frame.cut = static_cast<int>(c);
    }
  }
  return film;
}

}  // namespace motex
