// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/child_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace motex {

bool survives_in_child(const std::function<void()>& work, int max_cpu_secs) {
  const pid_t child = fork();
  if (child == 0) {
    const auto secs = static_cast<rlim_t>(max_cpu_secs);
    const rlimit processor{secs, secs}, no_core{0, 0};
    setrlimit(RLIMIT_CPU, &processor);
    setrlimit(RLIMIT_CORE, &no_core);
    close(STDOUT_FILENO);
    close(STDERR_FILENO);
    try {
      work();
    } catch (...) {  // the caller meets it too when it does the work itself
    }
    _exit(0);
  }
  int status = 0;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status == 0;
}

}  // namespace motex
