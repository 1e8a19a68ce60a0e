// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/matrix_profile.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "motex/core/parallel.h"
#include "motex/people/profile_kernel.h"

namespace motex {
namespace {

constexpr int kGroupsATask = 8;
constexpr int kRowsBeforeRestart = 4096;

/// What the diagonals need, with room for a group of them at the end: 0 never beats a correlation found.
struct DiagonalArrays {
  std::vector<double> f, g, norm, values, mean;
  int stride = 0, value_stride = 0;
};

DiagonalArrays diagonal_arrays(const SeriesWindows& windows) {
  const int m = windows.window, num_windows = windows.num_windows;
  DiagonalArrays out;
  out.stride = num_windows + kDiagonals;
  out.value_stride = windows.num_frames + kDiagonals;
  const auto size = static_cast<std::size_t>(out.stride) * static_cast<std::size_t>(windows.num_signals);
  for (std::vector<double>* array : {&out.f, &out.g, &out.mean}) array->assign(size, 0);
  out.norm.assign(static_cast<std::size_t>(out.stride), 0);
  out.values.assign(static_cast<std::size_t>(out.value_stride) * static_cast<std::size_t>(windows.num_signals), 0);
  for (int i = 0; i < num_windows; ++i)
    if (windows.usable[static_cast<std::size_t>(i)] != 0 && windows.deviation(i) > 0)
      out.norm[static_cast<std::size_t>(i)] = 1 / (windows.deviation(i) * std::sqrt(static_cast<double>(m)));
  for (int s = 0; s < windows.num_signals; ++s) {
    const double* x = windows.signal(s);
    const std::size_t at = static_cast<std::size_t>(s) * static_cast<std::size_t>(out.stride);
    std::copy_n(x, windows.num_frames,
                out.values.data() + static_cast<std::size_t>(s) * static_cast<std::size_t>(out.value_stride));
    for (int i = 0; i < num_windows; ++i) {
      const std::size_t k = at + static_cast<std::size_t>(i);
      out.mean[k] = windows.mean(s, i);
      if (i == 0) continue;
      out.f[k] = (x[i + m - 1] - x[i - 1]) / 2;
      out.g[k] = (x[i + m - 1] - windows.mean(s, i)) + (x[i - 1] - windows.mean(s, i - 1));
    }
  }
  return out;
}

/// The best correlations that one thread has seen.
struct Best {
  std::vector<double> correlation;
  std::vector<int> nearest;
  explicit Best(int stride, int num_windows)
      : correlation(static_cast<std::size_t>(stride), 0), nearest(static_cast<std::size_t>(stride), -1) {
    std::fill(correlation.begin() + num_windows, correlation.end(), std::numeric_limits<double>::infinity());
  }
};

/// Equal correlations: the group of diagonals that is walked first wins, whichever thread walked it.
void merge(Best& into, const Best& from, int num_windows, int first_diagonal) {
  for (int i = 0; i < num_windows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (from.nearest[k] < 0) continue;
    const int group_of_new = (std::abs(from.nearest[k] - i) - first_diagonal) / kDiagonals;
    const int group_of_old = (std::abs(into.nearest[k] - i) - first_diagonal) / kDiagonals;
    const bool better = from.correlation[k] > into.correlation[k] ||
                        (from.correlation[k] == into.correlation[k] && group_of_new < group_of_old);
    if (into.nearest[k] >= 0 && !better) continue;
    into.correlation[k] = from.correlation[k];
    into.nearest[k] = from.nearest[k];
  }
}

/// Nothing correlates positively with the window: the least dissimilar, one by one.
int least_dissimilar(const SeriesWindows& windows, int i, int exclusion) {
  double best = std::numeric_limits<double>::infinity();
  int nearest = -1;
  for (int j = 0; j < windows.num_windows; ++j) {
    if (std::abs(i - j) <= exclusion || windows.usable[static_cast<std::size_t>(j)] == 0) continue;
    const double distance = windows.distance(i, j);
    if (distance >= best) continue;
    best = distance;
    nearest = j;
  }
  return nearest;
}

Best best_correlations(const SeriesWindows& windows, int first_diagonal, const JobContext& job) {
  const DiagonalArrays arrays = diagonal_arrays(windows);
  const int num_windows = windows.num_windows;
  const int num_groups = std::max(0, (num_windows - first_diagonal + kDiagonals - 1) / kDiagonals);
  const int num_tasks = (num_groups + kGroupsATask - 1) / kGroupsATask;
  const int threads = std::max(1, std::min(num_threads(job.jobs), num_tasks));
  std::vector<Best> best(static_cast<std::size_t>(threads), Best(arrays.stride, num_windows));
  std::atomic<int> next{0};
  const int restart = std::max(kRowsBeforeRestart, 16 * windows.window);
  parallel_for(threads, threads, [&](int thread) {
    Best& mine = best[static_cast<std::size_t>(thread)];
    const ProfileRows rows{arrays.f.data(),      arrays.g.data(),         arrays.norm.data(),  arrays.mean.data(),
                           arrays.values.data(), arrays.stride,           arrays.value_stride, windows.num_signals,
                           windows.window,       mine.correlation.data(), mine.nearest.data()};
    for (int task; (task = next.fetch_add(1)) < num_tasks;) {
      job.check_cancelled();
      for (int group = task * kGroupsATask; group < std::min(num_groups, (task + 1) * kGroupsATask); ++group) {
        const int diagonal = first_diagonal + group * kDiagonals;
        for (int row = 0; row < num_windows - diagonal; row += restart)
          walk_diagonals(rows, diagonal, row, std::min(row + restart, num_windows - diagonal));
      }
    }
  });
  for (std::size_t k = 1; k < best.size(); ++k) merge(best[0], best[k], num_windows, first_diagonal);
  return std::move(best[0]);
}

}  // namespace

int default_exclusion(int window) { return (window + 3) / 4; }

MatrixProfile matrix_profile(const SeriesWindows& windows, int exclusion, const JobContext& job) {
  MatrixProfile out;
  out.window = windows.window;
  out.exclusion = exclusion < 0 ? default_exclusion(windows.window) : exclusion;
  const Best best = best_correlations(windows, out.exclusion + 1, job);
  const auto size = static_cast<std::size_t>(windows.num_windows);
  out.distance.assign(size, std::numeric_limits<double>::infinity());
  out.nearest.assign(size, -1);
  constexpr int kBlock = 1024;
  parallel_for(job.jobs, (windows.num_windows + kBlock - 1) / kBlock, [&](int block) {
    job.check_cancelled();
    for (int i = block * kBlock; i < std::min(windows.num_windows, (block + 1) * kBlock); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (windows.usable[k] == 0) continue;
      const int nearest = best.nearest[k] >= 0 ? best.nearest[k] : least_dissimilar(windows, i, out.exclusion);
      if (nearest < 0) continue;
      out.nearest[k] = nearest;
      out.distance[k] = windows.distance(i, nearest);
    }
  });
  return out;
}

}  // namespace motex
