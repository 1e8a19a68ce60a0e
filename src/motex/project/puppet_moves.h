// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace motex {

/// project/puppet_moves.bvh, compiled in by cmake/embed_text.cmake; puppet_moves-origin.txt says where it is from.
extern const std::string_view kPuppetMoves;

}  // namespace motex
