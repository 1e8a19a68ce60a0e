// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/input_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "motex/core/error.h"
#include "motex/core/lowered.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

class InputFile : public InputBytes {
 public:
  explicit InputFile(const fs::path& path) : path_(path), file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    if (file_ == nullptr) throw InvalidInput(path.string() + ": cannot be read: " + std::strerror(errno));
    std::error_code ec;
    if (fs::is_regular_file(path, ec)) size_ = static_cast<std::int64_t>(fs::file_size(path, ec));
  }
  std::int64_t read(char* target, std::int64_t num_bytes) override {
    const std::size_t got = std::fread(target, 1, static_cast<std::size_t>(num_bytes), file_.get());
    position_ += static_cast<std::int64_t>(got);
    return got == 0 && std::ferror(file_.get()) != 0 ? -1 : static_cast<std::int64_t>(got);
  }
  bool seek(std::int64_t position) override {
    if (size_ < 0 || position < 0 || std::fseek(file_.get(), static_cast<long>(position), SEEK_SET) != 0) return false;
    position_ = position;
    return true;
  }
  std::int64_t position() const override { return position_; }
  std::int64_t size() const override { return size_; }
  std::unique_ptr<InputBytes> again() const override {
    return size_ < 0 ? nullptr : std::make_unique<InputFile>(path_);
  }

 private:
  fs::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::int64_t position_ = 0, size_ = -1;
};

class InputMemory : public InputBytes {
 public:
  explicit InputMemory(std::string_view bytes) : bytes_(bytes) {}
  std::int64_t read(char* target, std::int64_t num_bytes) override {
    const std::int64_t got = std::min(num_bytes, size() - position_);
    std::copy_n(bytes_.data() + position_, got, target);
    position_ += got;
    return got;
  }
  bool seek(std::int64_t position) override {
    if (position < 0 || position > size()) return false;
    position_ = position;
    return true;
  }
  std::int64_t position() const override { return position_; }
  std::int64_t size() const override { return static_cast<std::int64_t>(bytes_.size()); }
  std::unique_ptr<InputBytes> again() const override { return std::make_unique<InputMemory>(bytes_); }

 private:
  std::string_view bytes_;
  std::int64_t position_ = 0;
};

bool is_text(const std::string& head) {
  return std::all_of(head.begin(), head.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 32 || byte == '\n' || byte == '\r' || byte == '\t';
  });
}

}  // namespace

std::unique_ptr<InputBytes> open_input(const fs::path& path) { return std::make_unique<InputFile>(path); }
std::unique_ptr<InputBytes> open_input(std::string_view bytes) { return std::make_unique<InputMemory>(bytes); }

std::string peek(InputBytes& input, std::size_t num_bytes) {
  if (input.size() < 0) return "";
  const std::int64_t before = input.position();
  std::string head(num_bytes, '\0');
  std::size_t filled = 0;
  while (filled < num_bytes) {
    const std::int64_t got = input.read(head.data() + filled, static_cast<std::int64_t>(num_bytes - filled));
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  head.resize(filled);
  input.seek(before);
  return head;
}

void refuse_text(InputBytes& input, const std::string& name) {
  if (input.size() < 0) return;
  const std::string head = peek(input, 512);
  if (head.empty()) throw UnsupportedFile(name + ": is empty (0 bytes)");
  if (head.rfind("version https://git-lfs.github.com/spec", 0) == 0)
    throw UnsupportedFile(name + ": is a Git-LFS pointer, not the video itself: run git lfs pull");
  const bool is_netpbm = head.size() > 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '7' && head[2] <= ' ';
  if (head.rfind("YUV4MPEG2", 0) == 0 || is_netpbm || !is_text(head)) return;
  if (lowered(head).find("<html") != std::string::npos || lowered(head).find("<!doctype html") != std::string::npos)
    throw UnsupportedFile(name + ": is a web page, not a video: download the video itself");
  throw UnsupportedFile(name + ": is a text file, not a video");
}

}  // namespace motex
