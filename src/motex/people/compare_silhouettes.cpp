// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/compare_silhouettes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/core/wide.h"

namespace motex {
namespace {

constexpr int kSide = SilhouettePictures::kSide;
constexpr std::size_t kRowFloats = std::size_t{4} * kSide;

/// Pixels first … of a sprite's row or column under one cell, and how much of the cell each covers.
struct Coverage {
  int first = 0;
  std::vector<float> weights;
};

/// Cells of size `cell` pixels around `centre`; pixel p covers p − ½ … p + ½.
std::vector<Coverage> cover(double centre, double cell, int sprite_first, int size) {
  std::vector<Coverage> cells(kSide);
  for (int k = 0; k < kSide; ++k) {
    const double from = centre + (k - 0.5 * kSide) * cell + 0.5 - sprite_first, to = from + cell;
    const int first = std::clamp(static_cast<int>(std::floor(from)), 0, size);
    const int end = std::clamp(static_cast<int>(std::ceil(to)), first, size);
    Coverage& coverage = cells[static_cast<std::size_t>(k)];
    coverage.first = first;
    for (int p = first; p < end; ++p)
      coverage.weights.push_back(
          static_cast<float>(std::max(0.0, std::min<double>(p + 1, to) - std::max<double>(p, from)) / cell));
  }
  return cells;
}

/// One row of pixels into the cells of a row.
void reduce_row(const PremultipliedRgba* pixels, const std::vector<Coverage>& cells, float* out) {
  for (const Coverage& cell : cells) {
    std::array<float, 4> sum{};
    for (std::size_t i = 0; i < cell.weights.size(); ++i) {
      const PremultipliedRgba& pixel = pixels[cell.first + static_cast<int>(i)];
      for (std::size_t c = 0; c < 4; ++c) sum[c] += cell.weights[i] * static_cast<float>(pixel[c]);
    }
    out = std::copy(sum.begin(), sum.end(), out);
  }
}

MOTEX_WIDE void add_row(const float* row, float weight, float* sum) {
  for (std::size_t i = 0; i < kRowFloats; ++i) sum[i] += weight * row[i];
}

MOTEX_WIDE std::int64_t sum_of_squared_differences(const std::uint8_t* a, const std::uint8_t* b, std::size_t count) {
  std::int64_t sum = 0;
  for (std::size_t block = 0; block < count; block += 1024) {
    std::int32_t part = 0;
    for (std::size_t i = block; i < block + 1024; ++i) {
      const auto difference = static_cast<std::int16_t>(a[i] - b[i]);
      part += difference * difference;
    }
    sum += part;
  }
  return sum;
}
static_assert(SilhouettePictures::kBytes % 1024 == 0);

double level_of(std::int64_t squares) {
  constexpr double kInBox = 4.0 * SilhouettePictures::kBoxSide * SilhouettePictures::kBoxSide;
  return std::min(255.0, std::sqrt(static_cast<double>(squares) / kInBox));
}

}  // namespace

SilhouettePictures::SilhouettePictures(int num_frames)
    : bytes_(static_cast<std::size_t>(num_frames) * kBytes), present_(static_cast<std::size_t>(num_frames)) {}

void SilhouettePictures::set(int frame, const Sprite& sprite, const Silhouette& silhouette) {
  if (silhouette.empty() || sprite.empty()) return;
  const std::vector<Coverage> columns =
      cover(silhouette.centroid_x, static_cast<double>(silhouette.box.width()) / kBoxSide, sprite.left, sprite.width);
  const std::vector<Coverage> rows =
      cover(silhouette.centroid_y, static_cast<double>(silhouette.box.height()) / kBoxSide, sprite.top, sprite.height);
  const int first = rows.front().first;
  const int end = rows.back().first + static_cast<int>(rows.back().weights.size());
  std::vector<float> reduced(static_cast<std::size_t>(std::max(end - first, 0)) * kRowFloats);
  for (int y = first; y < end; ++y)
    reduce_row(&sprite.at(0, y), columns, &reduced[static_cast<std::size_t>(y - first) * kRowFloats]);
  std::uint8_t* out = &bytes_[static_cast<std::size_t>(frame) * kBytes];
  for (const Coverage& row : rows) {
    std::array<float, kRowFloats> sum{};
    for (std::size_t i = 0; i < row.weights.size(); ++i)
      add_row(&reduced[(static_cast<std::size_t>(row.first - first) + i) * kRowFloats], row.weights[i], sum.data());
    for (const float value : sum) *out++ = static_cast<std::uint8_t>(std::min(value, 255.0F) + 0.5F);
  }
  present_[static_cast<std::size_t>(frame)] = 1;
}

std::int64_t SilhouettePictures::squared_difference(int a, int b) const {
  return sum_of_squared_differences(&bytes_[static_cast<std::size_t>(a) * kBytes],
                                    &bytes_[static_cast<std::size_t>(b) * kBytes], kBytes);
}

double SilhouettePictures::difference(int a, int b) const {
  if (empty(a) != empty(b)) return 255;
  return level_of(squared_difference(a, b));
}

ComparableFrames comparable_frames(const PeopleTexture& texture, SpriteSource& source, const JobContext& job) {
  const int num_frames = texture.num_frames();
  if (source.num_frames() != num_frames)
    throw InvalidInput("there are " + std::to_string(source.num_frames()) + " pictures and " +
                       std::to_string(num_frames) + " silhouettes; the model is broken, learn it again");
  ComparableFrames out{SilhouettePictures(num_frames), std::vector<MaskBits>(static_cast<std::size_t>(num_frames))};
  constexpr int kBatch = 64;
  std::vector<std::shared_ptr<const Sprite>> sprites;
  for (int first = 0; first < num_frames; first += kBatch) {
    job.check_cancelled();
    job.progress("comparing silhouettes", static_cast<double>(first) / num_frames);
    sprites.clear();
    for (int frame = first; frame < std::min(first + kBatch, num_frames); ++frame)
      sprites.push_back(source.sprite(frame));
    parallel_for(job.jobs, static_cast<int>(sprites.size()), [&](int i) {
      const auto frame = static_cast<std::size_t>(first + i);
      const Sprite& sprite = *sprites[static_cast<std::size_t>(i)];
      out.pictures.set(first + i, sprite, texture.silhouettes[frame]);
      out.masks[frame] = mask_bits(sprite, texture.silhouettes[frame]);
    });
  }
  return out;
}

FrameMatrixF compare_silhouettes(const SilhouettePictures& pictures, const FrameSpan& a, const FrameSpan& b, int jobs) {
  for (const FrameSpan& span : {a, b})
    if (span.start < 0 || span.length < 0 || span.end() > pictures.num_frames())
      throw InvalidInput("frames " + std::to_string(span.start) + " to " + std::to_string(span.end() - 1) +
                         " are not all among the " + std::to_string(pictures.num_frames()) + " there are");
  // Blocks of 64 × 64 frames: the columns' pictures stay in the cache while rows pass by.
  constexpr int kBlock = 64;
  FrameMatrixF matrix(a.length, b.length);
  const int rows = (a.length + kBlock - 1) / kBlock, columns = (b.length + kBlock - 1) / kBlock;
  parallel_for(jobs, rows * columns, [&](int task) {
    const int f_end = std::min((task / columns + 1) * kBlock, a.length),
              g_end = std::min((task % columns + 1) * kBlock, b.length);
    for (int f = task / columns * kBlock; f < f_end; ++f)
      for (int g = task % columns * kBlock; g < g_end; ++g)
        matrix(f, g) = static_cast<float>(pictures.difference(a.start + f, b.start + g));
  });
  return matrix;
}

FrameMatrixF two_frame_differences(const FrameMatrixF& matrix) {
  const Index rows = matrix.rows() - 1, columns = matrix.cols() - 1;
  if (rows < 1 || columns < 1) throw InvalidInput("two consecutive frames need stretches of two frames at least");
  const auto squares = matrix.array().square();
  return ((squares.topLeftCorner(rows, columns) + squares.bottomRightCorner(rows, columns)) / 2).sqrt();
}

}  // namespace motex
