// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "motex/project/backdrop.h"
#include "session.h"

namespace motex::cli {

/// -o of commands that write a film of cut-out people: files with alpha, or what stands before a background.
void declare_film_output(Arguments& arguments, std::vector<std::string>& outputs);

/// Before long work: throws InvalidInput when one cannot be written, is named twice, exists without --force, or keeps
/// no alpha while there is no background.
void check_film_output(const std::vector<std::string>& outputs, const std::string& background, const Session& session);

/// A colour (#rrggbb or a word), a picture or a video behind a film of that size; nothing for an empty word.
std::optional<Backdrop> backdrop_of(const std::string& background, int width, int height, const JobContext& job);

}  // namespace motex::cli
