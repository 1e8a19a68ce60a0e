// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/region_runs.h"

#include <algorithm>

namespace motex {
namespace {

/// The region's first run (disjoint sets with path halving).
int root_of(std::vector<RegionRun>& runs, int run) {
  while (runs[static_cast<std::size_t>(run)].region != run) {
    int& parent = runs[static_cast<std::size_t>(run)].region;
    parent = runs[static_cast<std::size_t>(parent)].region;
    run = parent;
  }
  return run;
}

void join(std::vector<RegionRun>& runs, const RegionRun& below, const RegionRun& above) {
  if (below.value != above.value) return;
  const int reach = below.value ? 1 : 0;
  if (above.first > below.last + reach || below.first > above.last + reach) return;
  const int a = root_of(runs, below.region), b = root_of(runs, above.region);
  runs[static_cast<std::size_t>(std::max(a, b))].region = std::min(a, b);
}

}  // namespace

void join_rows(std::vector<RegionRun>& runs, std::size_t above, std::size_t begin) {
  for (std::size_t i = begin, j = above; i < runs.size() && j < begin;) {
    join(runs, runs[i], runs[j]);
    if (runs[j].last > runs[i].last) {
      ++i;
      continue;
    }
    // Where both end, the next run below may still touch this one by its corner.
    if (runs[j].last == runs[i].last && i + 1 < runs.size()) join(runs, runs[i + 1], runs[j]);
    ++j;
  }
}

int number_regions(std::vector<RegionRun>& runs) {
  int regions = 0;
  // A run points at itself or at an earlier one, which has its number by now.
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto parent = static_cast<std::size_t>(runs[i].region);
    runs[i].region = parent == i ? regions++ : runs[parent].region;
  }
  return regions;
}

}  // namespace motex
