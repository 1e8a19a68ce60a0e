// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "particles_model.h"

#include <algorithm>
#include <filesystem>

#include "arguments.h"
#include "motex/core/error.h"
#include "motex/particles/carry_bases.h"
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

std::pair<int, int> parse_picture_size(const std::string& text) {
  const std::size_t mark = text.find_first_of("x,");
  if (mark == std::string::npos) throw InvalidInput("--size: write width x height, as in 320x240, not " + text);
  std::pair<int, int> size;
  parse_value("--size", text.substr(0, mark), size.first);
  parse_value("--size", text.substr(mark + 1), size.second);
  if (size.first < 1 || size.second < 1) throw InvalidInput("--size: width and height are at least 1");
  return size;
}

Planes reconstructed_frame(const TexturedMotion& model, std::int64_t frame) {
  return reconstruct(bases_in_frame(model.cables, frame, model.width, model.height, model.num_planes),
                     model.background);
}

}  // namespace motex::cli
