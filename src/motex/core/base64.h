// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace motex {

/// Base64 of RFC 4648 with padding, as data URIs carry it.
std::string base64_encode(std::string_view bytes);

}  // namespace motex
