// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_beside.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "arguments.h"
#include "motex/motion/length_unit.h"
#include "motex/motion/retime.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_texture/choreography_plan.h"
#include "text_table.h"

namespace motex::cli {
namespace {

std::string described(const ClipFrame& at) { return at.clip + "@" + std::to_string(at.frame); }

/// The learned frames of the clip on that side, up to where some were left out.
Clip model_clip(const MotionTexture& model, const ClipFrame& at, Beside side) {
  const Index row = corpus_row(model, at);
  for (const Run& run : model.runs) {
    if (row < run.row || row >= run.row + run.length) continue;
    const Instance& first = model.instances[static_cast<std::size_t>(instance_at(model, run.row))];
    Clip clip = decode(model.features, model.corpus.middleRows(run.row, run.length).cast<double>(), first.place);
    const Index frame = row - run.row;
    clip = side == Beside::kUpTo ? slice(clip, 0, frame + 1) : slice(clip, frame, run.length - frame);
    clip.name = at.clip;
    return clip;
  }
  throw InvalidInput(described(at) + " is not in the model");
}

/// The side at another rate, such that its frame at the gap stays.
Clip at_rate(const Clip& clip, double frame_time_secs, Beside side) {
  const double ratio = frame_time_secs / clip.frame_time_secs;
  const auto length = static_cast<double>(clip.num_frames() - 1);
  std::vector<double> moments;
  for (double way = 0; way <= length + 1e-9; way = ratio * static_cast<double>(moments.size()))
    moments.push_back(side == Beside::kUpTo ? length - way : way);
  if (side == Beside::kUpTo) std::reverse(moments.begin(), moments.end());
  Clip out = retime(clip, moments);
  out.frame_time_secs = frame_time_secs;
  return out;
}

}  // namespace

ClipFrame parse_clip_frame(const std::string& flag, const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || at == 0) throw InvalidInput(flag + ": '" + text + "' is not CLIP@FRAME");
  ClipFrame out;
  out.clip = text.substr(0, at);
  std::int64_t frame = 0;
  parse_value(flag, text.substr(at + 1), frame);
  out.frame = frame;
  return out;
}

Clip clip_beside(const MotionTexture& model, const ClipFrame& at, Beside side, const ReadClipOptions& read,
                 Session& session) {
  std::error_code ec;
  if (!std::filesystem::exists(at.clip, ec)) {
    const bool is_file_name = at.clip.find('/') != std::string::npos;
    if (is_file_name) throw InvalidInput(at.clip + ": there is no such file");
    return model_clip(model, at, side);
  }
  Clip clip = read_clip(at.clip, read, session.job(0, 0.1));
  const std::string difference = skeleton_difference(model.features.skeleton, clip.skeleton);
  if (!difference.empty()) throw InvalidInput(at.clip + " is of another skeleton than the model: " + difference);
  if (at.frame < 0 || at.frame >= clip.num_frames())
    throw InvalidInput(described(at) + ": the clip has frames 0 … " + std::to_string(clip.num_frames() - 1));
  clip = side == Beside::kUpTo ? slice(clip, 0, at.frame + 1) : slice(clip, at.frame, clip.num_frames() - at.frame);
  match_unit(clip, model.features.skeleton, session.job(0, 0.1));
  const double wanted = model.frame_time_secs();
  if (std::abs(clip.frame_time_secs - wanted) > 1e-3 * wanted) {
    session.warn(at.clip + ": changed from " + fixed(clip.frame_rate(), 2) + " Hz to the model's " +
                 fixed(1 / wanted, 2) + " Hz");
    return at_rate(clip, wanted, side);
  }
  clip.frame_time_secs = wanted;
  return clip;
}

}  // namespace motex::cli
