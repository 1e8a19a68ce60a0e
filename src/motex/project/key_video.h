// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "motex/project/backdrop.h"
#include "motex/project/keyed_footage.h"

namespace motex {

struct KeyVideoReport {
  KeyFootageReport footage;
  int width = 0, height = 0;
  bool had_alpha = false;  ///< the footage came with a matte, which was taken as it is
  std::optional<CleanPlate> plate;
};

/// Keys a video and writes it to every output: with alpha, or over the backdrop (may be null). Files whose matte
/// compression would smear are written with colours that go on for 8 pixels beyond the outline, alpha not
/// premultiplied. All outputs appear at the end, or none. Throws InvalidInput: nobody is in any frame; and what
/// KeyedFootage and VideoWriter throw.
KeyVideoReport key_video(const std::filesystem::path& video, const KeyFootageOptions& options, Backdrop* backdrop,
                         const std::vector<std::filesystem::path>& outputs, const JobContext& job = {});

/// The sprite in a transparent frame of that size, alpha not premultiplied; colours go on for 8 pixels beyond the
/// outline, where alpha is 0, so that a lossy codec does not mix the edge with black. image: memory used again.
void to_straight_image(const Sprite& sprite, int width, int height, Image& image);

}  // namespace motex
