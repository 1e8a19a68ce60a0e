// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/mem.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>

#include "motex/core/error.h"
#include "motex/core/extension.h"
#include "motex/core/files.h"
#include "motex/video_io/frame_sink.h"
#include "motex/video_io/libav_handles.h"
#include "motex/video_io/scaler.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

using libav::error_text;
using libav::Handle;
using libav::new_frame;
using libav::new_packet;
using libav::silence;

// Fixed: the bytes of some encoders depend on it.
constexpr int kNumThreads = 4;
constexpr int kBufferBytes = 1 << 16;
constexpr AVRational kTick{1, 90000};

struct Recipe {
  const char* extension;
  const char* muxer;
  const char* encoder;
  AVPixelFormat opaque, with_alpha, odd_sized;
  const char* settings;           ///< of the encoder, "name=value:…"
  const char* storing = nullptr;  ///< the same where frames are stored to be picked out again
};

// libx264's macroblock tree reads memory that nobody wrote: bytes would differ from run to run.
constexpr Recipe kRecipes[] = {
    {".mp4", "mp4", "libx264", AV_PIX_FMT_YUV420P, AV_PIX_FMT_NONE, AV_PIX_FMT_YUV444P, "crf=18:preset=medium:mbtree=0",
     "crf=10:preset=veryfast:mbtree=0:g=15:aq-mode=0:psy=0"},
    {".webm", "webm", "libvpx-vp9", AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUVA420P, AV_PIX_FMT_NONE,
     "crf=18:b=0:deadline=good:cpu-used=4:auto-alt-ref=0"},
    {".mov", "mov", "prores_ks", AV_PIX_FMT_YUV444P10LE, AV_PIX_FMT_YUVA444P10LE, AV_PIX_FMT_NONE,
     "profile=4444:alpha_bits=16:vendor=apl0"},
    {".mkv", "matroska", "ffv1", AV_PIX_FMT_BGR0, AV_PIX_FMT_BGRA, AV_PIX_FMT_NONE, "level=3:slices=4:slicecrc=1"},
    {".avi", "avi", "mjpeg", AV_PIX_FMT_YUVJ444P, AV_PIX_FMT_NONE, AV_PIX_FMT_NONE, "qmin=2:qmax=2"},
};

const Recipe& recipe_for(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  for (const Recipe& recipe : kRecipes)
    if (extension == recipe.extension) return recipe;
  throw UnsupportedFile(path.string() + ": the name of a video ends in .mp4, .webm, .mov, .mkv or .avi");
}

/// Where the muxer writes: an AtomicFile or memory. Exceptions wait until the C code has returned.
struct Output {
  std::unique_ptr<AtomicFile> file;  // null: memory
  std::string bytes;
  std::uint64_t position = 0, size = 0;
  std::exception_ptr failure;

  void put(std::string_view part) {
    if (file != nullptr) return file->write(part);
    if (bytes.size() < position + part.size()) bytes.resize(position + part.size());
    std::copy(part.begin(), part.end(), bytes.begin() + static_cast<std::ptrdiff_t>(position));
  }
  bool move_to(std::uint64_t target) { return file != nullptr ? file->seek(target) : target <= bytes.size(); }

  static int write(void* opaque, std::uint8_t* bytes, int num_bytes) {
    auto& self = *static_cast<Output*>(opaque);
    try {
      self.put({reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(num_bytes)});
    } catch (...) {
      self.failure = std::current_exception();
      return AVERROR(EIO);
    }
    self.position += static_cast<std::uint64_t>(num_bytes);
    self.size = std::max(self.size, self.position);
    return num_bytes;
  }
  static std::int64_t seek(void* opaque, std::int64_t offset, int whence) {
    auto& self = *static_cast<Output*>(opaque);
    if (whence == AVSEEK_SIZE) return static_cast<std::int64_t>(self.size);
    if (whence == SEEK_CUR) offset += static_cast<std::int64_t>(self.position);
    if (whence == SEEK_END) offset += static_cast<std::int64_t>(self.size);
    if (offset < 0 || !self.move_to(static_cast<std::uint64_t>(offset))) return AVERROR(EINVAL);
    self.position = static_cast<std::uint64_t>(offset);
    return offset;
  }
};

struct FormatCloser {
  void operator()(AVFormatContext* format) const { avformat_free_context(format); }
};

class LibavSink : public FrameSink {
 public:
  /// bytes: null = a file.
  LibavSink(const std::filesystem::path& path, const SinkShape& shape, const JobContext& job, std::string* bytes)
      : path_(path), shape_(shape), job_(job), recipe_(recipe_for(path)), bytes_(bytes) {
    if (bytes == nullptr) output_.file = std::make_unique<AtomicFile>(path);
    silence();
    format_of_pixels_ = shape.alpha ? recipe_.with_alpha : recipe_.opaque;
    if (format_of_pixels_ == AV_PIX_FMT_NONE)
      throw InvalidInput(path.string() + ": " + recipe_.extension + " cannot keep alpha; write .mov, .webm or .mkv");
    const bool odd = shape.width % 2 != 0 || shape.height % 2 != 0;
    if (odd && recipe_.odd_sized != AV_PIX_FMT_NONE) {
      format_of_pixels_ = recipe_.odd_sized;
      job_.warn(path.string() + ": the size is odd, so the video is 4:4:4, which some players do not show");
    }
    open_encoder();
    open_muxer();
    make_scaler();
  }

  void write(const Image& image, double time_secs) override {
    check(av_frame_make_writable(frame_.get()), "a frame");
    const std::uint8_t* const source[4] = {reinterpret_cast<const std::uint8_t*>(image.pixels.data()), nullptr, nullptr,
                                           nullptr};
    const int strides[4] = {4 * image.width, 0, 0, 0};
    sws_scale(scaler_.get(), source, strides, 0, image.height, frame_->data, frame_->linesize);
    frame_->pts = std::llround(time_secs / av_q2d(encoder_->time_base));
    const double error_secs = static_cast<double>(frame_->pts) * av_q2d(encoder_->time_base) - time_secs;
    if (std::abs(error_secs) > 0.01 / shape_.frames_per_sec && is_constant_rate())
      throw InvalidInput(path_.string() + ": " + recipe_.extension +
                         " has one frame rate, and these times have not; write .mp4 or .mkv");
    encode(frame_.get());
  }

  void finish() override {
    encode(nullptr);
    check(av_write_trailer(muxer_.get()), "the end of the file");
    avio_flush(io_.get());
    if (output_.failure) std::rethrow_exception(output_.failure);
    if (bytes_ != nullptr)
      *bytes_ = std::move(output_.bytes);
    else
      output_.file->commit();
  }

 private:
  bool is_constant_rate() const { return std::strcmp(recipe_.muxer, "avi") == 0; }

  void check(int code, const char* what) {
    if (output_.failure) std::rethrow_exception(output_.failure);
    if (code < 0) throw WriteError(path_.string() + ": writing " + what + " failed: " + error_text(code));
  }

  void open_encoder() {
    const AVCodec* encoder = avcodec_find_encoder_by_name(recipe_.encoder);
    if (encoder == nullptr)
      throw UnsupportedFile(path_.string() + ": this system's libav has no encoder " + recipe_.encoder +
                            "; write .mkv");
    encoder_.reset(avcodec_alloc_context3(encoder));
    if (encoder_ == nullptr) throw std::bad_alloc();
    const AVRational rate = av_d2q(shape_.frames_per_sec, 60060);
    encoder_->width = shape_.width;
    encoder_->height = shape_.height;
    encoder_->pix_fmt = format_of_pixels_;
    encoder_->framerate = rate;
    encoder_->time_base = is_constant_rate() ? av_inv_q(rate) : kTick;
    encoder_->sample_aspect_ratio = av_d2q(shape_.pixel_aspect, 4096);
    encoder_->thread_count = kNumThreads;
    encoder_->flags |= AV_CODEC_FLAG_BITEXACT;
    const AVOutputFormat* muxer = av_guess_format(recipe_.muxer, nullptr, nullptr);
    if (muxer != nullptr && (muxer->flags & AVFMT_GLOBALHEADER) != 0) encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    mark_colours();
    AVDictionary* settings = nullptr;
    const bool tiny = std::min(shape_.width, shape_.height) < 16 && is_rgb();  // FFV1 finds no room for slices there
    const char* text = shape_.for_storage && recipe_.storing != nullptr ? recipe_.storing : recipe_.settings;
    av_dict_parse_string(&settings, tiny ? "level=1" : text, "=", ":", 0);
    const int code = avcodec_open2(encoder_.get(), encoder, &settings);
    av_dict_free(&settings);
    if (code < 0)
      throw InvalidInput(path_.string() + ": " + recipe_.encoder + " takes no frames of " +
                         std::to_string(shape_.width) + " × " + std::to_string(shape_.height) + " pixels (" +
                         error_text(code) + ")");
  }

  bool is_rgb() const { return format_of_pixels_ == AV_PIX_FMT_BGR0 || format_of_pixels_ == AV_PIX_FMT_BGRA; }

  void mark_colours() {
    if (is_rgb()) return;
    encoder_->color_range = is_constant_rate() ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    encoder_->colorspace = is_constant_rate() ? AVCOL_SPC_BT470BG : AVCOL_SPC_BT709;
    encoder_->color_primaries = AVCOL_PRI_BT709;
    encoder_->color_trc = AVCOL_TRC_BT709;
    encoder_->chroma_sample_location = AVCHROMA_LOC_LEFT;
  }

  void open_muxer() {
    AVFormatContext* format = nullptr;
    check(avformat_alloc_output_context2(&format, nullptr, recipe_.muxer, nullptr), "the header");
    muxer_.reset(format);
    auto* buffer = static_cast<unsigned char*>(av_malloc(kBufferBytes));
    if (buffer == nullptr) throw std::bad_alloc();
    io_.reset(avio_alloc_context(buffer, kBufferBytes, 1, &output_, nullptr, &Output::write, &Output::seek));
    if (io_ == nullptr) throw std::bad_alloc();
    muxer_->pb = io_.get();
    muxer_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
    stream_ = avformat_new_stream(muxer_.get(), nullptr);
    if (stream_ == nullptr) throw std::bad_alloc();
    check(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()), "the header");
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    if (shape_.pixel_aspect != 1) stream_->sample_aspect_ratio = encoder_->sample_aspect_ratio;
    if (shape_.alpha) av_dict_set(&stream_->metadata, "alpha_mode", "1", 0);
    check(avformat_write_header(muxer_.get(), nullptr), "the header");
  }

  void make_scaler() {
    frame_ = new_frame();
    packet_ = new_packet();
    frame_->format = format_of_pixels_;
    frame_->width = shape_.width;
    frame_->height = shape_.height;
    frame_->color_range = encoder_->color_range;
    frame_->colorspace = encoder_->colorspace;
    check(av_frame_get_buffer(frame_.get(), 0), "a frame");
    constexpr int kFlags = SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT;
    const AVPixelFormat target = format_of_pixels_ == AV_PIX_FMT_YUVJ444P ? AV_PIX_FMT_YUV444P : format_of_pixels_;
    scaler_ = libav::new_scaler({shape_.width, shape_.height, AV_PIX_FMT_RGBA},
                                {shape_.width, shape_.height, target, encoder_->chroma_sample_location}, kFlags);
    if (scaler_ == nullptr) throw NumericalFailure(path_.string() + ": the colours cannot be converted");
    const int* matrix = sws_getCoefficients(is_constant_rate() ? SWS_CS_ITU601 : SWS_CS_ITU709);
    sws_setColorspaceDetails(scaler_.get(), matrix, 1, matrix, is_rgb() || is_constant_rate() ? 1 : 0, 0, 1 << 16,
                             1 << 16);
  }

  /// null = what is still inside the encoder.
  void encode(const AVFrame* frame) {
    check(avcodec_send_frame(encoder_.get(), frame), "a frame");
    for (;;) {
      job_.check_cancelled();
      const int code = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      check(code, "a frame");
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
      packet_->stream_index = 0;
      check(av_interleaved_write_frame(muxer_.get(), packet_.get()), "a frame");
    }
  }

  std::filesystem::path path_;
  SinkShape shape_;
  JobContext job_;
  const Recipe& recipe_;
  std::string* bytes_;
  Output output_;
  AVPixelFormat format_of_pixels_ = AV_PIX_FMT_NONE;
  Handle<AVIOContext> io_;
  std::unique_ptr<AVFormatContext, FormatCloser> muxer_;
  AVStream* stream_ = nullptr;
  Handle<AVCodecContext> encoder_;
  Handle<AVFrame> frame_;
  Handle<AVPacket> packet_;
  Handle<SwsContext> scaler_;
};

}  // namespace

std::unique_ptr<FrameSink> make_libav_sink(const std::filesystem::path& path, const SinkShape& shape,
                                           const JobContext& job) {
  return std::make_unique<LibavSink>(path, shape, job, nullptr);
}

std::unique_ptr<FrameSink> make_libav_sink(std::string& bytes, const std::string& name, const SinkShape& shape,
                                           const JobContext& job) {
  return std::make_unique<LibavSink>(name, shape, job, &bytes);
}

std::vector<std::string> missing_video_encoders() {
  std::vector<std::string> missing;
  for (const Recipe& recipe : kRecipes)
    if (avcodec_find_encoder_by_name(recipe.encoder) == nullptr)
      missing.push_back(std::string(recipe.extension) + " (" + recipe.encoder + ")");
  return missing;
}

std::string libav_release() { return av_version_info(); }

}  // namespace motex
