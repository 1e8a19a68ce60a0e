// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "motex/project/load_people.h"
#include "session.h"
#include "value.h"

namespace motex::cli {

/// VIDEO|MODEL of a command and how a video is keyed.
struct PeopleSourceArguments {
  std::string path, plate_picture, garbage_mask;
  bool one_shot = false;
  PeopleFootageOptions options;

  void declare(Arguments& arguments);
  /// After the command's own arguments.
  void declare_keying(Arguments& arguments);
  /// Throws InvalidInput before long work: missing, options outside their ranges.
  void check() const;
  LoadedPeople load(const JobContext& job) const;
};

/// source, source_start, person, mirrored, start, length of each.
Value takes_value(const PeopleTexture& texture);
/// start, length of each.
Value spans_value(const std::vector<FrameSpan>& spans);

}  // namespace motex::cli
