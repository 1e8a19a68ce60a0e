// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Real labelled repetitions and hard cuts: a video with repetitions of several exercises is keyed, cut and searched for
// motifs as `motex people motifs` does it. For every exercise the motif that holds most of its labelled repetitions
// (peak frame inside an occurrence): recall, and strangers, the share of labelled repetitions in that motif that are of
// another exercise. Then left and right kicks of a simulated actor.
// people_repetitions [FOLDER of clips, default ../shared/data/video/people]
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/simulated_people.h"
#include "motex/people/footage_motifs.h"
#include "motex/project/people_footage.h"

namespace motex {
namespace {

double cpu_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(in, line);  // heading
  while (std::getline(in, line)) {
    std::stringstream words(line);
    rows.emplace_back();
    for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
  }
  return rows;
}

/// How many of the true cuts were found, and how many others.
void score_cuts(const std::string& name, const PeopleFootage& footage, const std::vector<int>& truth) {
  int hits = 0;
  for (std::size_t k = 1; k < footage.shots.size(); ++k)
    hits += std::count(truth.begin(), truth.end(), footage.shots[k].start) > 0 ? 1 : 0;
  std::printf("%-34s %2zu true cuts, %2d found, %2zu others\n", name.c_str(), truth.size(), hits,
              footage.shots.size() - 1 - static_cast<std::size_t>(hits));
}

std::vector<int> starts_after_first(const std::string& path, std::size_t column) {
  std::vector<int> starts;
  for (const auto& row : rows_of(path)) starts.push_back(std::stoi(row[column]));
  starts.erase(starts.begin());
  return starts;
}

/// Frame of the people texture at which the main person is in a frame of the video; −1 = left out.
int texture_frame(const PeopleTexture& texture, int source_frame) {
  for (const Take& take : texture.takes) {
    const int offset = source_frame - take.source_start;
    if (offset >= 0 && offset < take.frames.length) return take.frames.start + offset;
  }
  return -1;
}

/// Which motif performs at a frame; −1 = none. Several: the one whose middle is nearest.
bool holds(const Motif& motif, int frame) {
  return std::any_of(motif.occurrences.begin(), motif.occurrences.end(),
                     [&](const Occurrence& one) { return frame >= one.start && frame < one.start + one.length; });
}

void score_repetitions(const PeopleTexture& texture, const std::vector<std::pair<std::string, int>>& repetitions) {
  std::vector<std::string> kinds;
  for (const auto& [kind, frame] : repetitions)
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  int total = 0, held = 0, strangers = 0, members = 0;
  for (const std::string& kind : kinds) {
    int count = 0, best = 0, best_strangers = 0;
    std::string letter = "-";
    for (const auto& [other, frame] : repetitions) count += other == kind ? 1 : 0;
    for (const Motif& motif : texture.alphabet.motifs) {
      int own = 0, foreign = 0;
      for (const auto& [other, frame] : repetitions)
        if (holds(motif, frame)) (other == kind ? own : foreign) += 1;
      if (own > best) best = own, best_strangers = foreign, letter = motif.letter;
    }
    std::printf("  %-12s %2d repetitions, %2d in motif %-3s strangers %d\n", kind.c_str(), count, best, letter.c_str(),
                best_strangers);
    total += count, held += best, strangers += best_strangers, members += best + best_strangers;
  }
  std::printf("  together     %2d repetitions, %.1f %% in one motif class, %.1f %% strangers\n", total,
              100.0 * held / std::max(1, total), 100.0 * strangers / std::max(1, members));
}

void score_exercises(const std::string& folder) {
  const double begun = cpu_secs();
  const PeopleFootage footage = read_people_footage(folder + "/darebee_w_640x360.mp4");
  score_cuts("eleven exercises", footage, starts_after_first(folder + "/darebee_w_segments.csv", 1));
  PeopleTexture texture = people_texture_of(footage);
  const double keyed = cpu_secs();
  texture.alphabet = find_footage_motifs(texture).set;
  std::printf("  %d frames: %.1f s of CPU for cuts, keying and silhouettes, %.1f s for motifs\n", texture.num_frames(),
              keyed - begun, cpu_secs() - keyed);
  std::vector<std::pair<std::string, int>> repetitions;
  for (const auto& row : rows_of(folder + "/darebee_w_reps_from_aspect.csv"))
    repetitions.emplace_back(row[0], texture_frame(texture, std::stoi(row[3])));
  score_repetitions(texture, repetitions);
}

void score_kicks() {
  SimulateActorOptions options;
  options.actions = "left_kick,right_kick";
  options.frames = 1200;
  options.seed = 3;
  const ActorSimulation scene(options);
  PeopleTexture texture = bench::texture_of(scene, options);
  texture.alphabet = find_footage_motifs(texture).set;
  std::vector<std::pair<std::string, int>> repetitions;
  for (const ActorPerformance& one : scene.performances())
    repetitions.emplace_back("kick " + std::to_string(one.action), one.start + one.length / 2);
  std::printf("left and right kicks of a simulated actor\n");
  score_repetitions(texture, repetitions);
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  try {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const std::string folder = argc > 1 && *argv[1] != 0 ? argv[1] : std::string(MOTEX_SHARED_DATA) + "/video/people";
    motex::score_kicks();
    const motex::PeopleFootage dancer = motex::read_people_footage(folder + "/dancer1_fullbody_green_640x360.mp4");
    motex::score_cuts("dancer", dancer, motex::starts_after_first(folder + "/dancer1_fullbody_segments.csv", 2));
    motex::score_cuts("woman, green screen", motex::read_people_footage(folder + "/greenscreen_woman_640x360.mp4"), {});
    motex::score_cuts("people before a wall", motex::read_people_footage(folder + "/mdn_yellowwall_320x192.mp4"), {});
    motex::score_exercises(folder);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
