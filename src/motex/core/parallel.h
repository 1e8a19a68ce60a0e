// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace motex {

/// Number of threads that `jobs` (0 = all cores) stands for; never more than four a core.
int num_threads(int jobs);

/// Calls work(task) for task = 0 … num_tasks − 1 from up to num_threads(jobs) threads, in no promised order.
/// Tasks must not share what they write; then the result is the same for any number of threads.
/// The first exception stops the remaining tasks and is rethrown here.
void parallel_for(int jobs, int num_tasks, const std::function<void(int task)>& work);

}  // namespace motex
