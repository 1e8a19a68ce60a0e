// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Films of free play, as `motex people play` makes them, of real clips: how smooth their cuts are (second differences
// of area, centroid and aspect against the 95th percentile inside the footage; structural similarity and what optical
// flow leaves), with the renderer that is chosen, with cross-dissolves and with hard cuts; how much of the footage can
// be played for ever; the cost of finding cuts. people_cuts [FOLDER of clips] [VIDEO …: others, keyed first]
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "bench/people_clips.h"
#include "motex/core/error.h"
#include "motex/core/quantile.h"
#include "motex/people/cut_quality.h"
#include "motex/people/director.h"
#include "motex/people/find_cuts.h"
#include "motex/people/render_film.h"

namespace motex {
namespace {

using bench::PeopleClip;

constexpr int kNumSeeds = 2;
constexpr double kFilmSecs = 40;

double cpu_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Measured {
  std::vector<double> smoothness, ssim, flow_error;

  void print(const char* name) const {
    if (smoothness.empty()) return;
    std::printf("  %-10s smoothness %.2f median %.2f worst   SSIM %.3f median   flow error %.2f median   (%zu cuts)\n",
                name, quantile(smoothness, 0.5), quantile(smoothness, 1), quantile(ssim, 0.5),
                quantile(flow_error, 0.5), smoothness.size());
  }
};

/// Measures every cut of a film in its rendered frames.
void measure(const PeopleClip& clip, SpriteSource& source, const EditList& edits, TransitionRenderer renderer,
             Measured& measured) {
  RenderFilmOptions options;
  options.renderer = renderer;
  FilmRenderer film(clip.texture, source, edits, options);
  std::vector<int> at;  // first film frame after each cut
  int time = 0;
  for (const Shot& shot : edits.shots) at.push_back(time += shot.last - shot.first + 1);
  std::map<int, Sprite> kept;
  const int reach = edits.cuts.empty() ? 0 : edits.cuts[0].transition_frames / 2 + 4;
  Sprite sprite;
  for (int t = 0; film.next(sprite); ++t)
    for (std::size_t k = 0; k < edits.cuts.size(); ++k)
      if (std::abs(t - at[k]) <= reach) kept[t] = sprite;
  const SecondDifferenceScales scales = second_difference_scales(clip.texture);
  for (const CutReport& report : film.cuts()) {
    const int first = at[static_cast<std::size_t>(report.cut)] - (report.transition_frames + 1) / 2;
    std::vector<Sprite> frames;
    for (int t = first - 2; t < first + report.transition_frames + 2; ++t)
      if (kept.contains(t)) frames.push_back(kept.at(t));
    if (frames.size() < 4) continue;
    const CutQuality quality = cut_quality(frames, scales);
    measured.smoothness.push_back(quality.smoothness.largest());
    measured.ssim.push_back(quality.ssim);
    measured.flow_error.push_back(quality.flow_error);
  }
}

void report(const std::string& name, PeopleClip clip) {
  MemorySprites source(clip.sprites);
  const double start = cpu_secs();
  const ComparableFrames frames = comparable_frames(clip.texture, source);
  const double reduced = cpu_secs();
  const FindCutsReport found = find_cuts(clip.texture, frames);
  const double searched = cpu_secs();
  clip.texture.cuts = found.cuts;
  const FilmGraph graph(clip.texture, 12);
  std::printf(
      "%s: %d frames, %zu takes, %zu cuts; natural difference %.1f, limit %.1f; %.0f %% of the frames endless; "
      "CPU %.2f s to reduce, %.2f s to search\n",
      name.c_str(), clip.texture.num_frames(), clip.texture.takes.size(), found.cuts.cuts.size(),
      found.cuts.natural_difference, found.max_difference, 100 * graph.endless_share(), reduced - start,
      searched - reduced);
  if (graph.endless_share() == 0) return;
  std::map<TransitionRenderer, Measured> measured;
  for (const double shot_secs : {5.0, 15.0})
    for (int seed = 1; seed <= kNumSeeds; ++seed) {
      PlayOptions options;
      options.shot_secs = shot_secs, options.seed = static_cast<std::uint64_t>(seed);
      const EditList edits = play(clip.texture, static_cast<int>(kFilmSecs * clip.texture.frames_per_sec), options);
      for (const TransitionRenderer renderer :
           {TransitionRenderer::kAuto, TransitionRenderer::kCrossDissolve, TransitionRenderer::kHardCut})
        measure(clip, source, edits, renderer, measured[renderer]);
    }
  for (const auto& [renderer, values] : measured) values.print(name_of(renderer));
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : std::string(MOTEX_SHARED_DATA) + "/video/people";
  try {
    if (argc > 2)
      for (int i = 2; i < argc; ++i) motex::report(argv[i], motex::bench::load_keyed(argv[i]));
    else {
      motex::report("dancer1", motex::bench::load_dancer(folder));
      motex::report("greenscreen_woman", motex::bench::load_keyed(folder + "/greenscreen_woman_640x360.mp4"));
      motex::report("darebee_w", motex::bench::load_keyed(folder + "/darebee_w_640x360.mp4"));
    }
  } catch (const motex::Error& error) {
    std::fprintf(stderr, "people_cuts: %s\n", error.what());
    return 1;
  }
  return 0;
}
