// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace motex {

/// For work of other libraries that may crash or run without end: does it in a copy of the process, silently, and says
/// whether it ended by itself within so much processor time. What it throws, computes and prints is lost; true as well
/// where no process can be had.
bool survives_in_child(const std::function<void()>& work, int max_cpu_secs);

}  // namespace motex
