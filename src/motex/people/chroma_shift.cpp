// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/chroma_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "motex/image/flat_colours.h"
#include "motex/image/planes.h"

namespace motex {
namespace {

constexpr std::size_t kMostFrames = 16;
constexpr int kRowStep = 2;
constexpr int kNear = 4, kFar = 6;      // pixels from the outline between which the actor is alone, or the scene
constexpr int kAcross = 3;              // pixels on either side of it that are looked at
constexpr float kContrast = 50;         // grey levels between the actor and the scene
constexpr float kEmpty = 0.12F;         // of that: what the scene may differ from its picture
constexpr float kEven = 8;              // grey levels: what the actor may differ from his mean there
constexpr float kLeastAngle = 0.2F;     // sine, between F and B
constexpr float kLeastTelling = 0.15F;  // cosine, between light and what leaves the plane
constexpr float kMostApart = 20;        // grey levels of a pixel's distance; beyond it is something else
constexpr int kFewest = 300;
constexpr float kLopsided = 0.12F;

float dot(const LevelTriple& a, const LevelTriple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

float difference(const Image& a, const Image& b, int x, int y) {
  const LevelTriple p = levels(a.at(x, y)), q = levels(b.at(x, y));
  return std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
}

/// Whether an outline passes at x, the actor lying towards `side` (1 = right), the scene alone on the other.
bool is_outline(const Image& frame, const Image& picture, int x, int y, int side) {
  const float inside = difference(frame, picture, x + kNear * side, y);
  if (inside < kContrast || difference(frame, picture, x, y) < inside / 2 ||
      difference(frame, picture, x - side, y) >= inside / 2)
    return false;
  for (int k = kNear; k < kFar; ++k)
    if (difference(frame, picture, x - k * side, y) > kEmpty * inside) return false;
  return true;
}

/// Mean colour of the actor beyond the outline; false where he is not even.
bool front_colour(const Image& frame, int x, int y, int side, LevelTriple& front) {
  front = {};
  for (int k = kNear; k <= kFar; ++k) {
    const LevelTriple p = levels(frame.at(x + k * side, y));
    for (std::size_t c = 0; c < 3; ++c) front[c] += p[c] / (kFar - kNear + 1);
  }
  for (int k = kNear; k <= kFar; ++k) {
    const LevelTriple p = levels(frame.at(x + k * side, y));
    const LevelTriple d{p[0] - front[0], p[1] - front[1], p[2] - front[2]};
    if (dot(d, d) > kEven * kEven) return false;
  }
  return true;
}

/// Unit normal of the plane of two colours; false where it tells nothing of light against colour.
bool normal_of(const LevelTriple& front, const LevelTriple& back, LevelTriple& normal) {
  normal = {front[1] * back[2] - front[2] * back[1], front[2] * back[0] - front[0] * back[2],
            front[0] * back[1] - front[1] * back[0]};
  const float length = std::sqrt(dot(normal, normal));
  if (length < kLeastAngle * std::sqrt(dot(front, front) * dot(back, back)) || length < 1) return false;
  for (float& part : normal) part /= length;
  return std::abs(normal[0] + normal[1] + normal[2]) >= kLeastTelling * std::sqrt(3.0F);
}

/// Σ of squared distances from the plane across the outline, colours read half a pixel towards `step`.
float sum_apart(const Image& frame, const LevelTriple& normal, int x, int y, int step) {
  float sum = 0;
  for (int k = x - kAcross; k <= x + kAcross; ++k) {
    const LevelTriple p = levels(frame.at(k, y)), q = levels(frame.at(k + step, y));
    const LevelTriple d{(q[0] - p[0]) / 2, (q[1] - p[1]) / 2, (q[2] - p[2]) / 2};
    const float apart =
        dot(normal, p) + dot(normal, d) - luma_of(d[0], d[1], d[2]) * (normal[0] + normal[1] + normal[2]);
    sum += apart * apart;
  }
  return sum;
}

struct Sums {
  double left = 0, right = 0;
  int count = 0;

  void add_outlines(const Image& frame, const Image& picture, int y) {
    constexpr float kMost = kMostApart * kMostApart * (2 * kAcross + 1);
    LevelTriple front{}, normal{};
    for (int x = kFar; x + kFar < frame.width; ++x)
      for (const int side : {1, -1}) {
        if (!is_outline(frame, picture, x, y, side) || !front_colour(frame, x, y, side, front) ||
            !normal_of(front, levels(picture.at(x, y)), normal))
          continue;
        const float of_left = sum_apart(frame, normal, x, y, -1), of_right = sum_apart(frame, normal, x, y, 1);
        if (std::max(of_left, of_right) > kMost) continue;
        left += of_left, right += of_right, ++count;
      }
  }
};

}  // namespace

float measure_chroma_shift(const Image& picture, std::span<const Image> frames) {
  Sums sums;
  const std::size_t step = (frames.size() + kMostFrames - 1) / kMostFrames;
  for (std::size_t k = 0; k < frames.size(); k += step)
    for (int y = 0; y < picture.height; y += kRowStep) sums.add_outlines(frames[k], picture, y);
  if (sums.count < kFewest) return 0;
  const double lopsided = (sums.left - sums.right) / std::max(1.0, sums.left + sums.right);
  return lopsided < -kLopsided ? -0.5F : lopsided > kLopsided ? 0.5F : 0.0F;
}

}  // namespace motex
