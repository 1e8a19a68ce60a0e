// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "output_folder.h"

#include <unistd.h>

#include <system_error>

#include "motex/core/error.h"

namespace motex::cli {
namespace fs = std::filesystem;

namespace {

fs::path without_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

}  // namespace

void check_output_folder(const std::string& path, const Session& session) {
  std::error_code ec;
  if (path.empty()) throw InvalidInput("-o: name a folder");
  if (fs::exists(path, ec) && !fs::is_directory(path, ec)) throw InvalidInput(path + ": is a file; name a folder");
  if (fs::is_directory(path, ec) && !fs::is_empty(path, ec) && !session.flags.force)
    throw InvalidInput(path + ": has something in it; --force replaces files of the same names");
  const fs::path parent = without_slash(path).parent_path();
  if (!parent.empty() && !fs::is_directory(parent, ec))
    throw InvalidInput(path + ": there is no folder " + parent.string() + " to put it in");
  if (::access(parent.empty() ? "." : parent.c_str(), W_OK) != 0)
    throw InvalidInput(path + ": cannot be made: the folder that it would be in is not writable");
}

OutputFolder::OutputFolder(const fs::path& path) : path_(without_slash(path)) {
  temporary_ = path_.string() + ".part" + std::to_string(::getpid());
  std::error_code ec;
  fs::create_directory(temporary_, ec);
  if (ec) throw InvalidInput(path_.string() + ": cannot be made: " + ec.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ec;
  if (!temporary_.empty()) fs::remove_all(temporary_, ec);
}

void OutputFolder::commit() {
  std::error_code ec;
  if (!fs::exists(path_, ec)) {
    fs::rename(temporary_, path_, ec);
    if (ec) throw WriteError(path_.string() + ": cannot be made: " + ec.message());
    temporary_.clear();
    return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(temporary_)) {
    fs::rename(entry.path(), path_ / entry.path().filename(), ec);
    if (ec) throw WriteError((path_ / entry.path().filename()).string() + ": cannot be replaced: " + ec.message());
  }
}

}  // namespace motex::cli
