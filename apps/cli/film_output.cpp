// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "film_output.h"

#include <set>

#include "colour_argument.h"
#include "motex/core/error.h"
#include "motex/video_io/video_writer.h"
#include "output_file.h"
#include "video_output.h"

namespace motex::cli {

void declare_film_output(Arguments& arguments, std::vector<std::string>& outputs) {
  arguments
      .value("-o,--output", "FILE",
             "with alpha: .mov (ProRes 4444), .webm (VP9), .mkv (FFV1), a folder of PNG files or a pattern "
             "(f_%04d.png); over a background: .mp4 and .avi too; may be given several times",
             outputs)
      .required = true;
}

void check_film_output(const std::vector<std::string>& outputs, const std::string& background, const Session& session) {
  std::set<std::string> seen;
  for (const std::string& path : outputs) {
    check_video_output(path, session);
    if (!seen.insert(path).second) throw InvalidInput(path + ": named twice");
    const std::string extension = extension_of(path);
    if (background.empty() && !extension.empty() && extension != ".png" && !keeps_alpha(extension))
      throw InvalidInput(path + ": keeps no alpha; write .mov, .webm, .mkv or PNG files, or name a --background");
  }
}

std::optional<Backdrop> backdrop_of(const std::string& background, int width, int height, const JobContext& job) {
  std::optional<Backdrop> backdrop;
  if (background.empty()) return backdrop;
  if (const std::optional<Rgba> colour = colour_of(background))
    backdrop.emplace(*colour, width, height);
  else
    backdrop.emplace(background, width, height, job);
  return backdrop;
}

}  // namespace motex::cli
