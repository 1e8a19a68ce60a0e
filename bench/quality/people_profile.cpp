// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// people_profile [--window M] SERIES...: processor seconds of the exact matrix profile of each series (one column of
// numbers; `motex people motifs SERIES --window M --profile OUT.csv` writes the profile itself), one thread. Without a
// series: 9,000 and 100,000 points of a first-order process.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "motex/core/files.h"
#include "motex/core/rng.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/series_windows.h"
#include "motex/project/series_csv.h"

namespace motex {
namespace {

FrameMatrix first_order_process(Index num_frames) {
  Rng rng(1);
  FrameMatrix x(num_frames, 1);
  double level = 0;
  for (Index t = 0; t < num_frames; ++t) x(t, 0) = level = 0.9 * level + rng.normal();
  return x;
}

void measure(const std::string& name, const FrameMatrix& series, int window) {
  JobContext one;
  one.jobs = 1;
  const std::clock_t begin = std::clock();
  matrix_profile(series_windows(series, window), -1, one);
  std::printf("%s: %d points, window %d: %.3f s of processor\n", name.c_str(), static_cast<int>(series.rows()), window,
              static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  std::fflush(stdout);
}

void run(const std::vector<std::string>& arguments) {
  int window = 80;
  bool any = false;
  for (std::size_t k = 0; k < arguments.size(); ++k)
    if (arguments[k] == "--window" && k + 1 < arguments.size()) {
      window = std::atoi(arguments[++k].c_str());
    } else {
      any = true;
      measure(arguments[k], parse_series_csv(read_file(arguments[k]), arguments[k]).values, window);
    }
  if (any) return;
  for (const Index num_frames : {9000, 100000}) measure("first-order process", first_order_process(num_frames), window);
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  try {
    motex::run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "people_profile: %s\n", error.what());
    return 1;
  }
}
