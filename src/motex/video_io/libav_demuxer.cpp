// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/libav_demuxer.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/mem.h>
}

#include <algorithm>
#include <new>

#include "motex/core/error.h"

namespace motex::libav {
namespace {

// Files that hold video themselves; no playlists or other formats that name further files.
constexpr const char* kFormats =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg,mpegvideo,yuv4mpegpipe,gif,apng,ogg,flv,live_flv,nut,h264,"
    "hevc,m4v,ivf,obu,av1,mjpeg,asf,mxf,dv,png_pipe,jpeg_pipe,bmp_pipe,tiff_pipe,webp_pipe,pgm_pipe,ppm_pipe,pam_pipe,"
    "tga_pipe,exr_pipe,dpx_pipe,qdraw_pipe,sgi_pipe";
constexpr int kBufferBytes = 1 << 16;

int read_callback(void* opaque, std::uint8_t* target, int num_bytes) {
  const std::int64_t got = static_cast<InputBytes*>(opaque)->read(reinterpret_cast<char*>(target), num_bytes);
  if (got < 0) return AVERROR(EIO);
  return got == 0 ? AVERROR_EOF : static_cast<int>(got);
}

std::int64_t seek_callback(void* opaque, std::int64_t offset, int whence) {
  auto& input = *static_cast<InputBytes*>(opaque);
  if (whence == AVSEEK_SIZE) return input.size();
  if (whence == SEEK_CUR) offset += input.position();
  if (whence == SEEK_END) offset += input.size();
  return input.seek(offset) ? offset : AVERROR(EINVAL);
}

int refuse_open(AVFormatContext*, AVIOContext**, const char*, int, AVDictionary**) { return AVERROR(EACCES); }

Handle<AVIOContext> make_io(InputBytes& input) {
  auto* buffer = static_cast<unsigned char*>(av_malloc(kBufferBytes));
  if (buffer == nullptr) throw std::bad_alloc();
  Handle<AVIOContext> io(avio_alloc_context(buffer, kBufferBytes, 0, &input, &read_callback, nullptr,
                                            input.size() < 0 ? nullptr : &seek_callback));
  if (io == nullptr) {
    av_free(buffer);
    throw std::bad_alloc();
  }
  return io;
}

/// An MP4 or MOV file keeps its index in a "moov" box that is often written last.
std::string why_unreadable(InputBytes& input, int code) {
  const std::string head = input.seek(0) ? peek(input, 12) : "";
  if (head.size() >= 8 && head.substr(4, 4) == "ftyp")
    return "is cut off or damaged: its index (moov) is missing, so that no frame can be read; copy or record it again";
  return "is no video that can be read (" + error_text(code) + ")";
}

/// VP8 keeps frames that are not shown as packets of their own.
bool is_shown(const AVPacket& packet, AVCodecID codec) {
  if ((packet.flags & AV_PKT_FLAG_DISCARD) != 0 || packet.size == 0) return false;
  return codec != AV_CODEC_ID_VP8 || (packet.data[0] >> 4 & 1) != 0;
}

}  // namespace

Demuxer::Demuxer(InputBytes& input, const std::string& name, const JobContext& job) : input_(input), job_(job) {
  silence();
  if (input.size() >= 0) input.seek(0);
  io_ = make_io(input_);
  format_ = avformat_alloc_context();
  if (format_ == nullptr) throw std::bad_alloc();
  format_->pb = io_.get();
  format_->io_open = &refuse_open;
  format_->format_whitelist = av_strdup(kFormats);
  format_->flags |= AVFMT_FLAG_CUSTOM_IO;
  // Known by its bytes alone: a name could stand for a numbered sequence. Frees format_ when it fails.
  int code = avformat_open_input(&format_, "", nullptr, nullptr);
  if (code < 0) throw UnsupportedFile(name + ": " + why_unreadable(input, code));
  code = avformat_find_stream_info(format_, nullptr);
  if (code >= 0) code = av_find_best_stream(format_, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (code < 0) {
    const bool has_sound = av_find_best_stream(format_, AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0) >= 0;
    avformat_close_input(&format_);
    throw UnsupportedFile(name + (has_sound ? ": has sound but no video" : ": has no video in it"));
  }
  stream_idx_ = code;
  for (unsigned i = 0; i < format_->nb_streams; ++i)
    if (static_cast<int>(i) != stream_idx_) format_->streams[i]->discard = AVDISCARD_ALL;
}

Demuxer::~Demuxer() { avformat_close_input(&format_); }

AVStream& Demuxer::stream() const { return *format_->streams[stream_idx_]; }

int Demuxer::read(AVPacket& packet) {
  for (;;) {
    job_.check_cancelled();
    av_packet_unref(&packet);
    const int code = av_read_frame(format_, &packet);
    if (code == AVERROR(EAGAIN)) continue;
    if (code < 0 || packet.stream_index == stream_idx_) return code;
  }
}

PacketTimes packet_times(Demuxer& demuxer) {
  const AVStream& stream = demuxer.stream();
  const double tick_secs = av_q2d(stream.time_base);
  const Handle<AVPacket> packet = new_packet();
  PacketTimes times;
  while (demuxer.read(*packet) >= 0) {
    if (!is_shown(*packet, stream.codecpar->codec_id)) continue;
    if (packet->pts == AV_NOPTS_VALUE) return {};
    times.shown.push_back(static_cast<double>(packet->pts) * tick_secs);
    if ((packet->flags & AV_PKT_FLAG_KEY) != 0) times.keys.push_back(times.shown.back());
  }
  std::sort(times.shown.begin(), times.shown.end());
  std::sort(times.keys.begin(), times.keys.end());
  return times;
}

}  // namespace motex::libav
