// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "video_output.h"

#include <cctype>
#include <filesystem>

#include "motex/core/error.h"
#include "motex/video_io/video_writer.h"
#include "output_file.h"
#include "output_folder.h"

namespace motex::cli {
namespace {

namespace fs = std::filesystem;

void check_pattern(const std::string& path, const Session& session) {
  const fs::path parent = fs::path(path).parent_path();
  if (extension_of(path) != ".png") throw InvalidInput(path + ": pictures are written as .png");
  if (!parent.empty() && !fs::is_directory(parent))
    throw InvalidInput(path + ": there is no folder " + parent.string());
  if (session.flags.force) return;
  const std::string name = fs::path(path).filename().string(), head = name.substr(0, name.find('%'));
  for (const fs::directory_entry& entry : fs::directory_iterator(parent.empty() ? "." : parent)) {
    const std::string found = entry.path().filename().string();
    const bool numbered = found.size() > head.size() && found.starts_with(head) && found.ends_with(".png") &&
                          std::isdigit(static_cast<unsigned char>(found[head.size()])) != 0;
    if (numbered) throw InvalidInput(entry.path().string() + ": exists; --force replaces such files");
  }
}

}  // namespace

void check_video_output(const std::string& path, const Session& session) {
  const bool is_pattern = path.find('%') != std::string::npos;
  if (extension_of(path).empty() && !is_pattern)
    check_output_folder(path, session);
  else if (extension_of(path) == ".png" && !is_pattern)
    throw InvalidInput(path + ": PNG files are numbered: write NAME_%04d.png, or a folder");
  else if (is_pattern)
    check_pattern(path, session);
  else
    check_output(path, writable_video_extensions(), session);
}

}  // namespace motex::cli
