// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/scaler.h"

extern "C" {
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <new>
#include <string>

namespace motex::libav {
namespace {

/// Of the first sample of colour, in half of the way from the first pixel to the last one that shares it.
struct Siting {
  int across = 0, down = 1;
};

Siting siting_of(int chroma_location) {
  switch (chroma_location) {
    case AVCHROMA_LOC_CENTER:
      return {1, 1};
    case AVCHROMA_LOC_TOPLEFT:
      return {0, 0};
    case AVCHROMA_LOC_TOP:
      return {1, 0};
    case AVCHROMA_LOC_BOTTOMLEFT:
      return {0, 2};
    case AVCHROMA_LOC_BOTTOM:
      return {1, 2};
    default:
      return {0, 1};
  }
}

void set(SwsContext& scaler, const std::string& name, int value) { av_opt_set_int(&scaler, name.c_str(), value, 0); }

void set_side(SwsContext& scaler, const std::string& side, const ScaledPixels& pixels) {
  set(scaler, side + "w", pixels.width);
  set(scaler, side + "h", pixels.height);
  set(scaler, side + "_format", pixels.format);
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(pixels.format));
  if (description == nullptr) return;
  constexpr int kHalfPixel = 128;
  const auto reach = [](int log2) { return kHalfPixel * ((1 << log2) - 1); };
  const Siting siting = siting_of(pixels.chroma_location);
  set(scaler, side + "_h_chr_pos", siting.across * reach(description->log2_chroma_w));
  set(scaler, side + "_v_chr_pos", siting.down * reach(description->log2_chroma_h));
}

}  // namespace

Handle<SwsContext> new_scaler(const ScaledPixels& source, const ScaledPixels& target, int flags) {
  Handle<SwsContext> scaler(sws_alloc_context());
  if (scaler == nullptr) throw std::bad_alloc();
  set_side(*scaler, "src", source);
  set_side(*scaler, "dst", target);
  set(*scaler, "sws_flags", flags);
  if (sws_init_context(scaler.get(), nullptr, nullptr) < 0) return nullptr;
  return scaler;
}

}  // namespace motex::libav
