// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/libav_handles.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avio.h>
#include <libavutil/log.h>
#include <libswscale/swscale.h>
}

#include <new>

namespace motex::libav {

void Deleter::operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
void Deleter::operator()(AVFrame* frame) const { av_frame_free(&frame); }
void Deleter::operator()(AVPacket* packet) const { av_packet_free(&packet); }
void Deleter::operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
void Deleter::operator()(AVIOContext* stream) const {
  av_freep(static_cast<void*>(&stream->buffer));
  avio_context_free(&stream);
}

void silence() { av_log_set_level(AV_LOG_QUIET); }

std::string error_text(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = "";
  av_strerror(code, text, sizeof text);
  return text;
}

Handle<AVFrame> new_frame() {
  Handle<AVFrame> frame(av_frame_alloc());
  if (frame == nullptr) throw std::bad_alloc();
  return frame;
}

Handle<AVPacket> new_packet() {
  Handle<AVPacket> packet(av_packet_alloc());
  if (packet == nullptr) throw std::bad_alloc();
  return packet;
}

}  // namespace motex::libav
