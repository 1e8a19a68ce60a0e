// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "motex/core/error.h"

/// Clips that the benchmarks of particles measure on. None is in the repository: each program says which of them are
/// not there, and measures what it can simulate.
namespace motex::bench {

/// MOTEX_BENCH_DATA, else ../shared/data/video. It may hold textured/, synth/ and dyntex/.
inline std::filesystem::path clip_folder() {
  const char* named = std::getenv("MOTEX_BENCH_DATA");
  if (named != nullptr && *named != '\0') return named;
  return std::filesystem::path(MOTEX_SHARED_DATA) / "video";
}

/// Calls measure(path) for each of these files that is there. What it throws is said, too. Returns how many were
/// there.
inline int for_each_clip(std::initializer_list<const char*> names, const auto& measure) {
  int num_found = 0;
  for (const char* name : names) {
    const std::filesystem::path path = clip_folder() / name;
    if (!std::filesystem::is_regular_file(path)) {
      std::printf("%s: left out, not in %s\n", name, clip_folder().c_str());
      continue;
    }
    ++num_found;
    try {
      measure(path);
    } catch (const Error& error) {
      std::printf("%s: %s\n", name, error.what());
    }
    std::fflush(stdout);
  }
  static bool is_said = false;
  if (num_found == 0 && !is_said) std::printf("scripts/bench particles FOLDER measures the clips of FOLDER\n");
  is_said = is_said || num_found == 0;
  return num_found;
}

}  // namespace motex::bench
