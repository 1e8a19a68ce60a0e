// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion_texture/model.h"

namespace motex::cli {

/// The texton that a word names by number or by name, to be called when the model is loaded. argument: "--to", for
/// messages. Throws InvalidInput for one that does not exist (with the closest name) or was dropped or merged.
int texton_number(const MotionTexture& model, const std::string& argument, const std::string& word);
/// The same for several words.
std::vector<int> texton_numbers(const MotionTexture& model, const std::string& argument,
                                const std::vector<std::string>& words);

}  // namespace motex::cli
