// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace motex {

/// Words, lines and numbers of a text file from anywhere: LF, CRLF or CR line ends, a byte order mark, decimal commas.
/// Counts lines from 1 for messages.
class TextScanner {
 public:
  /// text must outlive the scanner. file: for messages. Throws ParseError for UTF-16 text.
  TextScanner(std::string_view text, std::string file);

  /// Skips white space; true when nothing is left.
  bool at_end();
  /// Next word; '{' and '}' are words of their own; empty at the end of the text.
  std::string_view word();
  /// What is left of the current line up to '{', without white space around it. The line end stays.
  std::string_view rest_of_line();
  /// Next line that is not blank, without white space around it; empty at the end of the text.
  std::string_view next_line();
  /// Next number, finite and at most 1e12 in size; `what` names it in the ParseError that is thrown otherwise.
  double number(std::string_view what);
  /// The same, false and nothing read when a plain number does not come next.
  bool plain_number(double& value);
  /// The text of a number as `number` reads it; where it stands is the current line.
  double parse_number(std::string_view text, std::string_view what);

  /// Line of the next unread character.
  std::int64_t line() const { return line_; }
  bool saw_decimal_comma() const { return saw_decimal_comma_; }
  const std::string& file() const { return file_; }
  /// Fails when a clip of that size takes more memory than a text of this length can mean (joints without channels cost
  /// memory in every frame and no text).
  void check_clip_size(double num_frames, double num_joints) const;
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(std::int64_t line, const std::string& message) const;

 private:
  void skip_space();
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  bool saw_decimal_comma_ = false;
};

/// The words of a line.
std::vector<std::string_view> split_words(std::string_view line);
/// Equal when ASCII case is ignored.
bool same_word(std::string_view a, std::string_view b);
/// For messages: in quotes, unprintable bytes as '?', at most 40 characters.
std::string in_quotes(std::string_view text);
/// File name without folder and extension.
std::string clip_name(std::string_view file);

}  // namespace motex
