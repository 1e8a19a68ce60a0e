// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// The figures of [PT04] and its three experiments, from real clips: people_figures FOLDER OUT [NUMBER …]. FOLDER holds
// people/ (or is ../shared/data/video); figures by their number, experiments as 101, 102, 103. What was chosen, and
// what the films are made of, is printed.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <set>
#include <string>

#include "bench/figures/people_experiments.h"
#include "bench/figures/people_film_figures.h"
#include "bench/figures/people_motif_figures.h"

int main(int argc, char** argv) {
  try {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const std::string data = argc > 1 && *argv[1] != 0 ? argv[1] : std::string(MOTEX_SHARED_DATA) + "/video";
    const std::filesystem::path folder = argc > 2 ? argv[2] : "build/figures";
    std::set<int> wanted;
    for (int i = 3; i < argc; ++i) wanted.insert(std::atoi(argv[i]));
    const auto wants = [&](int first, int last) {
      return wanted.empty() || (wanted.lower_bound(first) != wanted.end() && *wanted.lower_bound(first) <= last);
    };
    std::filesystem::create_directories(folder);
    const std::string clips = data + "/people";
    if (wants(1, 4)) motex::bench::draw_motif_figures(clips, folder);
    if (wants(5, 8)) motex::bench::draw_transition_figures(clips, folder);
    if (wants(101, 103)) motex::bench::draw_experiments(clips, folder, wanted);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
