// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "particles_model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "motex/core/error.h"
#include "motex/project/textured_motion_file.h"
#include "motex/video_io/video_reader.h"
#include "output_file.h"

namespace motex::cli {

TexturedMotion load_particles_model(const std::string& path) {
  const std::vector<std::string> videos = readable_video_extensions();
  const bool is_video = std::find(videos.begin(), videos.end(), extension_of(path)) != videos.end();
  if (is_video || std::filesystem::is_directory(path) || path.find('%') != std::string::npos)
    throw InvalidInput(path + ": a video, not a model; learn it first: motex particles learn " + path +
                       " -o NAME.motex");
  return load_textured_motion(path);
}

Planes reconstructed_frame(const TexturedMotion& model, std::int64_t frame) {
  BaseMap map{model.width, model.height, model.num_planes, {}};
  for (const Cable& cable : model.cables) {
    if (!cable.covers(frame)) continue;
    map.bases.push_back(cable.at(frame));
    for (const std::vector<Base>& coil : cable.coils)
      map.bases.push_back(coil[static_cast<std::size_t>(frame - cable.first_frame)]);
  }
  return reconstruct(map, model.background);
}

std::string short_number(double value) {
  std::array<char, 32> word{};
  const double rounded = std::round(value * 1e6) / 1e6 + 0.0;  // no "-0"
  return {word.data(), std::to_chars(word.data(), word.data() + word.size(), rounded).ptr};
}

}  // namespace motex::cli
