// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Keying against known mattes: IoU of alpha ≥ ½, mean absolute difference of alpha · 10³, dtSSD · 10³ (root mean square
// of the error's change from frame to frame), processor milliseconds a frame (the least of five runs), and seconds for
// the clean plate.
// people_keying FOLDER...: each made by `motex people simulate`, or holding frames as actor.bgr (raw) and mattes as
// actor_alpha.npy (uint8, frames × rows × columns).
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/people/clean_plate.h"
#include "motex/people/key.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The least of a few runs: others on the machine only add to it.
template <typename Work>
double least_secs(const Work& work) {
  constexpr int kRuns = 5;
  double least = 0;
  for (int run = 0; run < kRuns; ++run) {
    const double before = processor_secs();
    work();
    const double secs = processor_secs() - before;
    if (run == 0 || secs < least) least = secs;
  }
  return least;
}

struct Scene {
  std::vector<Image> frames;
  std::vector<std::vector<std::uint8_t>> alphas;
  bool coarse_colour = false;
};

/// The three numbers of "'shape': (90, 480, 720)".
std::vector<int> shape_of(const std::string& header) {
  std::vector<int> shape;
  std::size_t at = header.find('(');
  while (at != std::string::npos && shape.size() < 3) {
    shape.push_back(std::atoi(header.c_str() + at + 1));
    at = header.find(',', at + 1);
  }
  return shape;
}

Scene read_scene(const std::filesystem::path& folder) {
  const std::string npy = read_file((folder / "actor_alpha.npy").string());
  const std::string bgr = read_file((folder / "actor.bgr").string());
  const std::size_t begin = 10 + static_cast<unsigned char>(npy.at(8)) + 256U * static_cast<unsigned char>(npy.at(9));
  const std::vector<int> shape = shape_of(npy.substr(10, begin - 10));
  const int width = shape.at(2), height = shape.at(1);
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Scene scene;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.at(0)); ++k) {
    Image frame(width, height);
    const char* from = bgr.data() + k * size * 3;
    for (std::size_t i = 0; i < size; ++i, from += 3)
      frame.pixels[i] = {static_cast<std::uint8_t>(from[2]), static_cast<std::uint8_t>(from[1]),
                         static_cast<std::uint8_t>(from[0]), 255};
    scene.frames.push_back(std::move(frame));
    const auto matte = npy.begin() + static_cast<std::ptrdiff_t>(begin + k * size);
    scene.alphas.emplace_back(matte, matte + static_cast<std::ptrdiff_t>(size));
  }
  return scene;
}

/// As `motex people simulate` writes it.
Scene read_simulation(const std::filesystem::path& folder) {
  const bool lossless = std::filesystem::exists(folder / "scene.mkv");
  VideoReader film(folder / (lossless ? "scene.mkv" : "scene.mp4")), mattes(folder / "matte.mkv");
  Scene scene;
  scene.coarse_colour = film.info().coarse_colour;
  for (VideoFrame frame, matte; film.next(frame) && mattes.next(matte);) {
    std::vector<std::uint8_t> alphas;
    for (const Rgba& pixel : matte.image.pixels) alphas.push_back(pixel.r);
    scene.frames.push_back(std::move(frame.image));
    scene.alphas.push_back(std::move(alphas));
  }
  return scene;
}

Scene read_folder(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "matte.mkv") ? read_simulation(folder) : read_scene(folder);
}

struct Score {
  double intersection = 0, either = 0, difference = 0, change = 0;
  std::int64_t num_pixels = 0, num_changes = 0;

  void add(const std::vector<int>& error, const std::vector<int>& previous) {
    for (std::size_t i = 0; i < error.size(); ++i) {
      difference += std::abs(error[i]) / 255.0;
      if (!previous.empty()) change += std::pow((error[i] - previous[i]) / 255.0, 2);
    }
    num_pixels += static_cast<std::int64_t>(error.size());
    num_changes += previous.empty() ? 0 : static_cast<std::int64_t>(error.size());
  }
};

std::vector<std::uint8_t> alphas_of(const Sprite& sprite, int width, int height) {
  std::vector<std::uint8_t> alphas(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x)
      alphas[static_cast<std::size_t>(y + sprite.top) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(x + sprite.left)] = sprite.at(x, y)[3];
  return alphas;
}

void measure(const std::string& name, const Scene& scene) {
  const int width = scene.frames[0].width, height = scene.frames[0].height;
  const auto wanted = static_cast<std::size_t>(num_plate_frames(width, height));
  const std::size_t step = (scene.frames.size() + wanted - 1) / wanted;
  std::vector<Image> sampled;
  for (std::size_t k = 0; k < scene.frames.size(); k += step) sampled.push_back(scene.frames[k]);
  const double start = processor_secs();
  CleanPlate plate = estimate_clean_plate(sampled);
  const double ready = processor_secs();
  plate.coarse_colour = scene.coarse_colour;
  Keyer keyer(std::move(plate));
  Score score;
  Sprite sprite;
  double secs = 0;
  std::vector<int> previous;
  for (std::size_t k = 0; k < scene.frames.size(); ++k) {
    secs += least_secs([&] { keyer.key(scene.frames[k], sprite); });
    const std::vector<std::uint8_t> alphas = alphas_of(sprite, width, height);
    std::vector<int> error(alphas.size());
    for (std::size_t i = 0; i < alphas.size(); ++i) {
      const bool found = alphas[i] >= 128, is = scene.alphas[k][i] >= 128;
      score.intersection += found && is ? 1 : 0;
      score.either += found || is ? 1 : 0;
      error[i] = alphas[i] - scene.alphas[k][i];
    }
    score.add(error, previous);
    previous = std::move(error);
  }
  std::printf("%-28s %-7s IoU %.4f  MAD %.3f  dtSSD %.2f  %.2f ms a frame, plate %.2f s, seen %.2f\n", name.c_str(),
              name_of(keyer.plate().kind), score.intersection / score.either,
              1e3 * score.difference / static_cast<double>(score.num_pixels),
              1e3 * std::sqrt(score.change / static_cast<double>(std::max<std::int64_t>(1, score.num_changes))),
              1e3 * secs / static_cast<double>(scene.frames.size()), ready - start, keyer.plate().seen_share);
}

int run(const std::vector<std::string>& folders) {
  if (folders.empty()) std::puts("people_keying FOLDER...: name folders with frames and true mattes");
  for (const std::string& folder : folders) {
    try {
      measure(folder, read_folder(folder));
    } catch (const Error& error) {
      std::printf("%s: %s\n", folder.c_str(), error.what());
    }
  }
  return 0;
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) { return motex::run({argv + 1, argv + argc}); }
