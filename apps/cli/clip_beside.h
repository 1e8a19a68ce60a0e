// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/motion_io/read_options.h"
#include "motex/motion_texture/choreograph.h"
#include "session.h"

namespace motex::cli {

/// "walk.bvh@120". Throws InvalidInput naming the flag.
ClipFrame parse_clip_frame(const std::string& flag, const std::string& text);

enum class Beside { kUpTo, kFrom };

/// The clip up to and with a frame, or from it on, at the model's rate and in its unit. at.clip names a file or a clip
/// of the model; the frame counts in the file as it is, and is hit exactly when the rate is changed. Throws
/// InvalidInput.
Clip clip_beside(const MotionTexture& model, const ClipFrame& at, Beside side, const ReadClipOptions& read,
                 Session& session);

}  // namespace motex::cli
