// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "motex/motion_texture/model.h"

namespace motex {

/// A motion texture as one file (docs/formats.md); bytes depend on the model alone.
std::string write_model_bytes(const MotionTexture& model);
void save_model(const std::filesystem::path& path, const MotionTexture& model);

/// Safe to use on files from strangers. Throws InvalidInput, ParseError, UnsupportedFile.
MotionTexture read_model_bytes(std::string bytes, const std::string& name);
MotionTexture load_model(const std::filesystem::path& path);

}  // namespace motex
