// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/load_clips.h"

#include <algorithm>
#include <exception>
#include <string>

#include "motex/core/extension.h"
#include "motex/core/parallel.h"
#include "motex/motion/unify.h"
#include "motex/motion_io/clip_io.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

bool has_readable_extension(const fs::path& path) {
  const std::string extension = extension_of(path);
  const auto& known = readable_clip_extensions();
  return std::find(known.begin(), known.end(), extension) != known.end();
}

std::vector<fs::path> clips_in_folder(const fs::path& folder) {
  std::vector<fs::path> found;
  try {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file() && has_readable_extension(entry.path())) found.push_back(entry.path());
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput(folder.string() + ": cannot be read: " + error.code().message());
  }
  if (found.empty()) throw InvalidInput(folder.string() + ": no clip in this folder that motex reads");
  std::sort(found.begin(), found.end());
  return found;
}

/// One file's outcome, kept so that warnings and errors come in the order of the files.
struct Reading {
  Clip clip;
  std::vector<std::string> warnings;
  std::exception_ptr error;
};

void read_one(const fs::path& file, const ReadClipOptions& options, const JobContext& job, Reading& reading) {
  JobContext quiet;
  quiet.cancel = job.cancel;
  quiet.on_warning = [&reading](const std::string& message) { reading.warnings.push_back(message); };
  try {
    quiet.check_cancelled();
    reading.clip = read_clip(file, options, quiet);
  } catch (...) {
    reading.error = std::current_exception();
  }
}

}  // namespace

std::vector<fs::path> find_clip_files(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code ec;
    if (!fs::is_directory(path, ec)) {
      files.push_back(path);
      continue;
    }
    const auto found = clips_in_folder(path);
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::vector<Clip> load_clips(const std::vector<fs::path>& paths, const ReadClipOptions& options,
                             const JobContext& job) {
  const std::vector<fs::path> files = find_clip_files(paths);
  if (files.empty()) throw InvalidInput("no clip was named");
  job.progress("reading clips", 0);
  std::vector<Reading> readings(files.size());
  parallel_for(job.jobs, static_cast<int>(files.size()), [&](int i) {
    const auto idx = static_cast<std::size_t>(i);
    read_one(files[idx], options, job, readings[idx]);
  });
  std::vector<Clip> clips;
  for (Reading& reading : readings) {
    for (const std::string& warning : reading.warnings) job.warn(warning);
    if (reading.error) std::rethrow_exception(reading.error);
    clips.push_back(std::move(reading.clip));
  }
  unify_clips(clips, job);
  job.progress("reading clips", 1);
  return clips;
}

}  // namespace motex
