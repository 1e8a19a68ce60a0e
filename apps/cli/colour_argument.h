// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "motex/image/image.h"

namespace motex::cli {

/// "#rrggbb" or black, white, gray, grey, green, blue (the usual screens); nothing for another text.
std::optional<Rgba> colour_of(const std::string& text);

}  // namespace motex::cli
