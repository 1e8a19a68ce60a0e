// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Falling water: bases carried forward (life, PSNR) for several numbers of bases, and synthesis against a linear
// dynamic texture and a spatio-temporal autoregression of the whole clip. particles_water [FOLDER]: also writes
// FOLDER/particles_<clip>.png, source, ours and the two others from above: four frames 1, 2 and 30 frames later and a
// slice in time (right: the column at its middle, a frame a pixel).
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/particle_clips.h"
#include "bench/peers/linear_dynamic_texture.h"
#include "motex/audio/fourier.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/particles/learn_water.h"
#include "motex/particles/steady.h"
#include "motex/particles/water_synthesis.h"
#include "motex/project/load_video_clip.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 64, kFramesShown = 110;
constexpr int kTimeBands = 8, kSpaceBands = 12;
using Spectrum = std::array<double, kTimeBands * kSpaceBands>;  ///< dB
using Volume = std::vector<std::complex<double>>;

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<Plane> lumas(const std::vector<Image>& frames) {
  std::vector<Plane> out;
  for (const Image& frame : frames) out.push_back(luma(frame));
  return out;
}

struct Moments {
  Plane mean, deviation;
};

Moments moments(const std::vector<Plane>& frames) {
  Moments out{Plane(frames[0].width, frames[0].height), Plane(frames[0].width, frames[0].height)};
  const auto num = static_cast<float>(frames.size());
  for (std::size_t i = 0; i < out.mean.values.size(); ++i) {
    float sum = 0, squares = 0;
    for (const Plane& frame : frames) sum += frame.values[i] / num;
    for (const Plane& frame : frames) squares += (frame.values[i] - sum) * (frame.values[i] - sum) / num;
    out.mean.values[i] = sum;
    out.deviation.values[i] = std::sqrt(squares);
  }
  return out;
}

struct Corner {
  int x = 0, y = 0;
};

/// The square that moves most.
Corner liveliest(const Plane& deviation) {
  Corner best;
  double most = -1;
  for (int y = 0; y + kSide <= deviation.height; y += 8)
    for (int x = 0; x + kSide <= deviation.width; x += 8) {
      double sum = 0;
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) sum += static_cast<double>(deviation.at(x + i, y + j));
      if (sum > most) most = sum, best = {x, y};
    }
  return best;
}

/// Transform along an axis whose elements are `stride` apart.
void transform(Volume& volume, const FourierTransform& fourier, std::size_t stride) {
  std::vector<std::complex<double>> line(kSide);
  for (std::size_t start = 0; start < volume.size(); ++start) {
    if (start / stride % kSide != 0) continue;
    for (std::size_t k = 0; k < kSide; ++k) line[k] = volume[start + k * stride];
    fourier(line);
    for (std::size_t k = 0; k < kSide; ++k) volume[start + k * stride] = line[k];
  }
}

/// Power of 64 frames of the square in bands of temporal and (radial) spatial frequency, dB.
Spectrum spectrum(const std::vector<Plane>& frames, const Plane& mean, Corner corner) {
  const auto window = [](int k) { return 0.5 - 0.5 * std::cos(2 * 3.14159265358979 * (k + 0.5) / kSide); };
  Volume volume(static_cast<std::size_t>(kSide) * kSide * kSide);
  std::size_t at = 0;
  for (int t = 0; t < kSide; ++t)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x, ++at) {
        const Plane& frame = frames[static_cast<std::size_t>(t)];
        const int i = corner.x + x, j = corner.y + y;
        volume[at] = static_cast<double>(frame.at(i, j) - mean.at(i, j)) * window(t) * window(y) * window(x);
      }
  const FourierTransform fourier(kSide);
  for (const std::size_t stride : {std::size_t{1}, std::size_t{kSide}, std::size_t{kSide} * kSide})
    transform(volume, fourier, stride);
  Spectrum power{}, count{};
  at = 0;
  for (int t = 0; t < kSide; ++t)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x, ++at) {
        const int ft = std::min(t, kSide - t), fy = std::min(y, kSide - y), fx = std::min(x, kSide - x);
        const int space = static_cast<int>(std::hypot(fx, fy) * kSpaceBands / (kSide / 2));
        if (space >= kSpaceBands) continue;
        const int time = std::min(kTimeBands - 1, ft * kTimeBands / (kSide / 2));
        const auto band = static_cast<std::size_t>(time * kSpaceBands + space);
        power[band] += std::norm(volume[at]);
        count[band] += 1;
      }
  for (std::size_t k = 0; k < power.size(); ++k) power[k] = 10 * std::log10(power[k] / count[k] + 1e-3);
  return power;
}

struct Likeness {
  double spectra = 0;      ///< root mean square difference, dB
  double mean_map = 0;     ///< root mean square difference of the mean frames where water moves, grey levels
  double deviation = 0;    ///< deviation over time / the source's, where water moves
  double correlation = 0;  ///< of the maps of deviations
  double flicker = 0;      ///< deviation of the difference of frames / the source's
};

double flicker_of(const std::vector<Plane>& frames, const Plane& weight) {
  double sum = 0, total = 1e-9;
  for (std::size_t t = 1; t < frames.size(); ++t)
    for (std::size_t i = 0; i < weight.values.size(); ++i) {
      const double d = static_cast<double>(frames[t].values[i] - frames[t - 1].values[i]);
      sum += static_cast<double>(weight.values[i]) * d * d;
      total += static_cast<double>(weight.values[i]);
    }
  return std::sqrt(sum / total);
}

Likeness compare(const std::vector<Plane>& source, const std::vector<Plane>& made) {
  const Moments a = moments(source), b = moments(made);
  const Corner corner = liveliest(a.deviation);
  const Spectrum p = spectrum(source, a.mean, corner), q = spectrum(made, b.mean, corner);
  Likeness out;
  for (std::size_t k = 0; k < p.size(); ++k)
    out.spectra += (p[k] - q[k]) * (p[k] - q[k]) / static_cast<double>(p.size());
  out.spectra = std::sqrt(out.spectra);
  double most = 0;
  for (const float v : a.deviation.values) most = std::max(most, static_cast<double>(v));
  Plane weight = a.deviation;
  double n = 1e-9, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < weight.values.size(); ++i) {
    const double da = static_cast<double>(a.deviation.values[i]), db = static_cast<double>(b.deviation.values[i]);
    weight.values[i] = da > 0.25 * most ? 1 : 0;
    if (weight.values[i] == 0) continue;
    const double dm = static_cast<double>(a.mean.values[i] - b.mean.values[i]);
    out.mean_map += dm * dm;
    n += 1, sa += da, sb += db, saa += da * da, sbb += db * db, sab += da * db;
  }
  out.mean_map = std::sqrt(out.mean_map / n);
  out.deviation = sb / sa;
  out.correlation =
      (sab / n - sa * sb / n / n) / std::sqrt((saa / n - sa * sa / n / n) * (sbb / n - sb * sb / n / n) + 1e-12);
  out.flicker = flicker_of(made, weight) / flicker_of(source, weight);
  return out;
}

Image row_of(const std::vector<Image>& frames) {
  const int width = frames[0].width, height = frames[0].height, gap = 4;
  const int slice = std::min(kFramesShown, static_cast<int>(frames.size()));
  Image out(4 * (width + gap) + kFramesShown, height, {255, 255, 255, 255});
  int left = 0;
  for (const std::size_t t : {10, 11, 12, 40}) {
    paste(out, frames[t], left, 0);
    left += width + gap;
  }
  for (int t = 0; t < slice; ++t)
    for (int y = 0; y < height; ++y) out.at(left + t, y) = frames[static_cast<std::size_t>(t)].at(width / 2, y);
  return out;
}

std::vector<Image> synthesized(const TexturedMotion& model, std::size_t num) {
  WaterSource source(model, {}, 1);
  WaterPainter painter(model, model.background, 1, 1);
  std::vector<Image> frames(num);
  MovetonFrame frame;
  Image layer;
  for (Image& picture : frames) {
    source.next_frame(frame);
    painter.paint(frame, picture, layer);
  }
  return frames;
}

std::vector<Image> of_dynamic_texture(const ClipFrames& clip, std::size_t num) {
  std::vector<Planes> frames;
  for (const Image& image : clip.colour) frames.push_back(to_planes(image, 3));
  peers::LinearDynamicTexture texture(frames, 40);
  std::vector<Image> out;
  for (std::size_t t = 0; t < num; ++t) out.push_back(to_image(texture.next()));
  return out;
}

/// The light of the whole clip by one autoregression; colours from the mean frame.
std::vector<Image> of_star(const ClipFrames& clip, const TexturedMotion& model, std::size_t num) {
  StarSampler sampler(fit_star(clip.luma, model.water->flow), 1);
  const Plane grey = luma(model.background);
  std::vector<Image> out;
  for (std::size_t t = 0; t < num; ++t) {
    const Plane& light = sampler.next();
    Planes frame = model.background;
    for (Plane& plane : frame)
      for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] += light.values[i] - grey.values[i];
    out.push_back(to_image(frame));
  }
  return out;
}

void print(const char* name, const Likeness& likeness) {
  std::printf("  %-24s spectra %5.2f dB  mean %5.2f  deviation × %.2f (maps correlate %.2f)  flicker × %.2f\n", name,
              likeness.spectra, likeness.mean_map, likeness.deviation, likeness.correlation, likeness.flicker);
  std::fflush(stdout);
}

void measure(const fs::path& path, const std::string& folder) {
  LoadVideoClipOptions load;
  load.num_frames = 120;
  const SteadyClip steadied = steady(load_video_clip(path, load));
  const ClipFrames& clip = steadied.clip;
  std::printf("%s: %d frames of %d × %d\n", path.filename().string().c_str(), clip.num_frames(), clip.width,
              clip.height);
  for (const int num_bases : {100, 300}) {
    LearnWaterOptions options;
    options.num_bases = num_bases;
    const double start = processor_secs();
    const LearnedWater learned = learn_water(clip, options);
    std::printf("  %d bases: mean life %.1f frames, %.2f dB (background %.2f), learned in %.0f s\n", num_bases,
                learned.carry.mean_life, learned.carry.psnr, learned.carry.background_psnr, processor_secs() - start);
    std::fflush(stdout);
  }
  const LearnedWater learned = learn_water(clip);
  std::printf("  %d bases chosen: mean life %.1f frames, %.2f dB\n", learned.num_bases, learned.carry.mean_life,
              learned.carry.psnr);
  const auto num = static_cast<std::size_t>(std::max(kFramesShown, kSide));
  const double start = processor_secs();
  const std::vector<Image> ours = synthesized(learned.model, num);
  std::printf("  synthesized at %.0f frames/s\n", static_cast<double>(num) / (processor_secs() - start));
  const std::vector<Image> texture = of_dynamic_texture(clip, num), star = of_star(clip, learned.model, num);
  print("ours", compare(clip.luma, lumas(ours)));
  print("linear dynamic texture", compare(clip.luma, lumas(texture)));
  print("autoregression", compare(clip.luma, lumas(star)));
  if (folder.empty()) return;
  Image picture(4 * (clip.width + 4) + kFramesShown, 4 * (clip.height + 4), {255, 255, 255, 255});
  const std::vector<Image>* const rows[] = {&clip.colour, &ours, &texture, &star};
  for (int k = 0; k < 4; ++k) paste(picture, row_of(*rows[k]), 0, k * (clip.height + 4));
  const std::string stem = path.stem().string();
  write_file(fs::path(folder) / ("particles_" + stem.substr(0, stem.rfind('_')) + ".png"), encode_png(picture));
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  motex::bench::for_each_clip(
      {"textured/waterfall_pool_320x240.mp4", "textured/waterfall_kjos_320x240.mp4",
       "dyntex/dyntex_6486110_fountain.avi", "dyntex/dyntex_55fa210_boiling_water.avi"},
      [&](const std::filesystem::path& path) { motex::measure(path, argc > 1 ? argv[1] : ""); });
}
