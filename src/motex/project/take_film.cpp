// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/take_film.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/people/premultiply.h"
#include "motex/people/warp_sprites.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

constexpr int kNumLevels = 5;     // the coarsest: cells of 16 pixels
constexpr int kUnit = 16;         // sides of a canvas are multiples: whole macroblocks
constexpr int kCleared = 6;       // alphas this near to 0 or 255 are the codec's ripples
constexpr int kKeyInterval = 15;  // of WriteVideoOptions::for_storage

constexpr int kFar = 1 << 30;

int rounded_up(int size) { return (size + kUnit - 1) / kUnit * kUnit; }

std::uint8_t cleaned(std::uint8_t alpha) {
  if (alpha < kCleared) return 0;
  return alpha > 255 - kCleared ? 255 : alpha;
}

}  // namespace

TakeFilmWriter::TakeFilmWriter(double frames_per_sec, bool lossless, const JobContext& job)
    : frames_per_sec_(frames_per_sec), job_(job), waiting_(kChunkFrames) {
  film_.lossless = lossless;
}

void TakeFilmWriter::add(const Sprite& sprite) {
  film_.boxes.push_back(box_of(sprite));
  waiting_[num_waiting_++] = sprite;
  if (num_waiting_ == waiting_.size()) write_chunk();
}

void TakeFilmWriter::write_chunk() {
  BoundingBox canvas{kFar, kFar, -kFar, -kFar};
  for (std::size_t k = 0; k < num_waiting_; ++k) {
    const BoundingBox box = box_of(waiting_[k]);
    if (box.empty()) continue;
    canvas = {std::min(canvas.left, box.left), std::min(canvas.top, box.top), std::max(canvas.right, box.right),
              std::max(canvas.bottom, box.bottom)};
  }
  FilmChunk& chunk = film_.chunks.emplace_back();
  if (!canvas.empty()) {
    prepare(canvas);
    auto video = std::make_shared<std::string>();
    VideoWriter writer = VideoWriter::to_bytes(*video, film_.lossless ? ".mkv" : ".mp4", picture_.width,
                                               picture_.height, {frames_per_sec_, film_.lossless, true}, job_);
    for (std::size_t k = 0; k < num_waiting_; ++k) {
      if (film_.lossless)
        draw_plain(waiting_[k]);
      else
        draw_stacked(waiting_[k]);
      writer.write(picture_);
    }
    writer.finish();
    chunk = {canvas_, std::move(video)};
  }
  num_waiting_ = 0;
}

void TakeFilmWriter::prepare(const BoundingBox& canvas) {
  const int width = rounded_up(canvas.width()), height = rounded_up(canvas.height());
  if (width > kMaxCanvasSide || height > kMaxCanvasSide)
    throw InvalidInput("pictures of more than " + std::to_string(kMaxCanvasSide) + " pixels a side cannot be stored");
  canvas_ = {canvas.left, canvas.top, canvas.left + width - 1, canvas.top + height - 1};
  picture_ = Image(width, film_.lossless ? height : 2 * height);
  levels_.resize(kNumLevels);
  for (int k = 0; k < kNumLevels; ++k) {
    Level& level = levels_[static_cast<std::size_t>(k)];
    level.width = width >> k;
    level.height = height >> k;
    level.values.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4);
  }
}

void TakeFilmWriter::draw_plain(const Sprite& sprite) {
  std::fill(picture_.pixels.begin(), picture_.pixels.end(), Rgba{0, 0, 0, 0});
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x) {
      const PremultipliedRgba& pixel = sprite.at(x, y);
      picture_.at(sprite.left - canvas_.left + x, sprite.top - canvas_.top + y) = {pixel[0], pixel[1], pixel[2],
                                                                                   pixel[3]};
    }
}

/// Level k + 1 is the mean of 2 × 2 of level k; cells of the coarsest without anyone take the mean of their neighbours.
void TakeFilmWriter::fill_pyramid(const Sprite& sprite) {
  std::fill(levels_[0].values.begin(), levels_[0].values.end(), 0.0F);
  for (int y = 0; y < sprite.height; ++y) {
    float* row = &levels_[0].values[4 * (static_cast<std::size_t>(sprite.top - canvas_.top + y) *
                                             static_cast<std::size_t>(levels_[0].width) +
                                         static_cast<std::size_t>(sprite.left - canvas_.left))];
    for (int x = 0; x < sprite.width; ++x)
      for (std::size_t k = 0; k < 4; ++k) *row++ = sprite.at(x, y)[k];
  }
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const Level& fine = levels_[k - 1];
    Level& coarse = levels_[k];
    const std::size_t stride = 4 * static_cast<std::size_t>(fine.width);
    for (int y = 0; y < coarse.height; ++y) {
      const float* above = &fine.values[2 * static_cast<std::size_t>(y) * stride];
      float* out = &coarse.values[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(coarse.width)];
      for (int x = 0; x < coarse.width; ++x, above += 8)
        for (std::size_t c = 0; c < 4; ++c)
          *out++ = 0.25F * (above[c] + above[c + 4] + above[c + stride] + above[c + stride + 4]);
    }
  }
  Level& top = levels_.back();
  const std::vector<float> seen = top.values;
  for (int y = 0; y < top.height; ++y)
    for (int x = 0; x < top.width; ++x) {
      const std::size_t at = 4 * static_cast<std::size_t>(y * top.width + x);
      if (seen[at + 3] > 0) continue;
      for (int v = std::max(0, y - 1); v <= std::min(top.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(top.width - 1, x + 1); ++u)
          for (std::size_t c = 0; c < 4; ++c)
            top.values[at + c] += seen[4 * static_cast<std::size_t>(v * top.width + u) + c];
    }
}

/// Colours: each pixel's own where it is opaque, those of the next coarser level where it is not.
void TakeFilmWriter::draw_stacked(const Sprite& sprite) {
  constexpr Rgba kNobody{128, 128, 128, 255}, kBlack{0, 0, 0, 255};
  const int height = canvas_.height();
  const auto half = picture_.pixels.begin() + static_cast<std::ptrdiff_t>(picture_.pixels.size() / 2);
  std::fill(picture_.pixels.begin(), half, kNobody);
  std::fill(half, picture_.pixels.end(), kBlack);
  if (sprite.empty()) return;
  fill_pyramid(sprite);
  Level& top = levels_.back();
  for (std::size_t at = 0; at < top.values.size(); at += 4)
    for (std::size_t c = 0; c < 3 && top.values[at + 3] > 0; ++c) top.values[at + c] *= 255 / top.values[at + 3];
  for (std::size_t k = levels_.size() - 1; k-- > 0;) {
    Level& fine = levels_[k];
    const Level& coarse = levels_[k + 1];
    for (int y = 0; y < fine.height; ++y) {
      float* out = &fine.values[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.width)];
      const float* from = &coarse.values[4 * static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(coarse.width)];
      for (int x = 0; x < fine.width; ++x, out += 4) {
        const float* below = from + 4 * (x / 2);
        if (below[3] <= 0) continue;  // nobody near
        const float rest = 1 - out[3] / 255;
        for (std::size_t c = 0; c < 3; ++c) out[c] += rest * below[c];
        if (k > 0) out[3] = 255;
      }
    }
  }
  const Level& finest = levels_[0];
  const Level& next = levels_[1];
  for (int y = 0; y < height; ++y) {
    const float* from = &finest.values[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(finest.width)];
    const float* near = &next.values[4 * static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(next.width)];
    Rgba* colour = &picture_.at(0, y);
    for (int x = 0; x < finest.width; ++x, from += 4) {
      if (near[4 * (x / 2) + 3] <= 0) continue;
      const auto whole = [&](std::size_t c) {
        return static_cast<std::uint8_t>(std::clamp(from[c] + 0.5F, 0.0F, 255.0F));
      };
      colour[x] = {whole(0), whole(1), whole(2), 255};
    }
  }
  for (int y = 0; y < sprite.height; ++y) {
    Rgba* matte = &picture_.at(sprite.left - canvas_.left, height + sprite.top - canvas_.top + y);
    for (int x = 0; x < sprite.width; ++x) {
      const std::uint8_t alpha = sprite.at(x, y)[3];
      matte[x] = {alpha, alpha, alpha, 255};
    }
  }
}

TakeFilm TakeFilmWriter::finish() {
  if (num_waiting_ > 0) write_chunk();
  return std::move(film_);
}

FilmChunkReader::FilmChunkReader(const FilmChunk& chunk, bool lossless)
    : chunk_(chunk), lossless_(lossless), reader_(VideoReader::from_bytes(*chunk.video, "the model's footage")) {
  const VideoInfo& info = reader_.info();
  if (info.width != chunk_.canvas.width() || info.height != chunk_.canvas.height() * (lossless ? 1 : 2))
    throw InvalidInput("the model's footage is of another size than the model says; learn it again");
}

Sprite FilmChunkReader::read(int frame, const BoundingBox& box) {
  if (frame < next_ || frame > next_ + kKeyInterval) {
    reader_.seek(frame);
    next_ = frame;
  }
  for (; next_ <= frame; ++next_)
    if (!reader_.next(frame_)) throw InvalidInput("the model's footage has fewer frames than the model says");
  return cut_out(frame_.image, box);
}

Sprite FilmChunkReader::cut_out(const Image& picture, const BoundingBox& box) const {
  Sprite sprite;
  sprite.left = box.left;
  sprite.top = box.top;
  sprite.width = box.width();
  sprite.height = box.height();
  sprite.pixels.reserve(static_cast<std::size_t>(sprite.width) * static_cast<std::size_t>(sprite.height));
  const int left = box.left - chunk_.canvas.left, height = chunk_.canvas.height();
  for (int y = box.top - chunk_.canvas.top; y <= box.bottom - chunk_.canvas.top; ++y) {
    const Rgba* colour = &picture.at(left, y);
    if (lossless_) {
      for (int x = 0; x < sprite.width; ++x) {
        const auto [r, g, b, a] = colour[x];
        sprite.pixels.push_back({std::min(r, a), std::min(g, a), std::min(b, a), a});
      }
      continue;
    }
    const Rgba* matte = &picture.at(left, height + y);
    for (int x = 0; x < sprite.width; ++x) {
      const std::uint8_t alpha = cleaned(matte[x].g);
      sprite.pixels.push_back({premultiplied(colour[x].r, alpha), premultiplied(colour[x].g, alpha),
                               premultiplied(colour[x].b, alpha), alpha});
    }
  }
  return sprite;
}

}  // namespace motex
