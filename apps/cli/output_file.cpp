// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "output_file.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "closest.h"
#include "motex/core/error.h"
#include "motex/core/files.h"

namespace motex::cli {
namespace fs = std::filesystem;

void check_output(const std::string& path, const std::vector<std::string>& extensions, const Session& session) {
  const std::string extension = extension_of(path);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw InvalidInput(path + ": cannot write " + (extension.empty() ? "a file without extension" : extension) +
                       "; the name should end in " + enumerate(extensions, "or") + did_you_mean(extension, extensions));
  std::error_code ec;
  const auto status = fs::status(path, ec);
  const bool is_device = fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  if (is_device) return;
  if (fs::is_regular_file(status) && !session.flags.force) throw InvalidInput(path + ": exists; --force replaces it");
  AtomicFile probe(path);  // says what is wrong with the folder, and is removed again
}

void check_outputs(const std::vector<std::string>& paths, const std::vector<std::string>& extensions,
                   const Session& session) {
  std::set<fs::path> seen;
  for (const std::string& path : paths) {
    check_output(path, extensions, session);
    if (!seen.insert(fs::absolute(path).lexically_normal()).second) throw InvalidInput(path + ": named twice");
  }
}

void would_write(const std::vector<std::string>& paths, std::int64_t num_frames, Session& session) {
  Value object;
  object["dry_run"] = true;
  if (num_frames >= 0) object["frames"] = num_frames;
  object["output"] = paths;
  std::string text;
  for (const std::string& path : paths) text += "would write " + path + "\n";
  session.result(object, text);
}

}  // namespace motex::cli
