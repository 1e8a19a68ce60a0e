// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

// The three experiments of [PT04] section 4: films of 75, 35 and 75 seconds with four transitions each, moving and
// still.

#include <cstddef>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/figures/people_film_figures.h"
#include "motex/video_io/video_writer.h"

namespace motex::bench {

/// The film of that many cuts that is longest, up to num_frames, with the least differences, some cuts made while
/// moving and some while still; of a longer one the beginning and the end are cut off. Without shots when there is
/// none.
class LongFilm {
 public:
  LongFilm(const PeopleTexture& texture, std::vector<Cut> cuts, int num_frames)
      : texture_(texture), cuts_(std::move(cuts)), num_frames_(num_frames) {
    std::vector<double> speeds;
    for (const Cut& cut : cuts_) speeds.push_back(speed_at(texture, cut.from));
    const double middle = speeds.empty() ? 0 : quantile(speeds, 0.5);
    for (const double speed : speeds) kind_.push_back(speed > middle ? 1 : 2);
  }

  EditList with(int num_cuts) {
    begin();
    for (int k = 1; k < num_cuts; ++k) add_cut();
    return traced(num_cuts);
  }

 private:
  static constexpr std::size_t kKinds = 4;    // bit 1: a moving cut is there, bit 2: a still one
  static constexpr double kFramesALevel = 3;  // a grey level of difference is worth so many frames
  static constexpr int kShortest = 30;        // frames between two cuts
  struct State {
    double value = -std::numeric_limits<double>::infinity();
    int frames = 0, before = -1;
    std::size_t before_kinds = 0;
  };
  using Layer = std::vector<std::array<State, kKinds>>;

  const Take& take_of(int frame) const {
    return *std::find_if(texture_.takes.begin(), texture_.takes.end(),
                         [&](const Take& take) { return frame >= take.frames.start && frame < take.frames.end(); });
  }
  double value_of(int frames, double cost) const { return std::min(frames, num_frames_) - cost; }

  void begin() {
    layers_.assign(1, Layer(cuts_.size()));
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      const int frames = cuts_[c].from - take_of(cuts_[c].from).frames.start + 1;
      layers_[0][c][kind_[c]] = {value_of(frames, kFramesALevel * cuts_[c].difference), frames, -1, 0};
    }
  }

  void add_cut() {
    const Layer& last = layers_.back();
    Layer next(cuts_.size());
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      for (std::size_t b = 0; b < cuts_.size(); ++b) {
        const int length = cuts_[c].from - cuts_[b].to + 1;
        if (length < kShortest || &take_of(cuts_[c].from) != &take_of(cuts_[b].to)) continue;
        for (std::size_t kinds = 0; kinds < kKinds; ++kinds) {
          const State& from = last[b][kinds];
          if (from.before == -1 && layers_.size() > 1) continue;
          if (!(from.value > -1e9)) continue;
          const double value = from.value + std::min(length, std::max(0, num_frames_ - from.frames)) -
                               kFramesALevel * cuts_[c].difference - (b == c ? 50 : 0);
          State& best = next[c][kinds | kind_[c]];
          if (value > best.value) best = {value, from.frames + length, static_cast<int>(b), kinds};
        }
      }
    }
    layers_.push_back(std::move(next));
  }

  EditList traced(int num_cuts) const {
    EditList edits;
    double best = -1e9;
    std::size_t at = 0, kinds = 3;
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      const State& state = layers_.back()[c][3];
      const int length = take_of(cuts_[c].to).frames.end() - cuts_[c].to;
      const double value = state.value + std::min(length, std::max(0, num_frames_ - state.frames));
      if (length >= kShortest && value > best) best = value, at = c;
    }
    if (best <= -1e9) return edits;
    for (int k = num_cuts; k-- > 0;) {
      edits.cuts.insert(edits.cuts.begin(), cuts_[at]);
      const State& state = layers_[static_cast<std::size_t>(k)][at][kinds];
      at = static_cast<std::size_t>(std::max(0, state.before)), kinds = state.before_kinds;
    }
    int first = take_of(edits.cuts.front().from).frames.start;
    for (const Cut& cut : edits.cuts) {
      edits.shots.push_back({first, cut.from, -1});
      first = cut.to;
    }
    edits.shots.push_back({first, take_of(first).frames.end() - 1, -1});
    trim(edits);
    return edits;
  }

  void trim(EditList& edits) const {
    int excess = std::max(0, edits.num_frames() - num_frames_);
    for (Shot* shot : {&edits.shots.back(), &edits.shots.front()}) {
      const int off = std::min(excess, std::max(0, shot->last - shot->first + 1 - kShortest));
      if (shot == &edits.shots.back())
        shot->last -= off;
      else
        shot->first += off;
      excess -= off;
    }
  }

  const PeopleTexture& texture_;
  std::vector<Cut> cuts_;
  std::vector<std::size_t> kind_;
  int num_frames_;
  std::vector<Layer> layers_;
};

/// Every tenth of the film and the middle of each transition, as two rows.
inline void film_and_strip(PeopleClip clip, const std::string& name, double secs, const std::filesystem::path& picture,
                           const std::filesystem::path& video) {
  MemorySprites source(std::move(clip.sprites));
  std::vector<Cut> cuts = usable_cuts(clip.texture, source);
  if (cuts.size() > 1500) cuts.resize(1500);
  const int wanted = static_cast<int>(secs * clip.texture.frames_per_sec);
  EditList edits;
  int num_cuts = 4;
  for (LongFilm planner(clip.texture, cuts, wanted); num_cuts <= 12; ++num_cuts) {
    edits = planner.with(num_cuts);
    if (edits.num_frames() >= wanted) break;
  }
  if (edits.shots.empty()) throw InvalidInput("no film of four cuts can be made of " + name);
  for (Cut& cut : edits.cuts) cut.transition_frames = kTransitionFrames;
  const std::vector<FilmFrame> frames = film_frames(clip.texture, edits);
  FilmRenderer film(clip.texture, source, edits);
  WriteVideoOptions write;
  write.frames_per_sec = clip.texture.frames_per_sec;
  VideoWriter writer(video, clip.texture.width, clip.texture.height, write);
  std::vector<Cell> overview, middles;
  BoundingBox box;
  std::size_t i = 0;
  for (Sprite sprite; film.next(sprite); ++i) {
    Image image(clip.texture.width, clip.texture.height, kPaper);
    paint(image, sprite);
    writer.write(image);
    const std::string time = fixed(static_cast<double>(i) / clip.texture.frames_per_sec, 1) + " s";
    const bool tenth = i % (frames.size() / 10) == frames.size() / 20;
    const bool middle = frames[i].cut >= 0 && std::abs(frames[i].weight - 0.5) < 0.01;
    if (tenth && overview.size() < 10) overview.push_back({sprite, time, frames[i].cut >= 0});
    if (middle) middles.push_back({sprite, time, true});
    if (tenth || middle) box = joined(box, box_of(sprite));
  }
  writer.finish();
  write_picture(picture, below_one_another({row_of(overview, box, 120), row_of(middles, box, 120)}));
  std::printf("%s: %.1f s of film with %zu transitions from %.1f s of footage; %s\n", name.c_str(),
              edits.num_frames() / clip.texture.frames_per_sec, edits.cuts.size(),
              clip.texture.num_frames() / clip.texture.frames_per_sec, video.c_str());
  const double usual = [&] {
    std::vector<double> speeds;
    for (int f = 1; f < clip.texture.num_frames(); ++f) speeds.push_back(speed_at(clip.texture, f));
    return quantile(speeds, 0.5);
  }();
  for (const CutReport& report : film.cuts()) {
    const Cut& cut = edits.cuts[static_cast<std::size_t>(report.cut)];
    std::printf("  %d → %d, %s, %.1f × the usual speed, difference %.1f, error %.1f (dissolve %.1f)\n", cut.from,
                cut.to, name_of(report.renderer), speed_at(clip.texture, cut.from) / usual, cut.difference,
                std::min(report.morph_error, report.flow_error), report.dissolve_error);
  }
}

/// people_experiment_1.png … 3.png; the films, and the strips of clips that may not be shown in the repository, go to a
/// temporary folder, which is printed. A short clip needs more than four transitions for so long a film.
inline void draw_experiments(const std::string& clips, const std::filesystem::path& out, const std::set<int>& wanted) {
  const std::filesystem::path films = std::filesystem::temp_directory_path() / "motex_people_films";
  std::filesystem::create_directories(films);
  struct Experiment {
    const char* clip;
    double secs;
  };
  int number = 0;
  for (const Experiment& one : {Experiment{"darebee_w_640x360.mp4", 75}, Experiment{"dancer1", 35},
                                Experiment{"greenscreen_woman_640x360.mp4", 75}}) {
    const std::string name = "people_experiment_" + std::to_string(++number);
    if (!wanted.empty() && !wanted.contains(100 + number)) continue;
    const bool dancer = std::string(one.clip) == "dancer1";
    film_and_strip(dancer ? load_dancer(clips) : load_keyed(clips + "/" + one.clip), one.clip, one.secs,
                   (dancer ? out : films) / (name + ".png"), films / (name + ".mp4"));
  }
}

}  // namespace motex::bench
