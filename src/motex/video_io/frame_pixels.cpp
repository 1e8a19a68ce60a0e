// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/frame_pixels.h"

extern "C" {
#include <libavutil/display.h>
#include <libavutil/frame.h>
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "motex/core/error.h"
#include "motex/video_io/scaler.h"

namespace motex::libav {
namespace {

/// A damaged file may say a colour space or range that the enumeration does not have; as a number it may be compared.
template <class Enumeration>
int number_said(const Enumeration& said) {
  int number = 0;
  static_assert(sizeof said == sizeof number);
  std::memcpy(&number, &said, sizeof number);
  return number;
}

int matrix_of(const AVFrame& frame) {
  switch (number_said(frame.colorspace)) {
    case AVCOL_SPC_BT709:
      return SWS_CS_ITU709;
    case AVCOL_SPC_FCC:
      return SWS_CS_FCC;
    case AVCOL_SPC_SMPTE240M:
      return SWS_CS_SMPTE240M;
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL:
      return SWS_CS_BT2020;
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
      return SWS_CS_ITU601;
    default:
      return frame.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;
  }
}

/// The formats whose name says "full range" are the plain ones with the range said.
AVPixelFormat plain_format(AVPixelFormat format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    case AV_PIX_FMT_YUVJ440P:
      return AV_PIX_FMT_YUV440P;
    case AV_PIX_FMT_YUVJ411P:
      return AV_PIX_FMT_YUV411P;
    default:
      return format;
  }
}

bool is_full_range(const AVFrame& frame) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  const int said = number_said(frame.color_range);
  if (plain_format(format) != format || said == AVCOL_RANGE_JPEG) return true;
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  const bool is_rgb = description != nullptr && (description->flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL)) != 0;
  if (is_rgb) return true;
  return description != nullptr && description->nb_components <= 2 && said != AVCOL_RANGE_MPEG;
}

/// Pictures of full range are JPEG's kin, whose samples of colour lie in the middle unless something else is said.
int chroma_location_of(const AVFrame& frame) {
  const int said = number_said(frame.chroma_location);
  return said == AVCHROMA_LOC_UNSPECIFIED && is_full_range(frame) ? AVCHROMA_LOC_CENTER : said;
}

/// Where the pixel shown at (x, y) of the turned picture is stored in one of width × height.
struct Turning {
  Orientation orientation;
  int width, height;  ///< as stored
  std::size_t operator()(int x, int y) const {
    int u = x, v = y;
    if (orientation.quarter_turns == 1) u = y, v = height - 1 - x;
    if (orientation.quarter_turns == 2) u = width - 1 - x, v = height - 1 - y;
    if (orientation.quarter_turns == 3) u = width - 1 - y, v = x;
    if (orientation.mirrored) u = width - 1 - u;
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  int shown_width() const { return orientation.quarter_turns % 2 == 0 ? width : height; }
  int shown_height() const { return orientation.quarter_turns % 2 == 0 ? height : width; }
};

float level_at(const std::uint8_t* bytes) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<float>(value) / 257.0F;
}

constexpr AVPixelFormat kGrey16 =
    std::endian::native == std::endian::little ? AV_PIX_FMT_GRAY16LE : AV_PIX_FMT_GRAY16BE;
constexpr AVPixelFormat kRgba16 =
    std::endian::native == std::endian::little ? AV_PIX_FMT_RGBA64LE : AV_PIX_FMT_RGBA64BE;

}  // namespace

Orientation orientation_of(const void* display_matrix) {
  if (display_matrix == nullptr) return {};
  std::array<std::int32_t, 9> m{};
  std::memcpy(m.data(), display_matrix, sizeof m);
  // (x, y) → (m₀ x + m₃ y, m₁ x + m₄ y): a negative determinant mirrors.
  const std::int64_t determinant =
      static_cast<std::int64_t>(m[0]) * m[4] / 65536 - static_cast<std::int64_t>(m[1]) * m[3] / 65536;
  Orientation out;
  out.mirrored = determinant < 0;
  if (out.mirrored) m[0] = -m[0], m[1] = -m[1];
  if (std::abs(static_cast<double>(m[0])) >= std::abs(static_cast<double>(m[1])))
    out.quarter_turns = m[0] < 0 ? 2 : 0;
  else
    out.quarter_turns = m[1] > 0 ? 1 : 3;
  return out;
}

void PixelConverter::set_size(int width, int height, Orientation orientation) {
  width_ = width;
  height_ = height;
  orientation_ = orientation;
}

void PixelConverter::convert(const AVFrame& frame, int format, int bytes_per_pixel) {
  const AVPixelFormat source = plain_format(static_cast<AVPixelFormat>(frame.format));
  const int matrix = matrix_of(frame), range = is_full_range(frame) ? 1 : 0;
  const int siting = chroma_location_of(frame);
  const int wanted[9] = {source, frame.width, frame.height, siting, matrix, range, format, width_, height_};
  if (scaler_ == nullptr || !std::equal(std::begin(wanted), std::end(wanted), made_for_)) {
    constexpr int kFlags = SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT;
    const bool reduces = frame.width >= 2 * width_ && frame.height >= 2 * height_;
    scaler_ = new_scaler({frame.width, frame.height, source, siting}, {width_, height_, format},
                         kFlags | (reduces ? SWS_AREA : SWS_BICUBIC));
    if (scaler_ == nullptr)
      throw UnsupportedFile(std::string("pixels of the kind ") + av_get_pix_fmt_name(source) + " cannot be read");
    sws_setColorspaceDetails(scaler_.get(), sws_getCoefficients(matrix), range, sws_getCoefficients(matrix), 1, 0,
                             1 << 16, 1 << 16);
    std::copy(std::begin(wanted), std::end(wanted), made_for_);
  }
  const int stride = (width_ * bytes_per_pixel + 63) / 64 * 64;
  buffer_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height_) + 64);
  std::uint8_t* const target[4] = {buffer_.data(), nullptr, nullptr, nullptr};
  const int strides[4] = {stride, 0, 0, 0};
  if (sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, target, strides) != height_)
    throw NumericalFailure("the colours of a frame could not be converted");
  const std::size_t row = static_cast<std::size_t>(width_) * static_cast<std::size_t>(bytes_per_pixel);
  for (int y = 1; y < height_; ++y)
    std::memmove(buffer_.data() + static_cast<std::size_t>(y) * row,
                 buffer_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(stride), row);
}

void PixelConverter::to_image(const AVFrame& frame, Image& image) {
  if (bit_depth_of(frame.format) > 8) {  // rounded here, because the scaler would dither
    Planes planes;
    to_planes(frame, planes);
    image = motex::to_image(planes);
    return;
  }
  convert(frame, AV_PIX_FMT_RGBA, 4);
  const Turning turning{orientation_, width_, height_};
  image.width = turning.shown_width();
  image.height = turning.shown_height();
  image.pixels.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  const bool has_alpha = num_channels_of(frame.format) == 4;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = buffer_.data() + 4 * turning(x, y);
      image.at(x, y) = {p[0], p[1], p[2], has_alpha ? p[3] : std::uint8_t{255}};
    }
}

void PixelConverter::to_planes(const AVFrame& frame, Planes& planes) {
  const int num_channels = num_channels_of(frame.format);
  if (bit_depth_of(frame.format) <= 8) {
    Image image;
    to_image(frame, image);
    planes = motex::to_planes(image, num_channels);
    return;
  }
  const int bytes_per_pixel = num_channels == 1 ? 2 : 8;
  convert(frame, num_channels == 1 ? kGrey16 : kRgba16, bytes_per_pixel);
  const Turning turning{orientation_, width_, height_};
  planes.assign(static_cast<std::size_t>(num_channels), Plane(turning.shown_width(), turning.shown_height()));
  for (int y = 0; y < turning.shown_height(); ++y)
    for (int x = 0; x < turning.shown_width(); ++x) {
      const std::uint8_t* p = buffer_.data() + static_cast<std::size_t>(bytes_per_pixel) * turning(x, y);
      for (std::size_t k = 0; k < planes.size(); ++k) planes[k].at(x, y) = level_at(p + 2 * k);
    }
}

int num_channels_of(int pixel_format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(pixel_format));
  if (description == nullptr) return 3;
  if ((description->flags & AV_PIX_FMT_FLAG_ALPHA) != 0) return 4;
  if ((description->flags & AV_PIX_FMT_FLAG_PAL) != 0) return 4;
  return description->nb_components == 1 ? 1 : 3;
}

bool has_coarse_colour(int pixel_format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(pixel_format));
  return description != nullptr && description->log2_chroma_w > 0 && description->log2_chroma_h > 0;
}

int bit_depth_of(int pixel_format) {
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(pixel_format));
  return description == nullptr || (description->flags & AV_PIX_FMT_FLAG_PAL) != 0 ? 8 : description->comp[0].depth;
}

}  // namespace motex::libav
