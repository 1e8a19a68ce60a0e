// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/people/silhouette.h"
#include "motex/people/sprite.h"
#include "motex/video_io/video_reader.h"

namespace motex {

/// Up to kChunkFrames sprites as a video of their own.
struct FilmChunk {
  BoundingBox canvas;                        ///< what of the frame the video shows; all sprites lie inside
  std::shared_ptr<const std::string> video;  ///< null when nobody is there all the while
};

constexpr int kChunkFrames = 60;
/// A side of a canvas that can be stored is at most that long, pixels.
constexpr int kMaxCanvasSide = 8000;

/// The sprites of one take inside a model, chunk by chunk: H.264 with the colours in the upper half and the matte,
/// grey, in the lower one; or, lossless, FFV1 with the premultiplied colours and alpha as they are.
struct TakeFilm {
  bool lossless = false;
  std::vector<BoundingBox> boxes;  ///< of every sprite, pixels of the frame; empty when nobody is there
  std::vector<FilmChunk> chunks;   ///< chunk k holds frames k · kChunkFrames …
};

/// Stores sprites one after another. Beyond the edge of the actor colours go on smoothly, so that neither the codec nor
/// its coarser colour planes darken the rim. Memory: that of a chunk's sprites.
class TakeFilmWriter {
 public:
  TakeFilmWriter(double frames_per_sec, bool lossless, const JobContext& job = {});
  /// The next frame's. Throws InvalidInput when it is larger than kMaxCanvasSide.
  void add(const Sprite& sprite);
  TakeFilm finish();

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<float> values;  // R, G, B times alpha, alpha; 0 … 255
  };
  void write_chunk();
  void prepare(const BoundingBox& canvas);
  void draw_stacked(const Sprite& sprite);
  void draw_plain(const Sprite& sprite);
  void fill_pyramid(const Sprite& sprite);

  TakeFilm film_;
  double frames_per_sec_;
  JobContext job_;
  std::vector<Sprite> waiting_;
  std::size_t num_waiting_ = 0;
  BoundingBox canvas_;
  Image picture_;
  std::vector<Level> levels_;
};

/// Reads a chunk again, rising order cheapest, any order at the cost of at most 15 frames. Not thread-safe.
class FilmChunkReader {
 public:
  /// The chunk must have a video. Throws InvalidInput when that is of another size than the chunk says.
  FilmChunkReader(const FilmChunk& chunk, bool lossless);
  /// frame: of the chunk, in the box. Throws InvalidInput when the video has fewer frames.
  Sprite read(int frame, const BoundingBox& box);

 private:
  Sprite cut_out(const Image& picture, const BoundingBox& box) const;

  FilmChunk chunk_;
  bool lossless_;
  VideoReader reader_;
  VideoFrame frame_;
  int next_ = 0;
};

}  // namespace motex
