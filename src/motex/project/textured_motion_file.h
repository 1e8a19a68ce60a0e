// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "motex/particles/textured_motion.h"

namespace motex {

/// A textured motion as one file (docs/formats.md, archive kind "textured_motion"). The background is kept in 8 bits,
/// bases in single precision; a model that was read gives the same bytes again.
std::string textured_motion_bytes(const TexturedMotion& model);
void save_textured_motion(const std::filesystem::path& path, const TexturedMotion& model);

/// Safe to use on files from strangers. Throws InvalidInput, ParseError, UnsupportedFile.
TexturedMotion parse_textured_motion(std::string bytes, const std::string& name);
TexturedMotion load_textured_motion(const std::filesystem::path& path);

}  // namespace motex
