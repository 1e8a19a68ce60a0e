// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "motex/image/image.h"

namespace motex {

/// PNG file, 8 bits a channel: grey when every pixel is grey and opaque, RGB when every one is opaque, RGBA otherwise.
/// Throws InvalidInput for an empty image.
std::string encode_png(const Image& image);

/// Reads 8-bit grey, RGB and RGBA PNG files without interlacing; others throw UnsupportedFile, broken ones ParseError
/// with the byte. name: file name for messages.
Image decode_png(std::string_view bytes, const std::string& name);

}  // namespace motex
