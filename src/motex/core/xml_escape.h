// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace motex {

/// Text as it may stand between the tags and the quotes of XML and HTML. Characters that XML forbids become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace motex
