// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace motex::cli {

/// From now on the first Ctrl-C (or SIGTERM) sets interrupted(), so that work stops and cleans up; the second one ends
/// the program at once with exit code 130.
void watch_interrupts();
const std::atomic<bool>& interrupted();

}  // namespace motex::cli
