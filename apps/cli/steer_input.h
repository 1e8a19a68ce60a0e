// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "motex/motion_texture/steering.h"

namespace motex::cli {

/// One line of the steering protocol (docs/formats.md), already checked.
struct SteerCommand {
  enum class Kind { kSteer, kTexton, kStop };
  Kind kind = Kind::kSteer;
  std::int64_t frame = -1;  ///< "@120 direction 90": not before this frame
  Steering steering;        ///< the whole wish, after this line
  int texton = 0;
};

/// Takes lines and keeps what they add up to.
class SteerParser {
 public:
  explicit SteerParser(const MotionTexture& model) : model_(model) {}
  /// False for an empty line or one that begins with #. Throws InvalidInput for what is no command.
  bool parse(const std::string& line, SteerCommand& command);

 private:
  const MotionTexture& model_;
  Steering steering_;
};

/// Lines from standard input, without blocking when none are there.
class LineInput {
 public:
  /// Waits up to that long for input, then takes what there is. A signal cuts the waiting short.
  void wait(double secs);
  bool next(std::string& line);
  static void sleep(double secs);
  bool at_end() const { return at_end_ && lines_.empty(); }

 private:
  void take(const char* bytes, std::size_t size);
  std::deque<std::string> lines_;
  std::string rest_;
  bool at_end_ = false;
};

}  // namespace motex::cli
