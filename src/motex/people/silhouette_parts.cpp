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

int root_of(std::vector<int>& parents, int label) {
  while (parents[static_cast<std::size_t>(label)] != label) {
    int& parent = parents[static_cast<std::size_t>(label)];
    parent = parents[static_cast<std::size_t>(parent)];
    label = parent;
  }
  return label;
}

/// First x ≥ from whose alpha is ≥ ½ (wanted = kTopBits) or below (wanted = 0), eight pixels at a time.
int next_change(const std::vector<std::uint8_t>& alphas, int from, int width, std::uint64_t wanted) {
  int x = from;
  for (; x + 8 <= width; x += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, alphas.data() + x, sizeof eight);
    if ((eight & kTopBits) != (wanted ^ kTopBits)) break;
  }
  while (x < width && (alphas[static_cast<std::size_t>(x)] >= 128) != (wanted != 0)) ++x;
  return x;
}

/// Joins the runs of row y (from `begin` on) with those of the row above (from `above` to `begin`).
void join_rows(SilhouetteParts& parts, std::size_t above, std::size_t begin) {
  std::vector<SilhouetteRun>& runs = parts.runs;
  for (std::size_t i = begin, j = above; i < runs.size() && j < begin;) {
    if (runs[j].first <= runs[i].last + 1 && runs[i].first <= runs[j].last + 1) {
      const int a = root_of(parts.parents, runs[i].part), b = root_of(parts.parents, runs[j].part);
      parts.parents[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    if (runs[j].last < runs[i].last)
      ++j;
    else
      ++i;
  }
}

/// Runs with labels of their own that `parents` joins.
void find_runs(const Sprite& sprite, SilhouetteParts& parts) {
  parts.runs.clear(), parts.parents.clear();
  parts.alphas.resize(static_cast<std::size_t>(sprite.width));
  std::size_t above = 0;
  for (int y = 0; y < sprite.height; ++y) {
    const PremultipliedRgba* row = &sprite.at(0, y);
    for (int x = 0; x < sprite.width; ++x) parts.alphas[static_cast<std::size_t>(x)] = row[x][3];
    const std::size_t begin = parts.runs.size();
    for (int x = next_change(parts.alphas, 0, sprite.width, kTopBits); x < sprite.width;) {
      const int end = next_change(parts.alphas, x, sprite.width, 0), label = static_cast<int>(parts.parents.size());
      parts.parents.push_back(label);
      parts.runs.push_back({y, x, end - 1, label});
      x = next_change(parts.alphas, end, sprite.width, kTopBits);
    }
    join_rows(parts, above, begin);
    above = begin;
  }
}

}  // namespace

int SilhouetteParts::largest() const {
  const auto most = std::max_element(parts.begin(), parts.end(),
                                     [](const SilhouettePart& a, const SilhouettePart& b) { return a.area < b.area; });
  return most == parts.end() ? -1 : static_cast<int>(most - parts.begin());
}

bool SilhouetteParts::is_speck(int part) const {
  const std::int64_t most = parts[static_cast<std::size_t>(largest())].area;
  const std::int64_t own = parts[static_cast<std::size_t>(part)].area;
  return own != most && (own < kSmallestPart || own * kSpeckShare < most);
}

void find_parts(const Sprite& sprite, SilhouetteParts& parts) {
  parts.parts.clear();
  parts.area = 0;
  if (sprite.empty()) {
    parts.runs.clear();
    return;
  }
  find_runs(sprite, parts);
  // The root of a part is its first run, so parts get their numbers as the runs go by.
  for (SilhouetteRun& run : parts.runs) {
    const int root = root_of(parts.parents, run.part);
    if (root == run.part) {
      run.part = static_cast<int>(parts.parts.size());
      parts.parts.push_back({{run.first, run.y, run.last, run.y}, 0});
    } else {
      run.part = parts.runs[static_cast<std::size_t>(root)].part;
    }
    SilhouettePart& part = parts.parts[static_cast<std::size_t>(run.part)];
    part.box.left = std::min(part.box.left, run.first), part.box.right = std::max(part.box.right, run.last);
    part.box.bottom = run.y;
    part.area += run.last - run.first + 1;
    parts.area += run.last - run.first + 1;
  }
}

}  // namespace motex
