// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/project/model_file.h"
#include "sealed_archive.h"

namespace motex {
namespace {

/// Whatever the bytes are, the reader returns a model or throws; a model that it returns can be written and read again
/// as the same bytes, dances and recognises without crash, or says why not.
void try_model(const std::string& bytes) {
  MotionTexture model;
  try {
    model = read_model_bytes(bytes, "fuzz");
  } catch (const Error&) {
    return;
  }
  const std::string written = write_model_bytes(model);
  if (write_model_bytes(read_model_bytes(written, "again")) != written) {
    std::cerr << "write and read changed the model\n";
    std::abort();
  }
  if (bytes.size() > 100'000) return;
  try {
    model = apply_edits(std::move(model));
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
