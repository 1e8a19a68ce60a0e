// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/silhouette_parts.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace motex {
namespace {

constexpr std::int64_t kSpeckShare = 400;  // of the largest part
constexpr std::int64_t kSmallestPart = 4;  // pixels
constexpr std::uint64_t kTopBits = 0x8080808080808080;

void copy_alphas(const Sprite& sprite, SilhouetteParts& parts) {
  constexpr int kBlock = SilhouetteParts::kBlock;
  parts.stride = (sprite.width + kBlock - 1) / kBlock * kBlock;
  parts.alphas.resize(static_cast<std::size_t>(parts.stride) * static_cast<std::size_t>(sprite.height));
  for (int y = 0; y < sprite.height; ++y) {
    const PremultipliedRgba* row = &sprite.at(0, y);
    std::uint8_t* to = parts.alphas.data() + static_cast<std::ptrdiff_t>(y) * parts.stride;
    for (int x = 0; x < sprite.width; ++x) to[x] = row[x][3];
    std::fill(to + sprite.width, to + parts.stride, std::uint8_t{0});
  }
}

/// First x ≥ from whose alpha is ≥ ½ (wanted = kTopBits) or below (wanted = 0), eight pixels at a time.
int next_change(const std::uint8_t* alphas, int from, int width, std::uint64_t wanted) {
  int x = from;
  for (; x + 8 <= width; x += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, alphas + x, sizeof eight);
    if ((eight & kTopBits) != (wanted ^ kTopBits)) break;
  }
  while (x < width && (alphas[x] >= 128) != (wanted != 0)) ++x;
  return x;
}

void find_runs(const Sprite& sprite, SilhouetteParts& parts) {
  std::vector<RegionRun>& runs = parts.runs;
  runs.clear();
  std::size_t above = 0;
  for (int y = 0; y < sprite.height; ++y) {
    const std::uint8_t* row = parts.alphas.data() + static_cast<std::ptrdiff_t>(y) * parts.stride;
    const std::size_t begin = runs.size();
    for (int x = next_change(row, 0, sprite.width, kTopBits); x < sprite.width;) {
      const int end = next_change(row, x, sprite.width, 0);
      runs.push_back({y, x, end - 1, true, static_cast<int>(runs.size())});
      x = next_change(row, end, sprite.width, kTopBits);
    }
    join_rows(runs, above, begin);
    above = begin;
  }
}

}  // namespace

bool SilhouetteParts::is_speck(int part) const {
  const std::int64_t own = parts[static_cast<std::size_t>(part)].area;
  return own != largest_area && (own < kSmallestPart || own * kSpeckShare < largest_area);
}

void find_parts(const Sprite& sprite, SilhouetteParts& parts) {
  parts.parts.clear();
  parts.area = parts.largest_area = 0;
  if (sprite.empty()) {
    parts.runs.clear();
    return;
  }
  copy_alphas(sprite, parts);
  find_runs(sprite, parts);
  const auto nowhere = BoundingBox{sprite.width, sprite.height, -1, -1};
  parts.parts.assign(static_cast<std::size_t>(number_regions(parts.runs)), {nowhere, 0});
  for (const RegionRun& run : parts.runs) {
    SilhouettePart& part = parts.parts[static_cast<std::size_t>(run.region)];
    part.box.left = std::min(part.box.left, run.first), part.box.right = std::max(part.box.right, run.last);
    part.box.top = std::min(part.box.top, run.y), part.box.bottom = run.y;
    part.area += run.last - run.first + 1;
    parts.area += run.last - run.first + 1;
  }
  for (const SilhouettePart& part : parts.parts) parts.largest_area = std::max(parts.largest_area, part.area);
}

}  // namespace motex
