// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Compression of clips, everything counted: raw bytes (width · height · planes · frames) over those of the file, PSNR
// of what a decoder makes of the bytes, against 300 bases by matching pursuit in every frame over the same background.
// With free bases alone, and with elements that were followed stored as paths. The model alone:
// generative_model_bytes().
#include <cstdio>
#include <filesystem>
#include <string>

#include "bench/particle_clips.h"
#include "motex/core/error.h"
#include "motex/particles/carry_bases.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/clip_codec.h"
#include "motex/particles/compress_clip.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_elements.h"
#include "motex/project/compression.h"
#include "motex/project/load_video_clip.h"

namespace motex {
namespace {

constexpr int kBases = 300;

double mean_psnr(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables) {
  double sum = 0;
  for (int t = 0; t < clip.num_frames(); ++t)
    sum += psnr(reconstruct(bases_in_frame(cables, t, clip.width, clip.height, clip.num_planes()), background),
                frame_planes(clip, t));
  return sum / clip.num_frames();
}

/// Of the frames in 8 bits, from the bytes alone.
double decoded_psnr(const ClipFrames& clip, const std::string& bytes) {
  const QuantisedClip back = read_clip_bytes(bytes, "bench");
  const std::vector<Cable> cables = dequantised_cables(back);
  double sum = 0;
  for (int t = 0; t < clip.num_frames(); ++t)
    sum += psnr(to_planes(to_image(decoded_frame(back, cables, t)), clip.num_planes()), frame_planes(clip, t));
  return sum / clip.num_frames();
}

void show(const char* how, const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
          double of_pursuit) {
  CompressClipReport report;
  const std::string bytes = compress_clip(clip, background, cables, {}, {}, &report);
  const double decoded = decoded_psnr(clip, bytes);
  std::printf(
      "  %-22s %6.1f x  %8lld of %lld bytes, background %lld; %.2f dB decoded, %+.2f against %d bases; "
      "%.1f bases a frame, %.1f bits each\n",
      how, report.ratio(), static_cast<long long>(report.bytes), static_cast<long long>(report.raw_bytes),
      static_cast<long long>(report.background_bytes), decoded, decoded - of_pursuit, kBases, report.bases_per_frame,
      report.bits_per_base);
  std::fflush(stdout);
}

void measure(const std::string& name, const ClipFrames& clip) {
  const ClipBackground ground(clip, BackgroundKind::kMedian, {});
  const Planes& background = ground.still();
  const std::vector<Cable> free = with_free_bases(clip, background, {}, kBases);
  const double of_pursuit = mean_psnr(clip, background, free);
  std::printf("%s: %d bases a frame %.2f dB, background alone %.2f dB\n", name.c_str(), kBases, of_pursuit,
              mean_psnr(clip, background, {}));
  show("free bases", clip, background, free, of_pursuit);

  CarryOptions carry;
  carry.num_bases = kBases;
  show("bases carried forward", clip, background, carry_bases(clip, background, carry), of_pursuit);

  TexturedMotion model;
  model.width = clip.width;
  model.height = clip.height;
  model.num_planes = clip.num_planes();
  model.num_frames = clip.num_frames();
  model.background = background;
  TrackElementsReport tracked;
  model.cables = track_elements(clip, luma(background), 0, {}, {}, &tracked);
  model.noise = tracked.noise;
  for (Cable& cable : model.cables)
    for (Base& base : cable.core) base.coefficients[1] = base.coefficients[2] = base.coefficients[0];
  show("paths and free bases", clip, background, with_free_bases(clip, background, model.cables, kBases), of_pursuit);
  show("paths alone", clip, background, model.cables, of_pursuit);
  FitDynamicsOptions options;
  options.estimate_errors = true;
  model.templates.resize(1);
  model.templates[0].poses.resize(1);
  model.dynamics = {fit_dynamics(model.cables, options)};
  model.maps = estimate_maps(model.cables, clip.width, clip.height, clip.num_frames());
  const auto model_bytes = static_cast<long long>(generative_model_bytes(model).size());
  std::printf("  %-22s %6.1f x  %8lld bytes\n", "model without paths",
              static_cast<double>(clip.width) * clip.height * clip.num_planes() * clip.num_frames() /
                  static_cast<double>(model_bytes),
              model_bytes);
  std::fflush(stdout);
}

ClipFrames simulated(double elements, std::uint64_t seed) {
  SimulateSnowOptions options;
  options.elements = elements;
  options.seed = seed;
  return clip_frames_of(simulate_snow(options));
}

int run() {
  bench::for_each_clip({"textured/snow_forest_320x240.mp4"},
                       [](const std::filesystem::path& path) { measure("snow_forest", load_video_clip(path)); });
  for (const double elements : {60.0, 150.0, 300.0})
    measure("simulated snow, " + std::to_string(static_cast<int>(elements)) + " a frame",
            simulated(elements, 7 + static_cast<std::uint64_t>(elements)));
  return 0;
}

}  // namespace
}  // namespace motex

int main() { return motex::run(); }
