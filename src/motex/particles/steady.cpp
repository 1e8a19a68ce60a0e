// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/steady.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr int kLevels = 4;
constexpr int kSteps = 25;
constexpr double kStillShift = 1;         // pixels
constexpr double kLeastGain = 0.7;        // of the difference to the middle frame that may be left, or it was no camera
constexpr double kMostSpread = 1.0 / 16;  // of the picture, within a run

std::vector<Plane> pyramid_of(const Plane& plane) {
  int num = 1;
  while (num < kLevels && std::min(plane.width, plane.height) >> num >= 24) ++num;
  return gaussian_pyramid(gaussian_blur(plane, 1), num);
}

float bilinear(const Plane& plane, double x, double y) {
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const float* a = plane.row(top) + left;
  const float* b = a + plane.width;
  return (1 - fy) * ((1 - fx) * a[0] + fx * a[1]) + fy * ((1 - fx) * b[0] + fx * b[1]);
}

/// One robust Gauss–Newton step; false when it has arrived.
bool improve(const Plane& reference, const Plane& frame, Shift& shift, double& spread) {
  double xx = 1e-6, xy = 0, yy = 1e-6, bx = 0, by = 0, absolute = 0;
  int count = 0;
  for (int y = 1; y + 1 < reference.height; ++y)
    for (int x = 1; x + 1 < reference.width; ++x) {
      const double fx = x + shift.dx, fy = y + shift.dy;
      if (fx < 0 || fy < 0 || fx >= frame.width - 1 || fy >= frame.height - 1) continue;
      const double gx = 0.5 * static_cast<double>(reference.at(x + 1, y) - reference.at(x - 1, y));
      const double gy = 0.5 * static_cast<double>(reference.at(x, y + 1) - reference.at(x, y - 1));
      const double error = static_cast<double>(bilinear(frame, fx, fy) - reference.at(x, y));
      const double weight = 1 / (1 + error * error / (spread * spread));
      xx += weight * gx * gx;
      xy += weight * gx * gy;
      yy += weight * gy * gy;
      bx += weight * gx * error;
      by += weight * gy * error;
      absolute += std::abs(error);
      ++count;
    }
  if (count == 0) return false;
  spread = std::max(1.0, absolute / count);
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-9 * xx * yy)) return false;
  const double dx = (yy * bx - xy * by) / determinant, dy = (xx * by - xy * bx) / determinant;
  shift.dx -= std::clamp(dx, -2.0, 2.0);
  shift.dy -= std::clamp(dy, -2.0, 2.0);
  return std::hypot(dx, dy) > 0.003;
}

Shift align(const std::vector<Plane>& reference, const std::vector<Plane>& frame, Shift shift) {
  for (int level = static_cast<int>(reference.size()) - 1; level >= 0; --level) {
    const double step = 1 << level;
    Shift here{shift.dx / step, shift.dy / step};
    const auto k = static_cast<std::size_t>(level);
    double spread = 10;
    for (int n = 0; n < kSteps && improve(reference[k], frame[k], here, spread); ++n) {
    }
    shift = {here.dx * step, here.dy * step};
  }
  return shift;
}

/// Longest run of frames whose shifts span at most that.
std::pair<int, int> longest_run(const std::vector<Shift>& shifts, double most_x, double most_y) {
  std::pair<int, int> best{0, 0};
  for (int first = 0; first < static_cast<int>(shifts.size()); ++first) {
    double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
    int end = first;
    for (; end < static_cast<int>(shifts.size()); ++end) {
      const Shift& s = shifts[static_cast<std::size_t>(end)];
      low_x = std::min(low_x, s.dx), high_x = std::max(high_x, s.dx);
      low_y = std::min(low_y, s.dy), high_y = std::max(high_y, s.dy);
      if (high_x - low_x > most_x || high_y - low_y > most_y) break;
    }
    if (end - first > best.second - best.first) best = {first, end};
  }
  return best;
}

/// Mean difference to the middle frame after moving back, divided by that before: near 1 where the picture changes
/// by itself.
double what_is_left(const std::vector<Plane>& frames, const std::vector<Shift>& shifts) {
  const Plane& reference = frames[frames.size() / 2];
  double before = 1e-9, after = 0;
  for (std::size_t t = 0; t < frames.size(); t += 4)
    for (int y = 0; y < reference.height; y += 2)
      for (int x = 0; x < reference.width; x += 2) {
        const double fx = x + shifts[t].dx, fy = y + shifts[t].dy;
        if (fx < 0 || fy < 0 || fx >= reference.width - 1 || fy >= reference.height - 1) continue;
        before += std::abs(static_cast<double>(frames[t].at(x, y) - reference.at(x, y)));
        after += std::abs(static_cast<double>(bilinear(frames[t], fx, fy) - reference.at(x, y)));
      }
  return after / before;
}

/// Catmull–Rom weights of the four pixels around a fraction 0 … 1.
std::array<float, 4> cubic_weights(double f) {
  return {static_cast<float>(((-0.5 * f + 1) * f - 0.5) * f), static_cast<float>((1.5 * f - 2.5) * f * f + 1),
          static_cast<float>(((-1.5 * f + 2) * f + 0.5) * f), static_cast<float>((0.5 * f - 0.5) * f * f)};
}

/// The part of the plane whose top left pixel is at (x, y), which need not be whole numbers.
Plane cut(const Plane& plane, double x, double y, int width, int height) {
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const std::array<float, 4> wx = cubic_weights(x - left), wy = cubic_weights(y - top);
  Plane rows(width, height + 3), out(width, height);
  for (int j = 0; j < height + 3; ++j) {
    const float* from = plane.row(std::clamp(top + j - 1, 0, plane.height - 1));
    for (int i = 0; i < width; ++i) {
      float sum = 0;
      for (int k = 0; k < 4; ++k)
        sum += wx[static_cast<std::size_t>(k)] * from[std::clamp(left + i + k - 1, 0, plane.width - 1)];
      rows.at(i, j) = sum;
    }
  }
  for (int j = 0; j < height; ++j)
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < width; ++i) out.at(i, j) += wy[static_cast<std::size_t>(k)] * rows.at(i, j + k);
  return out;
}

}  // namespace

std::vector<Shift> estimate_shifts(const std::vector<Plane>& frames, const JobContext& job) {
  if (frames.empty()) throw InvalidInput("there are no frames to steady");
  for (const Plane& frame : frames)
    if (frame.width != frames[0].width || frame.height != frames[0].height || frame.values.empty())
      throw InvalidInput("the frames must have one size");
  const int num = static_cast<int>(frames.size()), middle = num / 2;
  std::vector<Shift> shifts(frames.size());
  const std::vector<Plane> reference = pyramid_of(frames[static_cast<std::size_t>(middle)]);
  parallel_for(job.jobs, 2, [&](int side) {
    Shift shift;
    const int step = side == 0 ? -1 : 1;
    for (int t = middle + step; t >= 0 && t < num; t += step) {
      job.check_cancelled();
      shift = align(reference, pyramid_of(frames[static_cast<std::size_t>(t)]), shift);
      shifts[static_cast<std::size_t>(t)] = shift;
    }
  });
  return shifts;
}

SteadyClip steady(const ClipFrames& clip, const JobContext& job) {
  SteadyClip out;
  const std::vector<Shift> shifts = estimate_shifts(clip.luma, job);
  for (const Shift& s : shifts) out.largest_shift = std::max(out.largest_shift, std::hypot(s.dx, s.dy));
  const auto [first, end] = longest_run(shifts, kMostSpread * clip.width, kMostSpread * clip.height);
  if (out.largest_shift <= kStillShift || end - first < clip.num_frames() / 3 ||
      what_is_left(clip.luma, shifts) > kLeastGain) {
    out.clip = clip;
    return out;
  }
  out.moved = true;
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
  for (int t = first; t < end; ++t) {
    const Shift& s = shifts[static_cast<std::size_t>(t)];
    low_x = std::min(low_x, s.dx), high_x = std::max(high_x, s.dx);
    low_y = std::min(low_y, s.dy), high_y = std::max(high_y, s.dy);
  }
  // the picture (left, top) … in coordinates of the middle frame is inside every frame; even sizes suit codecs
  out.left = static_cast<int>(std::ceil(-low_x));
  out.top = static_cast<int>(std::ceil(-low_y));
  const int width = (static_cast<int>(std::floor(clip.width - high_x)) - out.left) / 2 * 2;
  const int height = (static_cast<int>(std::floor(clip.height - high_y)) - out.top) / 2 * 2;
  out.first_frame = first;
  out.clip = {width, height, clip.frames_per_sec, {}, {}};
  const auto num = static_cast<std::size_t>(end - first);
  out.clip.luma.resize(num);
  if (!clip.colour.empty()) out.clip.colour.resize(num);
  parallel_for(job.jobs, static_cast<int>(num), [&](int k) {
    const auto to = static_cast<std::size_t>(k), from = to + static_cast<std::size_t>(out.first_frame);
    const double x = out.left + shifts[from].dx, y = out.top + shifts[from].dy;
    if (clip.colour.empty()) {
      out.clip.luma[to] = cut(clip.luma[from], x, y, width, height);
      return;
    }
    Planes planes = to_planes(clip.colour[from], 3);
    for (Plane& plane : planes) plane = cut(plane, x, y, width, height);
    out.clip.colour[to] = to_image(planes);
    out.clip.luma[to] = luma(out.clip.colour[to]);
  });
  return out;
}

}  // namespace motex
