// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "motex/motion_texture/model.h"

namespace motex {

/// A motion texture as one file (docs/formats.md): the model as learned, and its edits; bytes depend on these alone.
/// Throws InvalidInput for a model with edits applied.
std::string motion_texture_bytes(const MotionTexture& model);
void save_motion_texture(const std::filesystem::path& path, const MotionTexture& model);

/// Safe to use on files from strangers. As learned, its edits beside it. Throws InvalidInput, ParseError,
/// UnsupportedFile.
MotionTexture parse_motion_texture(std::string bytes, const std::string& name);
/// As learned: to make further edits, to write it again.
MotionTexture load_learned_motion_texture(const std::filesystem::path& path);
/// With its edits applied: to dance, plan and recognise.
MotionTexture load_motion_texture(const std::filesystem::path& path);

}  // namespace motex
