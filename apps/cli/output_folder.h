// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "session.h"

namespace motex::cli {

/// To be called before long work: throws InvalidInput when the path is a file, a folder with something in it and
/// --force was not given, or its parent is missing.
void check_output_folder(const std::string& path, const Session& session);

/// A folder of results that appears when it is complete: made beside the target, its files moved there by commit().
/// Destroyed without it, nothing is left.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write a file of that name until commit().
  std::filesystem::path file(const std::string& name) const { return temporary_ / name; }
  /// Files of the same names are replaced, others stay. Throws WriteError.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
};

}  // namespace motex::cli
