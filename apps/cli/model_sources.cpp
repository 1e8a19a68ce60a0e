// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "model_sources.h"

#include <algorithm>

namespace motex::cli {

InstanceSource source_of(const MotionTexture& model, int instance_idx) {
  const Instance& instance = model.instances.at(static_cast<std::size_t>(instance_idx));
  const Run& run = model.runs.at(static_cast<std::size_t>(instance.run_idx));
  return {model.clip_names.at(static_cast<std::size_t>(run.clip_idx)), run.clip_start + instance.row - run.row,
          instance.length};
}

Value played_value(const MotionTexture& model, const SynthesizeReport& report) {
  Value list = Value::List();
  for (const PlayedTexton& played : report.played) {
    const InstanceSource source = source_of(model, played.instance);
    Value entry;
    entry["clip"] = source.clip;
    entry["start"] = std::int64_t{source.start};
    entry["length"] = std::int64_t{source.length};
    entry["texton"] = played.texton;
    entry["output_start"] = std::int64_t{played.start};
    list.append(std::move(entry));
  }
  return list;
}

std::vector<TextonSpan> played_spans(const MotionTexture& model, const SynthesizeReport& report, Index num_frames) {
  std::vector<TextonSpan> spans;
  for (const PlayedTexton& played : report.played) {
    if (played.start >= num_frames) break;
    const InstanceSource source = source_of(model, played.instance);
    spans.push_back({played.texton, played.start, std::min(played.length, num_frames - played.start),
                     source.clip + ", frames " + std::to_string(source.start) + "–" +
                         std::to_string(source.start + source.length - 1)});
  }
  return spans;
}

}  // namespace motex::cli
