// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/error.h"

namespace motex {

ParseError::ParseError(const std::string& file, Unit unit, std::int64_t position, const std::string& message)
    : InvalidInput(unit == Unit::kLine ? file + ":" + std::to_string(position) + ": " + message
                                       : file + ": byte " + std::to_string(position) + ": " + message),
      unit_(unit),
      position_(position) {}

}  // namespace motex
