// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/video_io/libav_handles.h"

namespace motex::libav {

/// Pictures on one side of a scaler.
struct ScaledPixels {
  int width = 0, height = 0;
  int format = 0;           ///< an AVPixelFormat
  int chroma_location = 0;  ///< an AVChromaLocation, or any number that a file says: where samples of colour lie
};

/// Where samples of colour are fewer than pixels they lie where `chroma_location` says; where it says nothing, on the
/// left ones of their pixels and between rows, as in MPEG-2 and H.264. (libswscale by itself takes them to lie in the
/// middle, which moves colours by half a pixel.) Null when there is no such scaler. Throws std::bad_alloc.
Handle<SwsContext> new_scaler(const ScaledPixels& source, const ScaledPixels& target, int flags);

}  // namespace motex::libav
