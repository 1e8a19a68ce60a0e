// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace motex {

int num_threads(int jobs) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return jobs > 0 ? std::min(jobs, 4 * cores) : cores;
}

void parallel_for(int jobs, int num_tasks, const std::function<void(int)>& work) {
  const int threads = std::min(num_threads(jobs), num_tasks);
  if (threads <= 1) {
    for (int task = 0; task < num_tasks; ++task) work(task);
    return;
  }
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&] {
    for (int task; (task = next.fetch_add(1)) < num_tasks;) {
      try {
        work(task);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next.store(num_tasks);
      }
    }
  };
  std::vector<std::thread> pool;
  pool.reserve(static_cast<std::size_t>(threads) - 1);
  try {
    for (int i = 1; i < threads; ++i) pool.emplace_back(run);
  } catch (const std::system_error&) {  // the machine has no more threads: those there are do the work
  }
  run();
  for (auto& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace motex
