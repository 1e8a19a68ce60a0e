// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "motex/core/error.h"

namespace motex {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path, std::uint64_t max_bytes) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) throw InvalidInput(path.string() + ": is a folder, not a file");
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) throw InvalidInput(path.string() + ": cannot be read: " + std::strerror(errno));
  std::string bytes;
  const auto size = fs::file_size(path, ec);
  if (!ec && size <= max_bytes) bytes.reserve(size);
  char buffer[1 << 16];
  std::size_t got = 0;
  while ((got = std::fread(buffer, 1, sizeof buffer, file)) > 0) {
    bytes.append(buffer, got);
    if (bytes.size() > max_bytes) break;
  }
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) throw InvalidInput(path.string() + ": reading failed");
  if (bytes.size() > max_bytes)
    throw InvalidInput(path.string() + ": larger than " + std::to_string(max_bytes >> 20) +
                       " MiB, the most that is read");
  return bytes;
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  std::error_code ec;
  const auto status = fs::status(path_, ec);
  if (fs::is_directory(status)) throw InvalidInput(path_.string() + ": is a folder; name a file");
  // A link is followed, so that it stays a link and its target is replaced.
  if (fs::is_symlink(fs::symlink_status(path_, ec)) && fs::is_regular_file(status)) path_ = fs::canonical(path_, ec);
  const bool direct = fs::exists(status) && !fs::is_regular_file(status);
  if (!direct) temporary_ = path_.string() + ".part" + std::to_string(::getpid());
  file_ = std::fopen((direct ? path_ : temporary_).c_str(), "wb");
  if (file_ == nullptr) {
    const int reason = errno;
    const std::string message = path_.string() + ": cannot be written: " + std::strerror(reason);
    if (reason == ENOSPC || reason == EIO) throw WriteError(message);
    throw InvalidInput(message);
  }
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) {
    std::error_code ec;
    fs::remove(temporary_, ec);
  }
}

void AtomicFile::fail(const char* doing) {
  throw WriteError(path_.string() + ": " + doing + " failed: " + std::strerror(errno) + "; nothing was changed");
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("writing");
}

bool AtomicFile::seek(std::uint64_t position) {
  return !temporary_.empty() && std::fseek(file_, static_cast<long>(position), SEEK_SET) == 0;
}

void AtomicFile::commit() {
  if (std::fflush(file_) != 0) fail("writing");
  if (!temporary_.empty() && ::fsync(::fileno(file_)) != 0) fail("writing");
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!closed) fail("writing");
  if (temporary_.empty()) return;
  std::error_code ec;
  fs::rename(temporary_, path_, ec);
  if (ec) throw WriteError(path_.string() + ": cannot be replaced: " + ec.message());
  temporary_.clear();
}

void write_file(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace motex
