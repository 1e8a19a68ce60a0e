// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/mask_regions.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace motex {
namespace {

int root_of(std::vector<int>& parents, int label) {
  while (parents[static_cast<std::size_t>(label)] != label) {
    int& parent = parents[static_cast<std::size_t>(label)];
    parent = parents[static_cast<std::size_t>(parent)];
    label = parent;
  }
  return label;
}

/// First x > from whose value differs from that at `from`.
int end_of_run(const std::uint8_t* row, int from, int width) {
  const std::uint8_t value = row[from];
  const std::uint64_t wanted = value != 0 ? 0x0101010101010101 : 0;
  int x = from + 1;
  for (; x + 8 <= width; x += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, row + x, sizeof eight);
    if (eight != wanted) break;
  }
  while (x < width && row[x] == value) ++x;
  return x;
}

/// Makes one region of the two runs of neighbouring rows if they touch and have one value.
void join(MaskRegions& found, const Mask& mask, const RegionRun& below, const RegionRun& above) {
  const bool value = mask.at(below.first, below.y);
  if (value != mask.at(above.first, above.y)) return;
  const int reach = value ? 1 : 0;
  if (above.first > below.last + reach || below.first > above.last + reach) return;
  const int a = root_of(found.parents, below.region), b = root_of(found.parents, above.region);
  found.parents[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

/// Joins the runs from `begin` on with those of the row above (from `above` to `begin`).
void join_rows(MaskRegions& found, const Mask& mask, std::size_t above, std::size_t begin) {
  const std::vector<RegionRun>& runs = found.runs;
  for (std::size_t i = begin, j = above; i < runs.size() && j < begin;) {
    join(found, mask, runs[i], runs[j]);
    if (runs[j].last > runs[i].last) {
      ++i;
      continue;
    }
    // Where both end, the next run below still touches this one by its corner.
    if (runs[j].last == runs[i].last && i + 1 < runs.size()) join(found, mask, runs[i + 1], runs[j]);
    ++j;
  }
}

void find_runs(const Mask& mask, MaskRegions& found) {
  found.runs.clear(), found.parents.clear();
  std::size_t above = 0;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = mask.pixels.data() + static_cast<std::ptrdiff_t>(y) * mask.width;
    const std::size_t begin = found.runs.size();
    for (int x = 0; x < mask.width;) {
      const int end = end_of_run(row, x, mask.width), label = static_cast<int>(found.parents.size());
      found.parents.push_back(label);
      found.runs.push_back({y, x, end - 1, label});
      x = end;
    }
    join_rows(found, mask, above, begin);
    above = begin;
  }
}

}  // namespace

void find_regions(const Mask& mask, MaskRegions& found) {
  find_runs(mask, found);
  found.regions.clear();
  // The root of a region is its first run, so regions get their numbers as the runs go by.
  for (RegionRun& run : found.runs) {
    const int root = root_of(found.parents, run.region);
    if (root == run.region) {
      run.region = static_cast<int>(found.regions.size());
      found.regions.push_back({mask.at(run.first, run.y), false, 0});
    } else {
      run.region = found.runs[static_cast<std::size_t>(root)].region;
    }
    MaskRegion& region = found.regions[static_cast<std::size_t>(run.region)];
    region.area += run.last - run.first + 1;
    region.at_border =
        region.at_border || run.y == 0 || run.y == mask.height - 1 || run.first == 0 || run.last == mask.width - 1;
  }
}

}  // namespace motex
