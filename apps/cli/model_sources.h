// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion_texture/synthesize.h"
#include "motex/project/texton_span.h"
#include "value.h"

namespace motex::cli {

/// Where an instance lies in the clips that were learned from.
struct InstanceSource {
  std::string clip;
  Index start = 0;
  Index length = 0;
};
InstanceSource source_of(const MotionTexture& model, int instance_idx);

/// The examples that a synthesis used, as --json lists them.
Value played_value(const MotionTexture& model, const SynthesizeReport& report);
/// For the strip of pictures and pages; cut at num_frames.
std::vector<TextonSpan> played_spans(const MotionTexture& model, const SynthesizeReport& report, Index num_frames);

}  // namespace motex::cli
