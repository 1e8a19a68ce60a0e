// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Transitions at the best cuts of real clips and simulated footage, by each renderer: second differences against their
// 95th percentile in the footage, structural similarity of the first rendered frame to the last real one, what optical
// flow leaves between frames; the cost of a morph at 720 × 480 and how far its grid is from the dense field.
// people_transitions [FOLDER of clips [STRIPS: where filmstrips go [CLIP]]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/people_clips.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/quantile.h"
#include "motex/image/png.h"
#include "motex/people/cut_quality.h"
#include "motex/people/dissolve.h"
#include "motex/people/feature_lines.h"
#include "motex/people/field_morph.h"
#include "motex/people/film_frames.h"
#include "motex/people/find_cuts.h"
#include "motex/people/render_film.h"

namespace motex {
namespace {

constexpr int kNumCuts = 12;
constexpr int kContext = 20;  // frames of footage around a transition
constexpr int kTransition = 8;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The best cuts, none close to another, with footage around them.
std::vector<Cut> best_cuts(const PeopleTexture& texture, SpriteSource& source) {
  FindCutsOptions options;
  std::vector<Cut> cuts = find_cuts(texture, comparable_frames(texture, source), options).cuts.cuts;
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.difference < b.difference; });
  std::vector<Cut> chosen;
  for (const Cut& cut : cuts) {
    const auto near = [&](const Cut& other) {
      return std::abs(other.from - cut.from) < 12 && std::abs(other.to - cut.to) < 12;
    };
    const auto fits = [&](const Take& take, int first, int last) {
      return first >= take.frames.start && last < take.frames.end();
    };
    bool from_fits = false, to_fits = false;
    for (const Take& take : texture.takes) {
      from_fits |= fits(take, cut.from - kContext, cut.from + kTransition);
      to_fits |= fits(take, cut.to - kTransition, cut.to + kContext);
    }
    if (from_fits && to_fits && std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(cut);
    if (chosen.size() == kNumCuts) break;
  }
  return chosen;
}

struct Shown {
  std::vector<Sprite> frames;  ///< two before, the transition, two after
  CutReport report;
  double milliseconds = 0;  ///< of CPU, a frame of the transition
};

Shown show(const PeopleTexture& texture, SpriteSource& source, const Cut& cut, const RenderFilmOptions& options) {
  EditList edits;
  edits.shots = {{cut.from - kContext, cut.from, -1}, {cut.to, cut.to + kContext, -1}};
  edits.cuts = {cut};
  edits.cuts[0].transition_frames = kTransition;
  FilmRenderer film(texture, source, edits, options);
  Shown shown;
  const int first = kContext + 1 - (kTransition + 1) / 2 - 2;
  double start = 0;
  int i = 0;
  for (Sprite sprite; film.next(sprite); ++i) {
    if (i == first + 1) start = seconds();
    if (i == first + 1 + kTransition) shown.milliseconds = 1000 * (seconds() - start) / kTransition;
    if (i >= first && i < first + kTransition + 4) shown.frames.push_back(sprite);
  }
  shown.report = film.cuts().at(0);
  return shown;
}

/// The frames of the take that is left, as if there were no cut.
std::vector<Sprite> footage_around(SpriteSource& source, const Cut& cut) {
  std::vector<Sprite> frames;
  for (int k = -3; k < kTransition + 1; ++k)
    frames.push_back(*source.sprite(std::min(source.num_frames() - 1, cut.from - kTransition / 2 + 1 + k)));
  return frames;
}

void write_strip(const std::string& path, const std::vector<Sprite>& frames) {
  BoundingBox box;
  for (const Sprite& frame : frames) box = joined(box, box_of(frame));
  Image strip(box.width() * static_cast<int>(frames.size()), box.height(), {120, 130, 140, 255});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Image cell(box.width(), box.height(), {120, 130, 140, 255});
    Sprite moved = frames[i];
    moved.left -= box.left, moved.top -= box.top;
    paint(cell, moved);
    paste(strip, cell, static_cast<int>(i) * box.width(), 0);
  }
  write_file(path, encode_png(strip));
}

struct Column {
  const char* name;
  TransitionRenderer renderer;
  std::vector<double> smoothness, ssim, flow_error, milliseconds;

  void add(const CutQuality& quality, double cost) {
    smoothness.push_back(quality.smoothness.largest());
    ssim.push_back(quality.ssim);
    flow_error.push_back(quality.flow_error);
    milliseconds.push_back(cost);
  }
  void print() const {
    std::printf(
        "  %-9s smoothness %.2f median %.2f worst   SSIM %.3f median %.3f worst   flow error %5.2f median %5.2f "
        "worst   %.0f ms\n",
        name, quantile(smoothness, 0.5), quantile(smoothness, 1), quantile(ssim, 0.5), quantile(ssim, 0),
        quantile(flow_error, 0.5), quantile(flow_error, 1), quantile(milliseconds, 0.5));
  }
};

void measure(const std::string& name, bench::PeopleClip clip, const std::string& strips) {
  MemorySprites source(std::move(clip.sprites));
  const SecondDifferenceScales scales = second_difference_scales(clip.texture);
  const std::vector<Cut> cuts = best_cuts(clip.texture, source);
  std::vector<Column> columns{{"chosen", TransitionRenderer::kAuto, {}, {}, {}, {}},
                              {"morph", TransitionRenderer::kFieldMorph, {}, {}, {}, {}},
                              {"flow", TransitionRenderer::kFlow, {}, {}, {}, {}},
                              {"dissolve", TransitionRenderer::kCrossDissolve, {}, {}, {}, {}},
                              {"cut", TransitionRenderer::kHardCut, {}, {}, {}, {}},
                              {"box edges", TransitionRenderer::kFieldMorph, {}, {}, {}, {}},
                              {"no cut", TransitionRenderer::kAuto, {}, {}, {}, {}}};
  std::printf("%s: %d frames, %zu cuts\n", name.c_str(), clip.texture.num_frames(), cuts.size());
  if (cuts.empty()) return;
  int better_ssim = 0, better_flow = 0;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    std::vector<CutQuality> of_column;
    for (std::size_t k = 0; k + 1 < columns.size(); ++k) {
      RenderFilmOptions options;
      options.renderer = columns[k].renderer;
      if (k == 5) options.lines = MorphLines::kEdges;  // the paper's
      const Shown shown = show(clip.texture, source, cuts[c], options);
      of_column.push_back(cut_quality(shown.frames, scales));
      columns[k].add(of_column.back(), shown.milliseconds);
      if (k == 0)
        std::printf("    %4d → %4d  difference %5.1f  %-8s  errors: morph %.1f flow %.1f (%.2f) dissolve %.1f\n",
                    cuts[c].from, cuts[c].to, cuts[c].difference, name_of(shown.report.renderer),
                    shown.report.morph_error, shown.report.flow_error, shown.report.flow_consistency,
                    shown.report.dissolve_error);
      if (!strips.empty())
        write_strip(strips + "/" + name + "_" + std::to_string(c) + "_" + columns[k].name + ".png", shown.frames);
    }
    columns.back().add(cut_quality(footage_around(source, cuts[c]), scales), 0);
    better_ssim += of_column[0].ssim >= of_column[3].ssim,
        better_flow += of_column[0].flow_error <= of_column[3].flow_error;
  }
  for (const Column& column : columns) column.print();
  std::printf("  at least as good as the dissolve: SSIM %d, flow error %d of %zu cuts\n", better_ssim, better_flow,
              cuts.size());
  std::fflush(stdout);
}

/// The clip's first frame with somebody, and one half a second later, made 480 pixels high.
void measure_cost(const bench::PeopleClip& clip) {
  const Sprite a = placed(clip.sprites.at(60), {480.0 / clip.sprites[60].height, 0, 0});
  const Sprite b = placed(clip.sprites.at(75), {480.0 / clip.sprites[75].height, 0, 0});
  const auto filled = [](const Sprite& sprite) {  // the whole frame, wherever the actor is
    Sprite frame{0, 0, 720, 480, std::vector<PremultipliedRgba>(std::size_t{720} * 480)};
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < 720; ++x) frame.at(x, y) = sprite.at(x % sprite.width, std::min(y, sprite.height - 1));
    return frame;
  };
  const std::vector<FeatureLinePair> lines = outline_lines({a, {}}, {b, {}});
  const auto cost = [&](const Sprite& from, const Sprite& to) {
    double least = 1e9;  // others on the machine only add to it
    for (int i = 0; i < 40; ++i) {
      const double start = seconds();
      dissolve_where_alike(field_morph({from, {}}, {to, {}}, lines, 0.5, 0, {}, 1),
                           field_morph({from, {}}, {to, {}}, lines, 0.5, 1, {}, 1), 0.5);
      least = std::min(least, 1000 * (seconds() - start));
    }
    return least;
  };
  std::printf(
      "a morph, both directions and dissolve, %zu lines: actor of %d × %d pixels %.1f ms, 720 × 480 full %.1f ms\n",
      lines.size(), a.width, a.height, cost(a, b), cost(filled(a), filled(b)));
  std::vector<FeatureLine> shown, source;
  for (const FeatureLinePair& pair : lines) shown.push_back(between(pair, 0.5)), source.push_back(pair.a);
  const BoundingBox box = joined(box_of(a), box_of(b));
  const WarpGrid grid = field_warp(shown, source, box);
  std::vector<double> errors;
  for (int y = box.top; y <= box.bottom; y += 2) {
    for (int x = box.left; x <= box.right; x += 2) {
      const auto exact = field_displacement(shown, source, x, y), ours = grid.at(x, y);
      errors.push_back(std::hypot(exact.x - ours.x, exact.y - ours.y));
    }
  }
  std::printf(
      "field on a grid of 8 pixels against the dense one: median %.3f, 95th percentile %.3f, worst %.2f pixels\n",
      quantile(errors, 0.5), quantile(errors, 0.95), quantile(errors, 1));
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : std::string(MOTEX_SHARED_DATA) + "/video/people";
  const std::string strips = argc > 2 ? argv[2] : "";
  if (!strips.empty()) std::filesystem::create_directories(strips);
  const auto run = [&](const std::string& name, const std::function<motex::bench::PeopleClip()>& load) {
    try {
      motex::bench::PeopleClip clip = load();
      if (name == "dancer1") motex::measure_cost(clip);
      motex::measure(name, std::move(clip), strips);
    } catch (const motex::Error& error) {
      std::printf("%s: %s\n", name.c_str(), error.what());
    }
  };
  const std::string only = argc > 3 ? argv[3] : "";
  const auto wanted = [&](const std::string& name) { return only.empty() || only == name; };
  if (wanted("dancer1")) run("dancer1", [&] { return motex::bench::load_dancer(folder); });
  for (const char* name : {"greenscreen_woman_640x360.mp4"})
    if (wanted(name)) run(name, [&] { return motex::bench::load_keyed(folder + "/" + name); });
  if (wanted("simulated")) run("simulated", [] { return motex::bench::load_simulated(1500); });
}
