// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/mask_regions.h"

#include <cstddef>
#include <cstring>

namespace motex {
namespace {

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

void find_runs(const Mask& mask, std::vector<RegionRun>& runs) {
  runs.clear();
  std::size_t above = 0;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = mask.pixels.data() + static_cast<std::ptrdiff_t>(y) * mask.width;
    const std::size_t begin = runs.size();
    for (int x = 0; x < mask.width;) {
      const int end = end_of_run(row, x, mask.width);
      runs.push_back({y, x, end - 1, row[x] != 0, static_cast<int>(runs.size())});
      x = end;
    }
    join_rows(runs, above, begin);
    above = begin;
  }
}

}  // namespace

void find_regions(const Mask& mask, MaskRegions& found) {
  find_runs(mask, found.runs);
  found.regions.assign(static_cast<std::size_t>(number_regions(found.runs)), {});
  for (const RegionRun& run : found.runs) {
    MaskRegion& region = found.regions[static_cast<std::size_t>(run.region)];
    region.value = run.value;
    region.area += run.last - run.first + 1;
    region.at_border =
        region.at_border || run.y == 0 || run.y == mask.height - 1 || run.first == 0 || run.last == mask.width - 1;
  }
}

}  // namespace motex
