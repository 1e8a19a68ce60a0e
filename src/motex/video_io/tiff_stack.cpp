// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/tiff_stack.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <new>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kMaxPages = 65535;

std::uint32_t read_number(std::string_view bytes, std::size_t at, std::size_t size, bool big_endian) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < size; ++k)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (big_endian ? k : size - 1 - k)]);
  return value;
}

}  // namespace

int count_tiff_pages(std::string_view bytes) {
  if (bytes.size() < 8) return 0;
  const std::string_view mark = bytes.substr(0, 4);
  const bool big_endian = mark == std::string_view("MM\0*", 4);
  if (!big_endian && mark != std::string_view("II*\0", 4)) return 0;
  int num_pages = 0;
  std::size_t at = read_number(bytes, 4, 4, big_endian);
  while (at != 0 && at + 2 <= bytes.size() && num_pages < kMaxPages) {
    const std::size_t next = at + 2 + std::size_t{12} * read_number(bytes, at, 2, big_endian);
    if (next + 4 > bytes.size()) break;
    ++num_pages;
    at = read_number(bytes, next, 4, big_endian);
  }
  return num_pages;
}

TiffStack::TiffStack(std::string bytes, const std::string& name, double frames_per_sec, const JobContext& job)
    : bytes_(std::move(bytes)),
      job_(job),
      num_pages_(count_tiff_pages(bytes_)),
      frame_(libav::new_frame()),
      packet_(libav::new_packet()) {
  libav::silence();
  info_.name = name;
  const AVCodec* decoder = avcodec_find_decoder(AV_CODEC_ID_TIFF);
  codec_.reset(avcodec_alloc_context3(decoder));
  if (codec_ == nullptr) throw std::bad_alloc();
  codec_->max_pixels = std::int64_t{1} << 28;
  codec_->thread_count = 1;
  if (avcodec_open2(codec_.get(), decoder, nullptr) < 0 || !decode(0))
    throw UnsupportedFile(name + ": its first page cannot be decoded; save it as plain 8 or 16-bit TIFF");
  converter_.set_size(frame_->width, frame_->height, {});
  info_.container = "tiff stack";
  info_.codec = "tiff";
  const char* pixel_format = av_get_pix_fmt_name(static_cast<AVPixelFormat>(frame_->format));
  info_.pixel_format = pixel_format == nullptr ? "unknown" : pixel_format;
  info_.width = frame_->width;
  info_.height = frame_->height;
  info_.num_channels = libav::num_channels_of(frame_->format);
  info_.bit_depth = libav::bit_depth_of(frame_->format);
  info_.frames_per_sec = frames_per_sec;
  info_.num_frames_said = num_pages_;
  info_.duration_secs = num_pages_ / frames_per_sec;
}

bool TiffStack::decode(std::int64_t idx) {
  job_.check_cancelled();
  avcodec_flush_buffers(codec_.get());
  av_packet_unref(packet_.get());
  if (bytes_.size() > std::size_t{1} << 30 || av_new_packet(packet_.get(), static_cast<int>(bytes_.size())) < 0)
    throw UnsupportedFile(info_.name + ": TIFF files go up to 1 GiB; split it");
  std::copy(bytes_.begin(), bytes_.end(), packet_->data);
  av_opt_set_int(codec_->priv_data, "page", idx + 1, 0);
  if (avcodec_send_packet(codec_.get(), packet_.get()) < 0) return false;
  const bool decoded = avcodec_receive_frame(codec_.get(), frame_.get()) >= 0;
  return decoded && frame_->width > 0 && frame_->height > 0;
}

bool TiffStack::advance() {
  if (idx_ + 1 >= num_pages_) return false;
  if (!decode(idx_ + 1)) {
    job_.warn(info_.name + ": page " + std::to_string(idx_ + 1) + " of " + std::to_string(num_pages_) +
              " cannot be read; the pages before it are used");
    num_pages_ = static_cast<int>(idx_ + 1);
    return false;
  }
  if (frame_->width != info_.width || frame_->height != info_.height)
    throw InvalidInput(info_.name + ": page " + std::to_string(idx_ + 1) +
                       " has another size than the first; all must have one size");
  ++idx_;
  return true;
}

void TiffStack::to_image(Image& image) const { converter_.to_image(*frame_, image); }

void TiffStack::to_planes(Planes& planes) const {
  converter_.to_planes(*frame_, planes);
  if (static_cast<int>(planes.size()) != info_.num_channels)
    planes = motex::to_planes(motex::to_image(planes), info_.num_channels);
}

std::vector<double> TiffStack::frame_times() {
  std::vector<double> times(static_cast<std::size_t>(num_pages_));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / info_.frames_per_sec;
  return times;
}

}  // namespace motex
