// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/shots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/quantile.h"

namespace motex {
namespace {

constexpr double kSmallPixels = 5184;  // 96 × 54
constexpr int kSparedLevels = 3;
constexpr double kFlashLevels = 12;
constexpr double kNoise = 0.1;
constexpr double kCutScore = 3;

/// Replaces each value by pick(left, itself, right), then by pick(above, itself, below); beyond the border there is
/// nothing. Planes of width · height one after another.
template <typename Pick>
std::vector<std::uint8_t> of_neighbours(const std::vector<std::uint8_t>& values, int width, int height, Pick pick) {
  std::vector<std::uint8_t> rows(values.size()), out(values.size());
  const auto num_rows = static_cast<std::ptrdiff_t>(values.size()) / width;
  for (std::ptrdiff_t y = 0; y < num_rows; ++y) {
    const std::uint8_t* in = values.data() + y * width;
    std::uint8_t* to = rows.data() + y * width;
    for (int x = 1; x + 1 < width; ++x) to[x] = pick(pick(in[x - 1], in[x]), in[x + 1]);
    to[0] = width > 1 ? pick(in[0], in[1]) : in[0];
    to[width - 1] = width > 1 ? pick(in[width - 2], in[width - 1]) : in[0];
  }
  for (std::ptrdiff_t y = 0; y < num_rows; ++y) {
    const std::uint8_t* in = rows.data() + y * width;
    const std::uint8_t* above = y % height > 0 ? in - width : in;
    const std::uint8_t* below = y % height + 1 < height ? in + width : in;
    for (int x = 0; x < width; ++x)
      out[static_cast<std::size_t>(y * width + x)] = pick(pick(above[x], in[x]), below[x]);
  }
  return out;
}

/// Mean of what of the values lies beyond lows … highs by more than the spared levels.
double beyond(const std::vector<std::uint8_t>& values, const std::vector<std::uint8_t>& lows,
              const std::vector<std::uint8_t>& highs) {
  int sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += std::max(0, std::max(values[i] - highs[i], lows[i] - values[i]) - kSparedLevels);
  return static_cast<double>(sum) / static_cast<double>(values.size());
}

}  // namespace

ShotFinder::ShotFinder(double frames_per_sec)
    : reach_(std::clamp(static_cast<int>(std::lround(frames_per_sec / 2)), 4, 60)) {}

PictureSize ShotFinder::small_size(int width, int height) {
  const double num_pixels = static_cast<double>(width) * height;
  const double scale = num_pixels <= 1.1 * kSmallPixels ? 1 : std::sqrt(num_pixels / kSmallPixels);
  return {std::max(1, static_cast<int>(std::lround(width / scale))),
          std::max(1, static_cast<int>(std::lround(height / scale)))};
}

ShotFinder::SmallFrame ShotFinder::shrink(const Image& frame) const {
  const std::size_t num_values = 3 * static_cast<std::size_t>(small_width_) * static_cast<std::size_t>(small_height_);
  std::vector<int> sums(3 * static_cast<std::size_t>(small_width_));
  SmallFrame out;
  out.values.resize(num_values);
  double total = 0;
  for (int v = 0; v < small_height_; ++v) {
    const int top = v * height_ / small_height_, bottom = (v + 1) * height_ / small_height_;
    const int row_step = std::max(1, (bottom - top) / 4);
    std::fill(sums.begin(), sums.end(), 0);
    int rows = 0;
    for (int y = top; y < bottom; y += row_step, ++rows) {
      for (int u = 0; u < small_width_; ++u) {
        int r = 0, g = 0, b = 0;
        for (int x = u * width_ / small_width_; x < (u + 1) * width_ / small_width_; ++x) {
          const Rgba& pixel = frame.at(x, y);
          r += pixel.r, g += pixel.g, b += pixel.b;
        }
        int* sum = sums.data() + static_cast<std::ptrdiff_t>(3) * u;
        sum[0] += r, sum[1] += g, sum[2] += b;
      }
    }
    for (int u = 0; u < small_width_; ++u) {
      const int columns = (u + 1) * width_ / small_width_ - u * width_ / small_width_;
      for (int c = 0; c < 3; ++c) {
        const double value = sums[static_cast<std::size_t>(3 * u + c)] / static_cast<double>(rows * columns);
        out.values[static_cast<std::size_t>((c * small_height_ + v) * small_width_ + u)] =
            static_cast<std::uint8_t>(value + 0.5);
        total += value;
      }
    }
  }
  out.mean = total / static_cast<double>(num_values);
  const auto least = [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); };
  const auto most = [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); };
  out.lows_one = of_neighbours(out.values, small_width_, small_height_, least);
  out.highs_one = of_neighbours(out.values, small_width_, small_height_, most);
  out.lows_two = of_neighbours(out.lows_one, small_width_, small_height_, least);
  out.highs_two = of_neighbours(out.highs_one, small_width_, small_height_, most);
  return out;
}

void ShotFinder::add(const Image& frame) {
  if (num_frames_ == 0) {
    width_ = frame.width, height_ = frame.height;
    const PictureSize small = small_size(width_, height_);
    small_width_ = small.width, small_height_ = small.height;
  }
  if (frame.width != width_ || frame.height != height_)
    throw InvalidInput("frame " + std::to_string(num_frames_) + " is " + std::to_string(frame.width) + " × " +
                       std::to_string(frame.height) + ", the first " + std::to_string(width_) + " × " +
                       std::to_string(height_));
  waiting_.push_back(shrink(frame));
  means_.push_back(waiting_.back().mean);
  ++num_frames_;
  if (num_frames_ > next_ + reach_) classify_oldest();
}

void ShotFinder::classify_oldest() {
  SmallFrame frame = std::move(waiting_.front());
  waiting_.pop_front();
  const double usual = quantile({means_.begin(), means_.end()}, 0.5);
  if (std::abs(frame.mean - usual) > kFlashLevels) {
    if (flashes_.empty() || flashes_.back().end() != next_) flashes_.push_back({next_, 0});
    ++flashes_.back().length;
  } else {
    compare(frame);
    past_.push_back(std::move(frame));
    if (past_.size() > static_cast<std::size_t>(reach_) + 2) past_.pop_front();
  }
  if (next_ >= reach_) means_.pop_front();
  ++next_;
}

void ShotFinder::compare(const SmallFrame& frame) {
  if (past_.empty()) return;
  const auto change_one = [](const SmallFrame& a, const SmallFrame& b) {
    return std::max(beyond(a.values, b.lows_one, b.highs_one), beyond(b.values, a.lows_one, a.highs_one));
  };
  const auto change_two = [](const SmallFrame& a, const SmallFrame& b) {
    return std::max(beyond(a.values, b.lows_two, b.highs_two), beyond(b.values, a.lows_two, a.highs_two));
  };
  Change now{next_, change_one(past_.back(), frame), change_two(past_.back(), frame), 0, 0};
  const bool after_flash = !flashes_.empty() && flashes_.back().end() == next_;
  const std::size_t steps = after_flash ? static_cast<std::size_t>(flashes_.back().length) + 2 : 2;
  if (past_.size() > steps) {
    const SmallFrame& before = past_[past_.size() - 1 - steps];
    now.usual_one = change_one(before, past_.back()), now.usual_two = change_two(before, past_.back());
  }
  changes_.push_back(now);
}

/// changes_[k].usual is of frames k − 3 … k − 1: those of idx − 2 … idx end before the step, idx + 3 … begin after it.
double ShotFinder::score(std::size_t idx) const {
  double one = 0, two = 0;
  for (std::size_t k = idx < 2 ? 0 : idx - 2; k < std::min(changes_.size(), idx + 6); ++k) {
    if (k == idx + 1 || k == idx + 2) continue;
    one = std::max(one, changes_[k].usual_one);
    two = std::max(two, changes_[k].usual_two);
  }
  return changes_[idx].one / (one + kNoise) + changes_[idx].two / (two + kNoise);
}

ShotReport ShotFinder::finish() {
  while (next_ < num_frames_) classify_oldest();
  ShotReport report;
  report.flashes = flashes_;
  int start = 0;
  for (std::size_t k = 0; k < changes_.size(); ++k) {
    if (score(k) < kCutScore) continue;
    report.shots.push_back({start, changes_[k].frame - start});
    start = changes_[k].frame;
  }
  if (num_frames_ > 0) report.shots.push_back({start, num_frames_ - start});
  return report;
}

}  // namespace motex
