// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"
#include "value.h"

namespace motex::cli {

/// Flags that every command has.
struct CommonFlags {
  bool json = false;
  bool quiet = false;
  bool force = false;
  bool dry_run = false;
  int jobs = 0;
};

/// A running command's way to the terminal: data on stdout once the command has succeeded, messages and progress on
/// stderr, warnings kept until the end.
class Session {
 public:
  CommonFlags flags;

  /// Progress of the job fills the share from … to of the whole command.
  JobContext job(double from = 0, double to = 1);
  /// A message for a person, one line.
  void say(const std::string& message);
  void warn(const std::string& message) { warnings_.push_back(message); }
  /// The command's outcome: the object for --json (its warnings are added), else the text.
  void result(Value object, const std::string& text);

  /// Since the program started.
  static double secs();

  /// Prints warnings, then the result. Throws WriteError when stdout does not take it.
  void finish();
  /// Prints one line of warnings, if there are any and room is left, and the error.
  void fail(std::string_view error);

 private:
  void show_progress(std::string_view stage, double fraction);
  void clear_progress();
  std::vector<std::string> warnings_;
  Value object_;
  std::string text_;
  int num_said_ = 0;
  std::size_t progress_width_ = 0;
  double last_shown_secs_ = -1;
};

}  // namespace motex::cli
