// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "motex/core/error.h"
#include "motex/core/trimmed.h"

namespace motex {
namespace {

constexpr double kLargestNumber = 1e12;
constexpr double kBaseBytes = 256e6, kBytesPerByte = 64;

constexpr std::string_view kSpace = " \t\n\v\f\r";

bool is_space(char c) { return kSpace.find(c) != kSpace.npos; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_brace(char c) { return c == '{' || c == '}'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Numbers too small for a double are zero.
bool underflows(std::string_view text) { return text.find("e-") != text.npos || text.find("E-") != text.npos; }

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
  if (text_.substr(0, 2) == "\xFF\xFE" || text_.substr(0, 2) == "\xFE\xFF")
    fail("the text is UTF-16; save it as UTF-8 or ASCII");
}

void TextScanner::fail_at(std::int64_t line, const std::string& message) const {
  throw ParseError(file_, ParseError::Unit::kLine, line, message);
}

void TextScanner::check_clip_size(double num_frames, double num_joints) const {
  const double needed = num_frames * num_joints * 7 * sizeof(double);
  if (needed > kBaseBytes + kBytesPerByte * static_cast<double>(text_.size()))
    fail("the file asks for " + std::to_string(static_cast<std::int64_t>(needed / 1e6)) +
         " MB by joints that have no channels; it cannot be meant so");
}

void TextScanner::skip_space() {
  for (; at_ < text_.size() && is_space(text_[at_]); ++at_) {
    const bool inside_crlf = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
    if (is_line_end(text_[at_]) && !inside_crlf) ++line_;
  }
}

bool TextScanner::at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view TextScanner::word() {
  skip_space();
  const std::size_t start = at_;
  if (at_ < text_.size() && is_brace(text_[at_])) return text_.substr(at_++, 1);
  while (at_ < text_.size() && !is_space(text_[at_]) && !is_brace(text_[at_])) ++at_;
  return text_.substr(start, at_ - start);
}

std::string_view TextScanner::rest_of_line() {
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_line_end(text_[at_]) && text_[at_] != '{') ++at_;
  return trimmed(text_.substr(start, at_ - start), kSpace);
}

std::string_view TextScanner::next_line() {
  skip_space();
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
  return trimmed(text_.substr(start, at_ - start), kSpace);
}

bool TextScanner::plain_number(double& value) {
  skip_space();
  const char* begin = text_.data() + at_;
  const char* const end = text_.data() + text_.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  const bool whole = stop == end || is_space(*stop) || is_brace(*stop);
  if (error != std::errc() || !whole || !(std::abs(value) <= kLargestNumber)) return false;
  at_ += static_cast<std::size_t>(stop - begin);
  return true;
}

double TextScanner::number(std::string_view what) {
  double value = 0;
  if (plain_number(value)) return value;
  if (at_end()) fail("the file ends where " + std::string(what) + " should stand");
  return parse_number(word(), what);
}

double TextScanner::parse_number(std::string_view text, std::string_view what) {
  std::string plain(text.substr(text.size() > 1 && text.front() == '+' ? 1 : 0));
  const bool comma = std::count(plain.begin(), plain.end(), ',') == 1 && plain.find('.') == plain.npos;
  if (comma) std::replace(plain.begin(), plain.end(), ',', '.');
  double value = 0;
  const auto [stop, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error == std::errc::result_out_of_range && underflows(plain)) return 0;
  if (error == std::errc::invalid_argument || stop != plain.data() + plain.size())
    fail(in_quotes(text) + " stands where " + std::string(what) + " should be");
  if (error != std::errc() || !std::isfinite(value)) fail(in_quotes(text) + " is not a finite number");
  if (std::abs(value) > kLargestNumber) fail(in_quotes(text) + " is too large to be meant");
  saw_decimal_comma_ = saw_decimal_comma_ || comma;
  return value;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t start = i;
    while (i < line.size() && !is_space(line[i])) ++i;
    if (i > start) words.push_back(line.substr(start, i - start));
    while (i < line.size() && is_space(line[i])) ++i;
  }
  return words;
}

bool same_word(std::string_view a, std::string_view b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > 40 ? "…'" : "'");
}

std::string clip_name(std::string_view file) { return std::filesystem::path(file).stem().string(); }

}  // namespace motex
