// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace motex {

// Files of src/motex/project/viewer/, compiled in by cmake/embed_text.cmake.
extern const std::string_view kViewerHtml;
extern const std::string_view kViewerCss;
extern const std::string_view kViewerJs;

}  // namespace motex
