// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "texton_example.h"

#include <algorithm>

#include "clip_beside.h"
#include "motex/motion_texture/choreography_plan.h"
#include "texton_argument.h"

namespace motex::cli {

void TextonExample::declare(Arguments& arguments) {
  arguments.value("--texton", "T", "texton, by number or name: its longest example", texton_);
  arguments.value("--example", "CLIP@FRAME", "or the example that has this frame of a clip of the model", example_);
}

void TextonExample::check() const {
  if (texton_.empty() == example_.empty())
    throw InvalidInput("name one texton, by --texton T or by --example CLIP@FRAME");
  if (!example_.empty()) parse_clip_frame("--example", example_);
}

int TextonExample::choose(const MotionTexture& model) const {
  if (!example_.empty()) return instance_at(model, corpus_row(model, parse_clip_frame("--example", example_)));
  const Texton& texton = model.textons[static_cast<std::size_t>(texton_number(model, "--texton", texton_))];
  return *std::max_element(texton.instances.begin(), texton.instances.end(), [&](int a, int b) {
    return model.instances[static_cast<std::size_t>(a)].length < model.instances[static_cast<std::size_t>(b)].length;
  });
}

std::string described(const InstanceSource& source) {
  return source.clip + ", frames " + std::to_string(source.start) + "–" +
         std::to_string(source.start + source.length - 1);
}

ClipPicture example_picture(const MotionTexture& model, int instance, const std::string& what, Index num_frames) {
  const std::string source = described(source_of(model, instance));
  const int texton = model.instances[static_cast<std::size_t>(instance)].texton;
  ClipPicture picture;
  picture.title = source + ", " + what;
  picture.spans = {{texton, 0, num_frames, source}};
  return picture;
}

void describe_example(const MotionTexture& model, int instance, Value& object) {
  const InstanceSource source = source_of(model, instance);
  object["texton"] = model.instances[static_cast<std::size_t>(instance)].texton;
  object["instance"] = instance;
  object["clip"] = source.clip;
  object["start"] = std::int64_t{source.start};
  object["source_length"] = std::int64_t{source.length};
}

}  // namespace motex::cli
