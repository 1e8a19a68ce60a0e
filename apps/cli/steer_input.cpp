// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "steer_input.h"

#include <sys/poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "arguments.h"
#include "motex/core/error.h"
#include "texton_argument.h"

namespace motex::cli {
namespace {

constexpr std::size_t kLongestLine = 4096;

std::optional<double> number_or_free(const std::string& command, const std::string& value, double factor) {
  if (value == "free") return std::nullopt;
  double number = 0;
  parse_value(command, value, number);
  if (!(std::abs(number) <= 1e6)) throw InvalidInput(command + ": " + value + " is out of range");
  return number * factor;
}

int milliseconds(double secs) { return static_cast<int>(std::ceil(std::clamp(secs, 0.0, 1.0) * 1000)); }

}  // namespace

bool SteerParser::parse(const std::string& line, SteerCommand& command) {
  constexpr double kRadians = std::numbers::pi / 180;
  command = {};
  std::istringstream words(line);
  std::string verb, value;
  words >> verb;
  if (verb.empty() || verb[0] == '#') return false;
  if (verb[0] == '@') {
    parse_value("@FRAME", verb.substr(1), command.frame);
    words >> verb;
  }
  std::getline(words >> std::ws, value);
  while (!value.empty() && (value.back() == ' ' || value.back() == '\r')) value.pop_back();
  if (!verb.empty() && verb.back() == '\r') verb.pop_back();
  if (verb == "stop") {
    command.kind = SteerCommand::Kind::kStop;
  } else if (verb == "texton") {
    command.kind = SteerCommand::Kind::kTexton;
    command.texton = texton_number(model_, "texton", value);
  } else {
    Steering now = steering_;
    if (verb == "direction")
      now.direction = number_or_free(verb, value, kRadians);
    else if (verb == "facing")
      now.facing = number_or_free(verb, value, kRadians);
    else if (verb == "speed")
      now.speed = number_or_free(verb, value, 1);
    else if (verb == "pace")
      now.pace = number_or_free(verb, value, 1).value_or(1);
    else if (verb == "free")
      now = {};
    else
      throw InvalidInput("'" + verb + "' is no steering command: direction, facing, speed, pace, texton, free, stop");
    if (now.speed && *now.speed < 0) throw InvalidInput("speed: " + value + " is negative");
    if (!(now.pace >= 0.8 && now.pace <= 1.25)) throw InvalidInput("pace: " + value + " is outside 0.8 … 1.25");
    command.steering = steering_ = now;
  }
  return true;
}

void LineInput::take(const char* bytes, std::size_t size) {
  rest_.append(bytes, size);
  for (std::size_t end = rest_.find('\n'); end != rest_.npos; end = rest_.find('\n')) {
    lines_.push_back(rest_.substr(0, end));
    rest_.erase(0, end + 1);
  }
  if (rest_.size() > kLongestLine) throw InvalidInput("a steering command is longer than 4096 bytes");
}

void LineInput::sleep(double secs) {
  if (secs > 0) ::poll(nullptr, 0, milliseconds(secs));
}

void LineInput::wait(double secs) {
  if (at_end_) return sleep(secs);
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::poll(&input, 1, milliseconds(secs)) <= 0) return;
  char bytes[kLongestLine];
  const ssize_t size = ::read(STDIN_FILENO, bytes, sizeof bytes);
  if (size > 0) {
    take(bytes, static_cast<std::size_t>(size));
  } else if (size == 0 || errno != EINTR) {
    at_end_ = true;
    if (!rest_.empty()) lines_.push_back(std::exchange(rest_, {}));
  }
}

bool LineInput::next(std::string& line) {
  if (lines_.empty()) return false;
  line = std::move(lines_.front());
  lines_.pop_front();
  return true;
}

}  // namespace motex::cli
