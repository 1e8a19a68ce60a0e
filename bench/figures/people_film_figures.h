// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

// Figures 5 to 8 of [PT04] and its three experiments, for people_figures.cpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/people_clips.h"
#include "motex/core/quantile.h"
#include "motex/people/compare_silhouettes.h"
#include "motex/people/feature_lines.h"
#include "motex/people/film_frames.h"
#include "motex/people/find_cuts.h"
#include "motex/people/render_film.h"
#include "motex/plot/charts.h"
#include "motex/plot/frame.h"

namespace motex::bench {

constexpr Rgba kPaper{255, 255, 255, 255};
constexpr Rgba kShade{214, 224, 240, 255};
constexpr int kTransitionFrames = 5;

inline std::string fixed(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// What of the film lies in the box, over that colour.
inline Image picture_of(const Sprite& sprite, const BoundingBox& box, Rgba paper) {
  Image image(box.width(), box.height(), paper);
  Sprite moved = sprite;
  moved.left -= box.left, moved.top -= box.top;
  paint(image, moved);
  return image;
}

struct Cell {
  Sprite sprite;
  std::string caption;
  bool shaded = false;
};

/// Sprites side by side, all with the same part of the film, a caption below each.
inline Drawing row_of(const std::vector<Cell>& cells, const BoundingBox& box, double height) {
  const double width = height * box.width() / box.height();
  Drawing row{(width + 4) * static_cast<double>(cells.size()), height + 20, kPaper, {}};
  double x = 0;
  for (const Cell& cell : cells) {
    row.add(Picture{{x, 0}, width, height, picture_of(cell.sprite, box, cell.shaded ? kShade : kPaper)});
    row.add(Text{{x + width / 2, height + 14}, cell.caption, 11, kInk, Align::kCentre, false, false});
    x += width + 4;
  }
  return row;
}

inline Drawing below_one_another(const std::vector<Drawing>& rows) {
  Drawing all{0, 0, kPaper, {}};
  for (const Drawing& row : rows) {
    append(all, row, {0, all.height});
    all.width = std::max(all.width, row.width);
    all.height += row.height + 8;
  }
  return all;
}

/// A film with the frames of one of its transitions.
struct Passage {
  std::vector<Cell> before, rendered, after;  ///< two real frames, the transition, two real frames
  BoundingBox box;
  CutReport report;
};

inline Passage passage_of(const PeopleClip& clip, SpriteSource& source, const Cut& cut) {
  EditList edits;
  edits.shots = {{cut.from - 12, cut.from, -1}, {cut.to, cut.to + 12, -1}};
  edits.cuts = {cut};
  edits.cuts[0].transition_frames = kTransitionFrames;
  const std::vector<FilmFrame> frames = film_frames(clip.texture, edits);
  FilmRenderer film(clip.texture, source, edits);
  Passage passage;
  std::size_t i = 0;
  for (Sprite sprite; film.next(sprite); ++i) {
    const bool is_rendered = frames[i].cut >= 0;
    if (i < 8 || i > 17) continue;
    passage.box = joined(passage.box, box_of(sprite));
    const std::string percent = fixed(100 * (1 - frames[i].weight), 0) + " : " + fixed(100 * frames[i].weight, 0);
    Cell cell{sprite, is_rendered ? percent : std::to_string(frames[i].frame), is_rendered};
    (is_rendered ? passage.rendered : passage.rendered.empty() ? passage.before : passage.after).push_back(cell);
  }
  passage.report = film.cuts().at(0);
  return passage;
}

inline double speed_at(const PeopleTexture& texture, int frame) {
  const Silhouette* s = &texture.silhouettes[static_cast<std::size_t>(frame)];
  return std::hypot(s[0].centroid_x - s[-1].centroid_x, s[0].centroid_y - s[-1].centroid_y) +
         std::sqrt(std::abs(s[0].area - s[-1].area));
}

/// Cuts with footage around them, the best first.
inline std::vector<Cut> usable_cuts(const PeopleTexture& texture, SpriteSource& source) {
  std::vector<Cut> cuts;
  for (const Cut& cut : find_cuts(texture, comparable_frames(texture, source)).cuts.cuts) {
    const auto fits = [&](int first, int last) {
      return std::any_of(texture.takes.begin(), texture.takes.end(),
                         [&](const Take& take) { return first >= take.frames.start && last < take.frames.end(); });
    };
    if (fits(cut.from - 14, cut.from + 6) && fits(cut.to - 6, cut.to + 14)) cuts.push_back(cut);
  }
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.difference < b.difference; });
  return cuts;
}

/// Figure 5: the aspect ratio of both stretches with the way that the film takes, and the comparison matrix with the
/// place of the cut.
inline Drawing schematic(const PeopleClip& clip, const Cut& cut, SpriteSource& source) {
  constexpr int kAround = 30;
  LinePlot plot;
  plot.title = "Two stretches; the film leaves one for the other";
  plot.x_axis.label = "frame around the cut", plot.y_axis.label = "width / height";
  Series a{"left", {}, {}, Mark::kLine, Rgba{150, 150, 150, 255}},
      b{"entered", {}, {}, Mark::kLine, Rgba{90, 120, 200, 255}};
  Series way{"film", {}, {}, Mark::kLineAndPoints, Rgba{30, 160, 60, 255}};
  const auto aspect = [&](int frame) {
    const int last = clip.texture.num_frames() - 1;
    return clip.texture.silhouettes[static_cast<std::size_t>(std::clamp(frame, 0, last))].aspect();
  };
  for (int k = -kAround; k <= kAround; ++k) {
    a.x.push_back(k), a.y.push_back(aspect(cut.from + k));
    b.x.push_back(k), b.y.push_back(aspect(cut.to - 1 + k));
    way.x.push_back(k), way.y.push_back(k <= 0 ? aspect(cut.from + k) : aspect(cut.to - 1 + k));
  }
  plot.series = {a, b, way};
  plot.x_markers = {{0, "cut"}};
  const auto span = [&](int middle) {
    const int first = std::clamp(middle - kAround, 0, clip.texture.num_frames() - 2 * kAround - 1);
    return FrameSpan{first, 2 * kAround + 1};
  };
  const FrameSpan rows = span(cut.from), columns = span(cut.to - 1);
  HeatMap map;
  map.title = "Silhouette-to-silhouette differences, two frames";
  map.x_label = "frame entered, from " + std::to_string(columns.start);
  map.y_label = "frame left, from " + std::to_string(rows.start);
  map.value_label = "grey levels";
  map.values =
      two_frame_differences(compare_silhouettes(comparable_frames(clip.texture, source).pictures, rows, columns))
          .cast<double>();
  Drawing out{0, 340, kPaper, {}};
  for (const Drawing& part : {draw(plot), draw(map)}) {
    append(out, part, {out.width, 0});
    out.width += part.width + 12;
  }
  return out;
}

/// Figure 6: the frames of both takes and the film between, with the weights.
inline Drawing weights_figure(const Passage& passage) {
  std::vector<Cell> cells = passage.before;
  cells.insert(cells.end(), passage.rendered.begin(), passage.rendered.end());
  cells.insert(cells.end(), passage.after.begin(), passage.after.end());
  return row_of(cells, passage.box, 190);
}

inline void add_lines(Drawing& drawing, const std::vector<FeatureLinePair>& lines, bool of_a, const BoundingBox& box,
                      double x, double scale, Rgba colour, double width) {
  for (const FeatureLinePair& pair : lines) {
    const FeatureLine& line = of_a ? pair.a : pair.b;
    drawing.add(Polyline{{{x + (line.px - box.left) * scale, (line.py - box.top) * scale},
                          {x + (line.qx - box.left) * scale, (line.qy - box.top) * scale}},
                         colour,
                         width,
                         0});
  }
}

/// Figure 7: fixed edges of the bounding box (red) and lines along the outline (green) in both frames of a cut.
inline Drawing lines_figure(const PeopleClip& clip, SpriteSource& source, const Cut& cut) {
  const Passage passage = passage_of(clip, source, cut);
  const auto sprite_a = source.sprite(cut.from), sprite_b = source.sprite(cut.to - 1);
  const PlacedFrame a{cut.from, {}}, b{cut.to - 1, passage.report.placement};
  const Sprite shown_b = placed(*sprite_b, b.placement);
  BoundingBox box = joined(box_of(*sprite_a), box_of(shown_b));
  box.left -= 6, box.top -= 6, box.right += 6, box.bottom += 6;
  Drawing row = row_of(
      {{*sprite_a, "frame " + std::to_string(cut.from)}, {shown_b, "frame " + std::to_string(cut.to - 1)}}, box, 240);
  const double scale = 240.0 / box.height(), width = scale * box.width() + 4;
  const auto edges = fixed_edges(clip.texture, a, b);
  const auto outline = outline_lines({*sprite_a, {}}, {*sprite_b, b.placement});
  for (const bool of_a : {true, false}) {
    add_lines(row, outline, of_a, box, of_a ? 0 : width, scale, {20, 150, 60, 255}, 1.6);
    add_lines(row, edges, of_a, box, of_a ? 0 : width, scale, {220, 40, 40, 255}, 2.4);
  }
  return row;
}

/// The passage large around a place, a share of the height each way.
inline Drawing close_up(const Passage& passage, double x, double y, double share) {
  const int reach = static_cast<int>(share * passage.box.height());
  std::vector<Cell> cells = passage.rendered;
  cells.insert(cells.begin(), passage.before.back());
  cells.push_back(passage.after.front());
  const int px = static_cast<int>(x), py = static_cast<int>(y);
  return row_of(cells, {px - reach, py - reach, px + reach, py + reach}, 130);
}

/// Figure 8: the head in one passage, the hand that is farther from the middle in another, frame by frame.
inline Drawing close_ups(const Passage& of_head, const Passage& of_hand) {
  const Outline with_head = outline_of({of_head.rendered[2].sprite, {}});
  const Outline with_hand = outline_of({of_hand.rendered[2].sprite, {}});
  const auto higher = [](const OutlinePoint& p, const OutlinePoint& q) { return p.y < q.y; };
  const OutlinePoint head = *std::min_element(with_head.points.begin(), with_head.points.end(), higher);
  const double middle = (of_hand.box.left + of_hand.box.right) / 2.0,
               ground = of_hand.box.bottom - 0.3 * with_hand.height;
  const auto reach_of = [&](const OutlinePoint& p) { return p.y < ground ? std::abs(p.x - middle) : 0; };
  const OutlinePoint hand =
      *std::max_element(with_hand.points.begin(), with_hand.points.end(),
                        [&](const OutlinePoint& p, const OutlinePoint& q) { return reach_of(p) < reach_of(q); });
  return below_one_another(
      {close_up(of_head, head.x, head.y + 0.06 * with_head.height, 0.12), close_up(of_hand, hand.x, hand.y, 0.15)});
}

/// Among the best cuts those made at the greatest and the least speed, and with arms the farthest out.
struct ChosenCuts {
  Cut moving, still, wide;
};
inline ChosenCuts choose_cuts(const PeopleTexture& texture, const std::vector<Cut>& cuts) {
  const auto slower = [&](const Cut& a, const Cut& b) { return speed_at(texture, a.from) < speed_at(texture, b.from); };
  std::vector<Cut> best;
  for (const Cut& cut : cuts)
    if (best.size() < 40 && std::abs(cut.to - cut.from) >= 90) best.push_back(cut);
  if (best.empty()) throw InvalidInput("no cut leads far enough");
  std::vector<Cut> close;  // with a little more difference, and nearer
  for (const Cut& cut : cuts)
    if (cut.difference <= 1.3 * best.back().difference) close.push_back(cut);
  const auto aspect = [&](const Cut& cut) {
    return std::min(texture.silhouettes[static_cast<std::size_t>(cut.from)].aspect(),
                    texture.silhouettes[static_cast<std::size_t>(cut.to)].aspect());
  };
  const auto narrower = [&](const Cut& one, const Cut& other) { return aspect(one) < aspect(other); };
  return {*std::max_element(best.begin(), best.end(), slower), *std::min_element(best.begin(), best.end(), slower),
          *std::max_element(close.begin(), close.end(), narrower)};
}

/// Figures 5 to 8: people_textures_5.png ….
inline void draw_transition_figures(const std::string& clips, const std::filesystem::path& out) {
  PeopleClip clip = load_dancer(clips);
  MemorySprites source(std::move(clip.sprites));
  const std::vector<Cut> cuts = usable_cuts(clip.texture, source);
  if (cuts.empty()) throw InvalidInput("no cut was found in dancer1");
  const auto [moving, still, wide] = choose_cuts(clip.texture, cuts);
  const Passage passage = passage_of(clip, source, moving);
  write_picture(out / "people_textures_5.png", schematic(clip, moving, source));
  write_picture(out / "people_textures_6.png", weights_figure(passage));
  Drawing lines = lines_figure(clip, source, still);
  const Drawing right = lines_figure(clip, source, moving);
  append(lines, right, {lines.width + 30, 0});
  lines.width += right.width + 30;
  write_picture(out / "people_textures_7.png", lines);
  write_picture(out / "people_textures_8.png", close_ups(passage, passage_of(clip, source, wide)));
  std::printf("figures 5 to 8: dancer1, cuts %d → %d (moving), %d → %d (still), %d → %d (arms out)\n", moving.from,
              moving.to, still.from, still.to, wide.from, wide.to);
}

}  // namespace motex::bench
