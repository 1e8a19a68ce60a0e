// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/archive.h"
#include "motex/motion_texture/model.h"

/// Arrays of a model file that need not be there (docs/formats.md). A new one is one row of the table in
/// model_chunks.cpp and needs no new version: readers take its absence for the field's default, and skip arrays that
/// they do not know.
namespace motex {

/// 1 when the model has none of them, so that old programs read it; else 2.
std::uint32_t model_version(const MotionTexture& model);
void write_chunks(ArchiveWriter& out, const MotionTexture& model);
/// To be called when the rest of the model is read. Throws InvalidInput.
void read_chunks(const ArchiveReader& in, MotionTexture& model);

}  // namespace motex
