// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/archive.h"
#include "motex/particles/textured_motion.h"

/// Part of textured_motion_file.cpp: arrays that only models of water have.
namespace motex {

/// Nothing, for a model that is not one of water.
void write_water(ArchiveWriter& out, const TexturedMotion& model);
/// The description of the clip must have been read.
void read_water(const ArchiveReader& in, TexturedMotion& model);

}  // namespace motex
