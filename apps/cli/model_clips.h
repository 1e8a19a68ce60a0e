// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion_io/read_options.h"
#include "motex/motion_texture/model.h"
#include "session.h"

namespace motex::cli {

/// Clips (or folders of them) at the model's frame rate, each as it is otherwise; a changed rate is said.
/// Throws InvalidInput for a rate below the model's or another skeleton.
std::vector<Clip> load_clips_for(const MotionTexture& model, const std::vector<std::string>& paths,
                                 const ReadClipOptions& read, Session& session);

}  // namespace motex::cli
