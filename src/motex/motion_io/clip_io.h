// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "motex/motion_io/read_options.h"

namespace motex {

/// With dot, in lower case: ".bvh", ".amc", ".glb", ".gltf" and, where the build has Assimp, ".fbx".
const std::vector<std::string>& readable_clip_extensions();
/// ".bvh", ".glb", ".csv", ".npz".
const std::vector<std::string>& writable_clip_extensions();

/// Reads any readable file by what it holds, which may differ from its extension (said as a warning), and applies the
/// options. Clip::name is the file name without folder and extension. Throws InvalidInput, ParseError with the place,
/// UnsupportedFile naming what is read.
Clip read_clip(const std::filesystem::path& path, const ReadClipOptions& options = {}, const JobContext& job = {});
/// name: the file name, for messages and as a hint of the format. An AMC needs options.asf.
Clip read_clip_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                     const JobContext& job = {});

/// Throws UnsupportedFile unless write_clip knows the extension: to be called before long work.
void check_clip_extension(const std::filesystem::path& path);
/// Format by extension; the file appears whole or not at all. Throws UnsupportedFile, InvalidInput, WriteError.
void write_clip(const std::filesystem::path& path, const Clip& clip, const JobContext& job = {});

}  // namespace motex
