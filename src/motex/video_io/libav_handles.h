// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

struct AVCodecContext;
struct AVFormatContext;
struct AVFrame;
struct AVIOContext;
struct AVPacket;
struct SwsContext;

namespace motex::libav {

struct Deleter {
  void operator()(AVCodecContext* codec) const;
  void operator()(AVFrame* frame) const;
  void operator()(AVPacket* packet) const;
  void operator()(SwsContext* scaler) const;
  void operator()(AVIOContext* stream) const;
};
template <typename T>
using Handle = std::unique_ptr<T, Deleter>;

/// Nothing is printed by the codecs; to be called before anything else.
void silence();
/// "Invalid data found when processing input".
std::string error_text(int code);

/// Throws std::bad_alloc.
Handle<AVFrame> new_frame();
Handle<AVPacket> new_packet();

}  // namespace motex::libav
