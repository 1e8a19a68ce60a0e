// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/picture_files.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "motex/core/error.h"
#include "motex/core/extension.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_picture(const fs::path& path) {
  const std::string extension = extension_of(path);
  constexpr std::array kKnown{".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp", ".pgm", ".ppm"};
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

/// A "%d" or "%04d" of the pattern: where it stands and how long it is; {npos, 0} when there is none.
std::pair<std::size_t, std::size_t> find_number_mark(const std::string& pattern) {
  for (std::size_t at = pattern.find('%'); at != std::string::npos; at = pattern.find('%', at + 1)) {
    std::size_t end = at + 1;
    while (end < pattern.size() && is_digit(pattern[end])) ++end;
    if (end < pattern.size() && pattern[end] == 'd') return {at, end + 1 - at};
  }
  return {std::string::npos, 0};
}

/// Whether the name fits a pattern in which '*' is any text.
bool fits(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] != '*') return !name.empty() && name[0] == pattern[0] && fits(name.substr(1), pattern.substr(1));
  const std::size_t literal = pattern.find_first_not_of('*');
  if (literal == std::string_view::npos) return true;
  for (std::size_t skip = 0; skip <= name.size(); ++skip)
    if (fits(name.substr(skip), pattern.substr(literal))) return true;
  return false;
}

bool fits_number(const std::string& name, const std::string& pattern) {
  const auto [at, length] = find_number_mark(pattern);
  const std::string head = pattern.substr(0, at), tail = pattern.substr(at + length);
  if (name.size() <= head.size() + tail.size() || name.compare(0, head.size(), head) != 0 ||
      name.compare(name.size() - tail.size(), tail.size(), tail) != 0)
    return false;
  return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(head.size()),
                     name.end() - static_cast<std::ptrdiff_t>(tail.size()), is_digit);
}

/// The last number in the name, or −1.
std::int64_t number_of(const fs::path& path) {
  const std::string stem = path.stem().string();
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  std::size_t start = end;
  while (start > 0 && is_digit(stem[start - 1]) && end - start < 18) --start;
  return start == end ? -1 : std::stoll(stem.substr(start, end - start));
}

void warn_of_gaps(const std::string& name, const std::vector<fs::path>& pictures, const JobContext& job) {
  std::int64_t num_missing = 0, first_missing = -1;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    const std::int64_t before = number_of(pictures[i - 1]), after = number_of(pictures[i]);
    if (before < 0 || after <= before + 1) continue;
    if (num_missing == 0) first_missing = before + 1;
    num_missing += after - before - 1;
  }
  if (num_missing > 0)
    job.warn(name + ": " + std::to_string(num_missing) + " numbers are missing (the first is " +
             std::to_string(first_missing) + "); the pictures are taken as following one another");
}

}  // namespace

bool is_picture_sequence(const fs::path& path) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) return true;
  if (fs::exists(path, ec)) return false;
  const std::string name = path.filename().string();
  return name.find('*') != std::string::npos || find_number_mark(name).second > 0;
}

std::vector<fs::path> list_pictures(const fs::path& path, const JobContext& job) {
  std::error_code ec;
  const bool is_folder = fs::is_directory(path, ec);
  const fs::path folder = is_folder ? path : path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string pattern = path.filename().string();
  const bool numbered = !is_folder && find_number_mark(pattern).second > 0;
  std::vector<fs::path> pictures;
  fs::directory_iterator entries(folder, ec);
  if (ec) throw InvalidInput(folder.string() + ": cannot be read: " + ec.message());
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file(ec) || name[0] == '.') continue;
    if (is_folder ? is_picture(entry.path()) : numbered ? fits_number(name, pattern) : fits(name, pattern))
      pictures.push_back(entry.path());
  }
  if (pictures.empty())
    throw InvalidInput(path.string() +
                       (is_folder ? ": has no pictures (.png, .jpg, .tif, …) in it" : ": no file fits"));
  std::sort(pictures.begin(), pictures.end(), [](const fs::path& a, const fs::path& b) {
    const std::int64_t x = number_of(a), y = number_of(b);
    return x != y ? x < y : a < b;
  });
  warn_of_gaps(path.string(), pictures, job);
  return pictures;
}

}  // namespace motex
