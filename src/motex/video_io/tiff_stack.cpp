// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/tiff_stack.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/pixdesc.h>
}

#include <new>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr std::size_t kMaxPages = 65535;
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

std::uint32_t read_number(std::string_view bytes, std::size_t at, std::size_t size, bool big_endian) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < size; ++k)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (big_endian ? k : size - 1 - k)]);
  return value;
}

bool is_little_endian(std::string_view bytes) {
  return bytes.size() >= 8 && bytes.substr(0, 4) == std::string_view("II*\0", 4);
}
bool is_big_endian(std::string_view bytes) {
  return bytes.size() >= 8 && bytes.substr(0, 4) == std::string_view("MM\0*", 4);
}

void keep(void*, std::uint8_t*) {}

}  // namespace

std::vector<std::uint32_t> find_tiff_pages(std::string_view bytes) {
  if (!is_little_endian(bytes) && !is_big_endian(bytes)) return {};
  const bool big_endian = is_big_endian(bytes);
  std::vector<std::uint32_t> pages;
  std::uint32_t at = read_number(bytes, 4, 4, big_endian);
  while (at != 0 && std::size_t{at} + 2 <= bytes.size() && pages.size() < kMaxPages) {
    const std::size_t next = at + 2 + std::size_t{12} * read_number(bytes, at, 2, big_endian);
    if (next + 4 > bytes.size()) break;
    pages.push_back(at);
    at = read_number(bytes, next, 4, big_endian);
  }
  return pages;
}

TiffStack::TiffStack(std::string bytes, const std::string& name, double frames_per_sec, const JobContext& job)
    : bytes_(std::move(bytes)),
      job_(job),
      big_endian_(is_big_endian(bytes_)),
      pages_(find_tiff_pages(bytes_)),
      frame_(libav::new_frame()),
      packet_(libav::new_packet()) {
  libav::silence();
  info_.name = name;
  if (bytes_.size() > kMaxBytes) throw UnsupportedFile(name + ": TIFF files go up to 1 GiB; split it");
  bytes_.resize(bytes_.size() + AV_INPUT_BUFFER_PADDING_SIZE);
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
  info_.num_frames_said = static_cast<std::int64_t>(pages_.size());
  info_.duration_secs = static_cast<double>(pages_.size()) / frames_per_sec;
}

bool TiffStack::decode(std::int64_t idx) {
  job_.check_cancelled();
  if (idx >= static_cast<std::int64_t>(pages_.size())) return false;
  for (int k = 0; k < 4; ++k)
    bytes_[static_cast<std::size_t>(4 + k)] =
        static_cast<char>(pages_[static_cast<std::size_t>(idx)] >> 8 * (big_endian_ ? 3 - k : k) & 255);
  avcodec_flush_buffers(codec_.get());
  av_packet_unref(packet_.get());
  auto* data = reinterpret_cast<std::uint8_t*>(bytes_.data());
  packet_->buf = av_buffer_create(data, bytes_.size(), &keep, nullptr, AV_BUFFER_FLAG_READONLY);
  if (packet_->buf == nullptr) throw std::bad_alloc();
  packet_->data = data;
  packet_->size = static_cast<int>(bytes_.size() - AV_INPUT_BUFFER_PADDING_SIZE);
  if (avcodec_send_packet(codec_.get(), packet_.get()) < 0) return false;
  const bool decoded = avcodec_receive_frame(codec_.get(), frame_.get()) >= 0;
  return decoded && frame_->width > 0 && frame_->height > 0;
}

bool TiffStack::advance() {
  if (idx_ + 1 >= static_cast<std::int64_t>(pages_.size())) return false;
  if (!decode(idx_ + 1)) {
    job_.warn(info_.name + ": page " + std::to_string(idx_ + 1) + " of " + std::to_string(pages_.size()) +
              " cannot be read; the pages before it are used");
    pages_.resize(static_cast<std::size_t>(idx_ + 1));
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
  std::vector<double> times(pages_.size());
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / info_.frames_per_sec;
  return times;
}

}  // namespace motex
