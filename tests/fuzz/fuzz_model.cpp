// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/project/motion_texture_file.h"
#include "round_trip.h"
#include "sealed_archive.h"

namespace motex {
namespace {

/// A model that is read and written back unchanged dances and recognises without crash, or says why not.
void try_model(const std::string& bytes) {
  std::optional<MotionTexture> read = round_trip(bytes, parse_motion_texture, motion_texture_bytes);
  if (!read) return;
  if (bytes.size() > 100'000) return;
  try {
    const MotionTexture model = apply_edits(*std::move(read));
    SynthesizeReport report;
    const Clip clip = synthesize_motion(model, 50, {}, {}, report);
    segment_clip(model, clip);
    score_clips(model, {&clip, 1});
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace motex

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  motex::try_model(motex::sealed_archive(data, size));
  return 0;
}
