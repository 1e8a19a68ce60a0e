// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "motex/core/job.h"

namespace motex {

/// Files that appear together: each is written under a name of its own in a folder beside its place, and commit() puts
/// all there. Destroyed without it, nothing is left and old files are untouched.
class StagedFiles {
 public:
  StagedFiles() = default;
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Where to write the file meanwhile: the same name and extension. A device is its own place. Throws InvalidInput
  /// when its folder cannot be written to.
  std::filesystem::path stage(const std::filesystem::path& target);
  /// The job, but that its warnings name the targets of what is staged by now, not where the files are meanwhile.
  JobContext naming_targets(const JobContext& job) const;
  /// Replaces old files. Throws WriteError; then what could not be put is missing.
  void commit();

 private:
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> files_;  // staged, target
  std::vector<std::filesystem::path> folders_;
};

}  // namespace motex
