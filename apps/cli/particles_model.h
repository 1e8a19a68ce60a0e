// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "motex/particles/textured_motion.h"

namespace motex::cli {

/// load_textured_motion() that says what to do when a video was named in place of a model.
TexturedMotion load_particles_model(const std::string& path);

/// "320x240" or "320,240". Throws InvalidInput naming --size.
std::pair<int, int> parse_picture_size(const std::string& text);

/// Background + bases of the cables in that frame.
Planes reconstructed_frame(const TexturedMotion& model, std::int64_t frame);

}  // namespace motex::cli
