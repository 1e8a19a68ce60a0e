// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "motex/core/error.h"
#include "motex/video_io/video_reader.h"

// Whatever the bytes are, the reader gives frames of the size that it announced and rising times, or throws.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  motex::JobContext job;
  job.jobs = 1;
  try {
    auto reader = motex::VideoReader::from_bytes({reinterpret_cast<const char*>(data), size}, "fuzz.mp4", job);
    double last = -1;
    motex::VideoFrame frame;
    for (int num = 0; num < 20 && reader.next(frame); ++num) {
      if (frame.image.width != reader.info().width || frame.image.height != reader.info().height) std::abort();
      if (!(frame.time_secs > last)) std::abort();
      last = frame.time_secs;
    }
  } catch (const motex::InvalidInput&) {
  }
  return 0;
}
