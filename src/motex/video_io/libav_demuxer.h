// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/video_io/input_bytes.h"
#include "motex/video_io/libav_handles.h"

struct AVStream;

namespace motex::libav {

/// A container opened for reading its best video stream; everything is read through `input`, no other file or address.
class Demuxer {
 public:
  /// Throws UnsupportedFile: no container that is known, none of its index left, no video in it.
  Demuxer(InputBytes& input, const std::string& name, const JobContext& job);
  ~Demuxer();
  Demuxer(const Demuxer&) = delete;
  Demuxer& operator=(const Demuxer&) = delete;

  AVFormatContext& format() const { return *format_; }
  AVStream& stream() const;
  /// Next packet of the stream: 0, or the error code of the library. Throws Cancelled.
  int read(AVPacket& packet);

 private:
  InputBytes& input_;
  JobContext job_;
  Handle<AVIOContext> io_;
  AVFormatContext* format_ = nullptr;
  int stream_idx_ = -1;
};

struct PacketTimes {
  std::vector<double> shown;  ///< of all shown frames, seconds (absolute), rising
  std::vector<double> keys;   ///< of those at which decoding can begin
};

/// By the time stamps of the packets; empty when some packet has none. Throws Cancelled.
PacketTimes packet_times(Demuxer& demuxer);

}  // namespace motex::libav
