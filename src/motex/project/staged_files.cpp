// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/staged_files.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "motex/core/error.h"

namespace motex {
namespace fs = std::filesystem;

namespace {

/// A new one; others may be at work beside us.
fs::path make_folder(const fs::path& parent, const fs::path& target) {
  constexpr int kMostTries = 10000;
  std::error_code ec;
  for (int k = 0; k < kMostTries; ++k) {
    const fs::path folder = parent / (".motex-part" + std::to_string(k));
    if (fs::create_directory(folder, ec)) return folder;
    if (ec) break;
  }
  throw InvalidInput(target.string() + ": cannot be written there: " + (ec ? ec.message() : "too many .motex-part*"));
}

}  // namespace

StagedFiles::~StagedFiles() {
  std::error_code ec;
  for (const fs::path& folder : folders_) fs::remove_all(folder, ec);
}

fs::path StagedFiles::stage(const fs::path& target) {
  std::error_code ec;
  const fs::file_status status = fs::status(target, ec);
  if (fs::exists(status) && !fs::is_regular_file(status)) return target;
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const auto known = std::find_if(folders_.begin(), folders_.end(),
                                  [&parent](const fs::path& folder) { return folder.parent_path() == parent; });
  const fs::path folder = known != folders_.end() ? *known : make_folder(parent, target);
  if (known == folders_.end()) folders_.push_back(folder);
  files_.emplace_back(folder / target.filename(), target);
  return files_.back().first;
}

JobContext StagedFiles::naming_targets(const JobContext& job) const {
  JobContext out = job;
  if (!job.on_warning) return out;
  out.on_warning = [warn = job.on_warning, files = files_](const std::string& message) {
    std::string text = message;
    for (const auto& [staged, target] : files)
      if (const std::size_t at = text.find(staged.string()); at != std::string::npos)
        text.replace(at, staged.string().size(), target.string());
    warn(text);
  };
  return out;
}

void StagedFiles::commit() {
  std::error_code ec;
  for (const auto& [staged, target] : files_) {
    fs::rename(staged, target, ec);
    if (ec) throw WriteError(target.string() + ": cannot be replaced: " + ec.message());
  }
  files_.clear();
}

}  // namespace motex
