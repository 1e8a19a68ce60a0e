// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/held_out.h"

#include <algorithm>

namespace motex {
namespace {

constexpr int kParts = 4;

HeldOutSplit split_frames(const Clip& clip, int split) {
  const Index quarter = kParts - 1 - split % kParts;
  const Index first = clip.num_frames() * quarter / kParts, end = clip.num_frames() * (quarter + 1) / kParts;
  HeldOutSplit parts;
  parts.held_out.push_back(slice(clip, first, end - first));
  if (first > 0) parts.training.push_back(slice(clip, 0, first));
  if (end < clip.num_frames()) parts.training.push_back(slice(clip, end, clip.num_frames() - end));
  return parts;
}

}  // namespace

HeldOutSplit split_clips(std::vector<Clip> clips, int split) {
  if (clips.empty() || split < 0) throw InvalidInput("a split needs clips and a number of 0 or more");
  if (clips.size() == 1) return split_frames(clips[0], split);
  std::stable_sort(clips.begin(), clips.end(), [](const Clip& a, const Clip& b) { return a.name < b.name; });
  const std::size_t step = std::min<std::size_t>(clips.size(), kParts);
  const std::size_t chosen = static_cast<std::size_t>(split) % step;
  HeldOutSplit parts;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const bool is_held_out = (clips.size() - 1 - i) % step == chosen;
    (is_held_out ? parts.held_out : parts.training).push_back(std::move(clips[i]));
  }
  return parts;
}

HeldOutReport held_out_score(std::vector<Clip> clips, int split, const LearnOptions& options, const JobContext& job) {
  const HeldOutSplit parts = split_clips(std::move(clips), split);
  HeldOutReport report;
  for (const Clip& clip : parts.held_out) report.held_out_clips.push_back(clip.name);
  const MotionTexture model = learn_motion_texture(parts.training, options, report.learned, job.part(0, 0.45));
  const ScoreReport score = score_clips(model, parts.held_out, job.part(0.45, 0.5));
  report.log_likelihood_per_frame = score.log_likelihood_per_frame;
  report.global_lds_log_likelihood_per_frame = score.global_lds_log_likelihood_per_frame;
  report.num_frames = score.num_frames;

  LearnOptions control = options;
  control.common_dynamics = true;
  JobContext quiet = job.part(0.5, 0.95);
  quiet.on_warning = {};
  LearnReport control_report;
  const MotionTexture noise_only = learn_motion_texture(parts.training, control, control_report, quiet);
  report.noise_only_log_likelihood_per_frame =
      score_clips(noise_only, parts.held_out, job.part(0.95, 1)).log_likelihood_per_frame;
  return report;
}

}  // namespace motex
