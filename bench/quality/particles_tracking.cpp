// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Tracking against known truth: β, JSC over tracks and the position error of detection and linking from frames (the
// flow learned and not told), of linking given detections, and processor seconds. Scenes: NAME.mkv with NAME_gt.csv
// (and NAME_det.csv: frame, x, y) or NAME_tracks.csv in the folders of MOTEX_BENCH_DATA (separated by ':'; a folder
// named jsc: gate 3 px, 6 px of border ignored), without it those of shared/data/video/synth, else simulated ones.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <sstream>
#include <string>

#include "bench/particle_clips.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/particles/background.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_elements.h"
#include "motex/particles/track_score.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/track_csv.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Rule {
  double gate = 5, border = 0;
};

std::vector<Track> cut(std::vector<Track> tracks, const ClipFrames& clip, double border) {
  for (Track& track : tracks)
    for (TrackPoint& point : track.points) {
      point.x -= border;
      point.y -= border;
    }
  const int twice = static_cast<int>(2 * border);
  return visible_part(tracks, clip.width - twice, clip.height - twice);
}

void print(const std::string& name, const char* what, const std::vector<Track>& truth, const std::vector<Track>& tracks,
           const ClipFrames& clip, const Rule& rule, const LinkReport& report, double secs) {
  const TrackingScore s = score_tracks(cut(truth, clip, rule.border), cut(tracks, clip, rule.border), rule.gate);
  std::printf(
      "%-22s %-10s beta %.3f  JSC of tracks %.3f  error %.3f px  %d true, %d found; flow %.2f %.2f (peak ratio %.0f), "
      "expected wrong links %.2f %%; %.2f s of processor\n",
      name.c_str(), what, s.beta, s.jsc_tracks, s.rmse, s.num_true, s.num_estimated, report.flow.flow.vx,
      report.flow.flow.vy, report.flow.flow.peak_ratio, 100 * report.expected_wrong_share, secs);
  std::fflush(stdout);
}

std::vector<std::vector<TrackPoint>> read_detections(const fs::path& path, int num_frames) {
  std::vector<std::vector<TrackPoint>> frames(static_cast<std::size_t>(num_frames));
  std::istringstream lines(read_file(path));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    TrackPoint point;
    long frame = 0;
    if (std::sscanf(line.c_str(), "%ld,%lf,%lf", &frame, &point.x, &point.y) != 3 || frame < 0 || frame >= num_frames)
      continue;
    frames[static_cast<std::size_t>(frame)].push_back(point);
  }
  return frames;
}

void measure_frames(const std::string& name, const ClipFrames& clip, const std::vector<Track>& truth,
                    const Rule& rule) {
  std::vector<Planes> frames;
  for (const Plane& plane : clip.luma) frames.push_back({plane});
  const Plane background = quantile_over_time(frames, 0.5)[0];
  JobContext one_core;
  one_core.jobs = 1;
  TrackElementsReport report;
  const double start = processor_secs();
  const std::vector<Cable> cables = track_elements(clip, background, 0, {}, one_core, &report);
  print(name, "frames", truth, tracks_of(cables, 1), clip, rule, report.link, processor_secs() - start);
}

void measure(const fs::path& video, const fs::path& truth_path, const Rule& rule) {
  const std::string name = video.parent_path().filename().string() + "/" + video.stem().string();
  const ClipFrames clip = load_video_clip(video);
  const std::vector<Track> truth = parse_tracks_csv(read_file(truth_path), truth_path.string());
  measure_frames(name, clip, truth, rule);
  const fs::path given = video.parent_path() / (video.stem().string() + "_det.csv");
  if (!fs::exists(given)) return;
  LinkReport linking;
  const double start = processor_secs();
  const std::vector<Track> tracks =
      link_points(read_detections(given, clip.num_frames()), clip.width, clip.height, {}, &linking);
  print(name, "detections", truth, tracks, clip, rule, linking, processor_secs() - start);
}

void measure_folder(const fs::path& folder) {
  const Rule rule = folder.filename() == "jsc" ? Rule{3, 6} : Rule{};
  std::vector<fs::path> videos;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".mkv") videos.push_back(entry.path());
  std::sort(videos.begin(), videos.end());
  for (const fs::path& video : videos)
    for (const char* ending : {"_gt.csv", "_tracks.csv"}) {
      const fs::path truth = folder / (video.stem().string() + ending);
      if (fs::exists(truth)) measure(video, truth, rule);
    }
}

void measure_scene(const std::string& name, const SimulatedScene& scene) {
  measure_frames(name, clip_frames_of(scene), tracks_of(true_cables(scene), clip_frames_of(scene).num_planes()), {});
}

void measure_simulated() {
  for (const double elements : {60.0, 150.0, 300.0}) {
    SimulateSnowOptions snow;
    snow.elements = elements;
    measure_scene("snow, " + std::to_string(static_cast<int>(elements)) + " a frame", simulate_snow(snow));
  }
  measure_scene("birds", simulate_birds());
  measure_scene("fireworks", simulate_fireworks());
}

int run() {
  const std::string folders = bench::clip_folder().string();
  if (folders.find(':') == std::string::npos && !fs::is_directory(folders)) {
    std::printf("no scenes in %s: some are simulated\n", folders.c_str());
    measure_simulated();
    return 0;
  }
  std::istringstream list(folders);
  for (std::string folder; std::getline(list, folder, ':');) {
    try {
      const fs::path synth = fs::path(folder) / "synth";
      measure_folder(fs::exists(synth) ? synth : fs::path(folder));
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", folder.c_str(), error.what());
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace motex

int main() { return motex::run(); }
