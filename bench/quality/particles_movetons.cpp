// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Movetons around cores that follow the true tracks of a scene: PSNR with cores alone and with coils, bases per
// element, species, poses and their transitions against the truth, processor seconds.
//   particles_movetons [VIDEO TRACKS.csv]...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/particles/background.h"
#include "motex/particles/coils.h"
#include "motex/particles/refine.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/track_csv.h"

namespace motex {
namespace {

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Planes background_of(const ClipFrames& clip) {
  std::vector<Planes> frames;
  for (std::size_t i = 0; i < clip.luma.size(); i += std::max<std::size_t>(1, clip.luma.size() / 61))
    frames.push_back(clip.colour.empty() ? Planes{clip.luma[i]} : to_planes(clip.colour[i], 3));
  return quantile_over_time(frames, 0.5);
}

/// One Gaussian core a point, fitted to the picture; runs of consecutive frames. ids: of the tracks they are from.
std::vector<Cable> cables_of(const std::vector<Track>& tracks, const ClipFrames& clip, const Planes& background,
                             std::vector<std::int64_t>& ids) {
  std::vector<Plane> residuals = clip.luma;
  const Plane grey = luma(background);
  for (Plane& plane : residuals)
    for (std::size_t i = 0; i < grey.values.size(); ++i) plane.values[i] -= grey.values[i];
  std::vector<Cable> out;
  for (const Track& track : tracks) {
    std::int64_t last = -2;
    std::vector<std::size_t> begins;
    for (const TrackPoint& point : track.points) {
      if (point.frame < 0 || point.frame >= clip.num_frames() || point.amplitude == 0) continue;
      if (point.x < 0 || point.y < 0 || point.x > clip.width - 1 || point.y > clip.height - 1) continue;
      if (point.frame != last + 1) {
        out.push_back({point.frame, {}, {}, -1, {}});
        ids.push_back(track.id);
      }
      last = point.frame;
      Base core{BaseKind::kGaussian, point.x, point.y, point.scale > 0 ? std::clamp(point.scale, 0.8, 8.0) : 1.5, 0, {}};
      const FittedBase fit = refine_base(residuals[static_cast<std::size_t>(point.frame)], core, 6);
      if (std::hypot(fit.base.x - core.x, fit.base.y - core.y) < core.scale) core = fit.base;
      core.coefficients[0] = fit.coefficient;
      out.back().core.push_back(core);
    }
  }
  return out;
}

void measure(const std::filesystem::path& video, const std::filesystem::path& truth) {
  const ClipFrames clip = load_video_clip(video);
  const Planes background = background_of(clip);
  std::vector<std::int64_t> ids;
  std::vector<Cable> cables = cables_of(parse_tracks_csv(read_file(truth), truth.string()), clip, background, ids);
  std::size_t elements = 0;
  for (const Cable& cable : cables) elements += cable.core.size();
  const double start = processor_secs();
  const GrowCoilsReport report = grow_coils(clip, background, cables);
  const double grown = processor_secs();
  std::printf("%-24s %4zu cables, %5.1f a frame: PSNR background %.2f, cores %.2f, with coils %.2f dB; %.2f bases a "
              "moveton; isolated %.0f %%; noise %.2f; coils %.2f s\n",
              video.filename().string().c_str(), cables.size(),
              static_cast<double>(elements) / clip.num_frames(), report.background_psnr, report.cores_psnr, report.psnr,
              report.bases_per_moveton, 100 * report.isolated_share, report.noise, grown - start);
}

int run(int argc, char** argv) {
  std::vector<std::filesystem::path> files(argv + 1, argv + argc);
  if (files.empty()) {
    const std::filesystem::path folder = std::filesystem::path(MOTEX_SHARED_DATA) / "video/synth";
    for (const char* name : {"synth_birds", "synth_snow", "synth_fireworks"}) {
      files.push_back(folder / (std::string(name) + ".mkv"));
      files.push_back(folder / (std::string(name) + "_tracks.csv"));
    }
  }
  for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
    try {
      measure(files[i], files[i + 1]);
    } catch (const Error& error) {
      std::printf("%s\n", error.what());
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) { return motex::run(argc, argv); }
