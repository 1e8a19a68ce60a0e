// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/motif_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/people/cut_smoothness.h"
#include "motex/plot/charts.h"
#include "motex/plot/colour.h"

namespace motex {
namespace {

constexpr Rgba kInk{40, 40, 40, 255};

constexpr double kCollisionCells = 150;  // across a picture
constexpr double kBrightest = 0.5;       // of the most collisions: the scale ends there

void need_motifs(const MotifSet& alphabet) {
  if (alphabet.motifs.empty()) throw InvalidInput("nothing repeats: there is nothing to draw");
}

const Occurrence& exemplar_of(const Motif& motif) {
  const auto found = std::find_if(motif.occurrences.begin(), motif.occurrences.end(),
                                  [&](const Occurrence& one) { return one.start == motif.exemplar; });
  return found == motif.occurrences.end() ? motif.occurrences.front() : *found;
}

/// Index of the occurrence closest to the exemplar, which is another one.
const Occurrence& closest_of(const Motif& motif) {
  const Occurrence& exemplar = exemplar_of(motif);
  const Occurrence* best = nullptr;
  for (const Occurrence& one : motif.occurrences)
    if (&one != &exemplar && (best == nullptr || one.distance < best->distance)) best = &one;
  return best == nullptr ? exemplar : *best;
}

std::string title_of(const Motif& motif) {
  const std::string name = motif.name.empty() ? motif.letter : motif.letter + " \"" + motif.name + "\"";
  return name + ", " + std::to_string(motif.occurrences.size()) + " times";
}

std::string place_of(const PeopleTexture& texture, int frame) {
  const Take& take = take_of(texture, frame);
  return "frame " + std::to_string(take.source_start + frame - take.frames.start);
}

/// Common box of the actor in some frames, a little wider, inside the picture.
BoundingBox view_of(const PeopleTexture& texture, int first, int last) {
  BoundingBox view{texture.width, texture.height, -1, -1};
  for (int t = first; t <= last; ++t) {
    const BoundingBox& box = texture.silhouettes[static_cast<std::size_t>(t)].box;
    if (box.empty()) continue;
    view = {std::min(view.left, box.left), std::min(view.top, box.top), std::max(view.right, box.right),
            std::max(view.bottom, box.bottom)};
  }
  if (view.empty()) return {0, 0, texture.width - 1, texture.height - 1};
  const int margin = std::max(4, view.height() / 12);
  return {std::max(0, view.left - margin), std::max(0, view.top - margin),
          std::min(texture.width - 1, view.right + margin), std::min(texture.height - 1, view.bottom + margin)};
}

Image part_of(FramePictures& pictures, int frame, const BoundingBox& view) {
  return crop(pictures.picture(frame), view.left, view.top, view.width(), view.height());
}

/// One row: frames at equal parts of an occurrence.
Drawing strip_of(const PeopleTexture& texture, FramePictures& pictures, const Occurrence& one, int columns,
                 double height) {
  const BoundingBox view = view_of(texture, one.start, one.start + one.length - 1);
  const double width = height * view.width() / view.height(), gap = 4;
  Drawing row;
  row.width = columns * (width + gap), row.height = height + 18;
  for (int k = 0; k < columns; ++k) {
    const int frame = one.start + (columns == 1 ? one.length / 2 : k * (one.length - 1) / (columns - 1));
    row.add(Picture{{k * (width + gap), 0}, width, height, part_of(pictures, frame, view)});
  }
  row.add(Text{{0, height + 13},
               place_of(texture, one.start) + " to " + place_of(texture, one.start + one.length - 1),
               10,
               kInk});
  return row;
}

/// Drawings one below the other.
Drawing stacked(const std::vector<Drawing>& rows, double gap) {
  Drawing out;
  for (const Drawing& row : rows) {
    append(out, row, {gap, out.height + gap});
    out.height += row.height + gap;
    out.width = std::max(out.width, row.width + 2 * gap);
  }
  out.height += gap;
  return out;
}

Drawing heading(const std::string& text) {
  Drawing line;
  line.width = 7.5 * static_cast<double>(text.size()), line.height = 18;
  line.add(Text{{0, 14}, text, 13, kInk, Align::kLeft, true});
  return line;
}

/// The most collisions of each square of windows, both triangles.
Matrix pooled(const CollisionMatrix& matrix, int num_windows, int side) {
  const Index cells = (num_windows + side - 1) / side;
  Matrix out = Matrix::Zero(cells, cells);
  for (const Collision& collision : matrix.cells) {
    double& cell = out(collision.row / side, collision.column / side);
    cell = std::max(cell, static_cast<double>(collision.count));
  }
  return out.cwiseMax(out.transpose().eval());
}

Drawing matches_of(const MotifSet& alphabet, const Signal& signal, const std::function<std::string(int)>& place,
                   int most) {
  std::vector<Drawing> panels;
  for (const Motif& motif : alphabet.motifs) {
    if (static_cast<int>(panels.size()) == most) break;
    LinePlot plot;
    plot.title = title_of(motif);
    plot.x_axis.label = "frame of the action", plot.y_axis.label = signal.name;
    plot.size = {360, 230};
    for (const Occurrence* one : {&exemplar_of(motif), &closest_of(motif)}) {
      Series series{"from " + place(one->start), {}, {}, Mark::kLine, {}};
      for (int t = 0; t < one->length; ++t) {
        series.x.push_back(t);
        series.y.push_back(signal.values[static_cast<std::size_t>(one->start + t)]);
      }
      plot.series.push_back(std::move(series));
    }
    panels.push_back(draw(plot));
  }
  return grid(panels, static_cast<int>(std::min<std::size_t>(3, panels.size())), "");
}

}  // namespace

Drawing draw_collisions(const std::vector<PaperSearch>& searches) {
  if (searches.empty()) throw InvalidInput("no collision matrix: there is nothing to draw");
  std::vector<Drawing> panels;
  for (const PaperSearch& search : searches)
    for (const CollisionMatrix& matrix : search.found.collisions) {
      HeatMap map;
      map.title = std::to_string(search.window) + " frames, iteration " + std::to_string(matrix.iteration);
      map.x_label = map.y_label = "first frame of the window";
      map.value_label = "collisions";
      map.units_per_cell = std::max(1.0, std::ceil(static_cast<double>(search.num_windows) / kCollisionCells));
      map.values = pooled(matrix, search.num_windows, static_cast<int>(map.units_per_cell));
      map.min = 0, map.max = std::max(1.0, kBrightest * map.values.maxCoeff());
      map.size = {420, 400};
      panels.push_back(draw(map));
    }
  return grid(panels, static_cast<int>(searches[0].found.collisions.size()), "");
}

Drawing draw_motif_matches(const PeopleTexture& texture, int most) {
  need_motifs(texture.alphabet);
  Signal aspect = signal_named(measure_signals(texture), "aspect");
  aspect.name = "width / height";
  return matches_of(
      texture.alphabet, aspect, [&](int frame) { return place_of(texture, frame); }, most);
}

Drawing draw_motif_matches(const MotifSet& alphabet, const Signal& signal, int most) {
  need_motifs(alphabet);
  return matches_of(
      alphabet, signal, [](int frame) { return "frame " + std::to_string(frame); }, most);
}

Drawing draw_filmstrips(const PeopleTexture& texture, FramePictures& pictures, int most, int rows, int columns) {
  need_motifs(texture.alphabet);
  constexpr double kHeight = 110;
  std::vector<Drawing> lines;
  for (int k = 0; k < std::min(most, static_cast<int>(texture.alphabet.motifs.size())); ++k) {
    const Motif& motif = texture.alphabet.motifs[static_cast<std::size_t>(k)];
    lines.push_back(heading(title_of(motif)));
    lines.push_back(strip_of(texture, pictures, exemplar_of(motif), columns, kHeight));
    std::vector<const Occurrence*> others;
    for (const Occurrence& one : motif.occurrences)
      if (&one != &exemplar_of(motif)) others.push_back(&one);
    std::stable_sort(others.begin(), others.end(),
                     [](const Occurrence* a, const Occurrence* b) { return a->distance < b->distance; });
    for (std::size_t other = 0; other + 1 < static_cast<std::size_t>(rows) && other < others.size(); ++other)
      lines.push_back(strip_of(texture, pictures, *others[other], columns, kHeight));
  }
  return stacked(lines, 8);
}

Drawing draw_alphabet(const PeopleTexture& texture, FramePictures& pictures) {
  need_motifs(texture.alphabet);
  constexpr double kHeight = 130, kWidth = 170;
  std::vector<Drawing> cards;
  for (const Motif& motif : texture.alphabet.motifs) {
    const Occurrence& one = exemplar_of(motif);
    const BoundingBox view = view_of(texture, one.start, one.start + one.length - 1);
    const double scale = std::min(kHeight / view.height(), (kWidth - 20) / view.width());
    Drawing card;
    card.width = kWidth, card.height = kHeight + 44;
    card.add(Picture{{(kWidth - scale * view.width()) / 2, kHeight - scale * view.height()},
                     scale * view.width(),
                     scale * view.height(),
                     part_of(pictures, one.start + one.length / 2, view)});
    card.add(Text{{kWidth / 2, kHeight + 18},
                  title_of(motif),
                  13,
                  unit_colour(static_cast<int>(cards.size())),
                  Align::kCentre,
                  true});
    const double secs = motif.window / texture.frames_per_sec;
    card.add(
        Text{{kWidth / 2, kHeight + 34},
             std::to_string(std::lround(10 * secs) / 10) + "." + std::to_string(std::lround(10 * secs) % 10) + " s",
             11,
             kInk,
             Align::kCentre});
    cards.push_back(std::move(card));
  }
  return grid(cards, static_cast<int>(std::min<std::size_t>(6, cards.size())), "");
}

Drawing draw_motif_page(const PeopleTexture& texture, FramePictures& pictures,
                        const std::vector<PaperSearch>& searches) {
  std::vector<Drawing> parts;
  if (!searches.empty()) parts = {heading("Collision matrix"), draw_collisions(searches)};
  for (Drawing& part :
       std::vector<Drawing>{heading("Actions"), draw_alphabet(texture, pictures), heading("Two performances of each"),
                            draw_motif_matches(texture), draw_filmstrips(texture, pictures)})
    parts.push_back(std::move(part));
  return stacked(parts, 12);
}

Drawing draw_series_page(const MotifSet& alphabet, const Signal& signal, const std::vector<PaperSearch>& searches) {
  std::vector<Drawing> parts;
  if (!searches.empty()) parts = {heading("Collision matrix"), draw_collisions(searches)};
  if (searches.empty() || !alphabet.motifs.empty()) {
    parts.push_back(heading("Two occurrences of each motif"));
    parts.push_back(draw_motif_matches(alphabet, signal));
  }
  return stacked(parts, 12);
}

}  // namespace motex
