// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "arguments.h"
#include "clip_output.h"
#include "model_sources.h"

namespace motex::cli {

/// The example of a texton that a command works on: --texton T or --example CLIP@FRAME.
class TextonExample {
 public:
  void declare(Arguments& arguments);
  /// Throws InvalidInput unless one of the two was given.
  void check() const;
  /// Its number in the model. Throws InvalidInput for a texton or frame that does not exist.
  int choose(const MotionTexture& model) const;

 private:
  std::string texton_, example_;
};

/// "cmu61_05.bvh, frames 120–246", for people.
std::string described(const InstanceSource& source);
/// One texton from the first frame to the last.
ClipPicture example_picture(const MotionTexture& model, int instance, const std::string& what, Index num_frames);
/// texton, instance, clip, start, length: for --json.
void describe_example(const MotionTexture& model, int instance, Value& object);

}  // namespace motex::cli
