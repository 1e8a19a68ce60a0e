// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "session.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "interrupt.h"
#include "warnings.h"

namespace motex::cli {
namespace {

const auto kStart = std::chrono::steady_clock::now();

double secs_since_start() { return std::chrono::duration<double>(std::chrono::steady_clock::now() - kStart).count(); }

bool stderr_is_terminal() {
  static const bool is_terminal = ::isatty(STDERR_FILENO) != 0;
  return is_terminal;
}

void print_marked(const char* mark, const char* colour, std::string_view text) {
  static const bool coloured = stderr_is_terminal() && std::getenv("NO_COLOR") == nullptr;
  std::string line = coloured ? std::string("\x1b[1;") + colour + "m" + mark + "\x1b[0m: " : std::string(mark) + ": ";
  line.append(text).append("\n");
  std::fputs(line.c_str(), stderr);
}

std::string duration_text(double secs) {
  const int whole = static_cast<int>(secs + 0.5);
  if (whole < 90) return std::to_string(whole) + " s";
  return std::to_string((whole + 30) / 60) + " min";
}

}  // namespace

double Session::secs() { return secs_since_start(); }

JobContext Session::job(double from, double to) {
  JobContext job;
  job.cancel = &interrupted();
  job.jobs = flags.jobs;
  job.on_warning = [this](const std::string& message) { warn(message); };
  if (stderr_is_terminal() && !flags.quiet)
    job.on_progress = [this, from, to](std::string_view stage, double fraction) {
      show_progress(stage, from + (to - from) * fraction);
    };
  return job;
}

void Session::show_progress(std::string_view stage, double fraction) {
  const double now = secs_since_start();
  if (now < 0.3 || now - last_shown_secs_ < 0.1) return;
  last_shown_secs_ = now;
  std::string line = std::string(stage) + " " + std::to_string(static_cast<int>(100 * fraction)) + " %";
  if (now > 1 && fraction > 0.02) line += ", " + duration_text(now * (1 - fraction) / fraction) + " left";
  const std::size_t width = line.size();
  if (width < progress_width_) line.append(progress_width_ - width, ' ');
  progress_width_ = width;
  std::fprintf(stderr, "\r%s", line.c_str());
  std::fflush(stderr);
}

void Session::clear_progress() {
  if (progress_width_ == 0) return;
  std::fprintf(stderr, "\r%*s\r", static_cast<int>(progress_width_), "");
  progress_width_ = 0;
}

void Session::say(const std::string& message) {
  if (flags.quiet) return;
  clear_progress();
  std::fprintf(stderr, "%s\n", message.c_str());
  ++num_said_;
}

void Session::result(Value object, const std::string& text) {
  object_ = std::move(object);
  text_ = text;
}

void Session::finish() {
  clear_progress();
  if (!flags.quiet)
    for (const std::string& line : fold_warnings(warnings_, 8)) print_marked("warning", "33", line);
  if (flags.json) {
    object_["warnings"] = Value(warnings_);
    text_ = to_json(object_) + "\n";
  }
  std::fwrite(text_.data(), 1, text_.size(), stdout);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw WriteError("standard output does not take the result; is the disk full?");
}

void Session::fail(std::string_view error) {
  clear_progress();
  if (!flags.quiet && num_said_ <= 1)  // a failure takes three lines at most
    for (const std::string& line : fold_warnings(warnings_, 1)) print_marked("warning", "33", line);
  warnings_.clear();
  print_marked("error", "31", on_one_line(std::string(error)));
}

}  // namespace motex::cli
