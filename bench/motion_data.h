// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "motex/motion_texture/features.h"
#include "motex/project/load_clips.h"

/// Clips that the benchmarks of motion measure on.
namespace motex::bench {

/// The folder of mocap data: the program's argument, else MOTEX_BENCH_DATA, else ../shared/data/mocap, else what is
/// bundled. It may hold salsa/ (28 clips of two dancers) and quickstart/ (three of them).
inline std::filesystem::path data_folder(int argc, char** argv) {
  if (argc > 1) return argv[1];
  const char* named = std::getenv("MOTEX_BENCH_DATA");
  if (named != nullptr && *named != '\0') return named;
  const std::filesystem::path shared = MOTEX_SHARED_DATA "/mocap";
  return std::filesystem::is_directory(shared) ? shared : std::filesystem::path(MOTEX_TEST_DATA "/mocap");
}

struct Dance {
  std::string name;
  std::vector<Clip> clips;  ///< sorted by name
};

/// Clips of a folder whose names begin with `prefix`, or none where there is no such folder.
inline std::vector<Clip> clips_of(const std::filesystem::path& folder, const std::string& prefix = "") {
  std::vector<std::filesystem::path> paths;
  if (std::filesystem::is_directory(folder))
    for (const auto& path : find_clip_files({folder}))
      if (path.filename().string().starts_with(prefix)) paths.push_back(path);
  return paths.empty() ? std::vector<Clip>() : load_clips(paths);
}

/// What there is of: the three bundled clips, one dancer, two dancers.
inline std::vector<Dance> all_dances(const std::filesystem::path& folder) {
  std::vector<Dance> dances{{"quickstart", clips_of(folder / "quickstart")},
                            {"salsa, subject 61", clips_of(folder / "salsa", "cmu61")},
                            {"salsa", clips_of(folder / "salsa")}};
  std::erase_if(dances, [](const Dance& dance) { return dance.clips.empty(); });
  if (dances.empty()) dances.push_back({folder.filename().string(), clips_of(folder)});
  if (dances[0].clips.empty()) throw InvalidInput("no clips in " + folder.string());
  return dances;
}

inline Index total_frames(const std::vector<Clip>& clips) {
  Index total = 0;
  for (const Clip& clip : clips) total += clip.num_frames();
  return total;
}

struct Split {
  std::vector<Clip> training, held_out;
};

/// Every 7th clip by name, from the split's number on; of fewer than 14 clips, one.
inline Split split_by_clip(const std::vector<Clip>& clips, std::size_t split) {
  constexpr std::size_t kStep = 7;
  const std::size_t step = clips.size() >= 2 * kStep ? kStep : clips.size();
  Split parts;
  for (std::size_t i = 0; i < clips.size(); ++i)
    (i % step == split % step ? parts.held_out : parts.training).push_back(clips[i]);
  return parts;
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// The clip with its heading taken out, so that only the body's own shape is compared and not where the dancer looks.
inline Clip without_heading(const FeatureSpace& space, Clip clip) {
  for (Index t = 0; t < clip.num_frames(); ++t) {
    const double heading = root_place(space, clip, t).heading;
    const Quat turn(Eigen::AngleAxisd(-heading, Vector3::UnitY()));
    clip.set_rotation(t, space.travelling_joint, turn * clip.rotation(t, space.travelling_joint));
  }
  return clip;
}

/// Runs a benchmark; what goes wrong becomes one line and exit code 1.
template <typename Work>
int run(int argc, char** argv, Work&& work) {
  try {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    work(data_folder(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace motex::bench
