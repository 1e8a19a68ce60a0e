// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/backdrop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motex/image/planes.h"
#include "motex/image/resize.h"

namespace motex {

Image fitted(const Image& picture, int width, int height) {
  if (picture.width == width && picture.height == height) return picture;
  const double shape = static_cast<double>(width) / height;
  int wide = picture.width, high = picture.height;
  if (wide > shape * high)
    wide = std::max(1, static_cast<int>(std::lround(shape * high)));
  else
    high = std::max(1, static_cast<int>(std::lround(wide / shape)));
  const Image middle = crop(picture, (picture.width - wide) / 2, (picture.height - high) / 2, wide, high);
  return to_image(resized(to_planes(middle, 3), width, height));
}

Backdrop::Backdrop(Rgba colour, int width, int height)
    : width_(width), height_(height), image_(width, height, {colour.r, colour.g, colour.b, 255}) {}

Backdrop::Backdrop(const std::filesystem::path& path, int width, int height, const JobContext& job)
    : width_(width), height_(height), path_(path), job_(job) {
  reader_.emplace(path_, ReadVideoOptions{}, job_);
  read_next();
}

bool Backdrop::read_next() {
  VideoFrame frame;
  if (!reader_->next(frame)) return false;
  for (Rgba& pixel : frame.image.pixels) pixel = mix({0, 0, 0, 255}, {pixel.r, pixel.g, pixel.b, 255}, pixel.a / 255.0);
  image_ = fitted(frame.image, width_, height_);
  ++next_;
  return true;
}

const Image& Backdrop::frame(std::int64_t idx) {
  while (reader_ && next_ <= idx) {
    if (read_next()) continue;
    if (next_ <= 1) {
      reader_.reset();  // one picture
      break;
    }
    // From the beginning: what was counted stays counted.
    JobContext quiet = job_;
    quiet.on_warning = nullptr;
    reader_.emplace(path_, ReadVideoOptions{}, quiet);
  }
  return image_;
}

}  // namespace motex
