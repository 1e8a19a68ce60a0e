// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/clip_background.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/particles/render.h"

namespace motex {
namespace {

constexpr int kMostFrames = 61;  // that a background is made from

/// About kMostFrames of the frames, evenly, the middle one among them.
std::vector<int> sampled_frames(int num_frames) {
  const int step = std::max(1, (num_frames + kMostFrames - 1) / kMostFrames);
  std::vector<int> out;
  for (int t = (num_frames / 2) % step; t < num_frames; t += step) out.push_back(t);
  return out;
}

/// planes − bases of the cables in that frame.
void subtract_frame(Planes& planes, const std::vector<Cable>& cables, std::int64_t frame, BaseRenderer& renderer,
                    std::vector<Base>& bases) {
  bases.clear();
  const auto take = [&](Base base) {
    for (float& coefficient : base.coefficients) coefficient = -coefficient;
    bases.push_back(base);
  };
  for (const Cable& cable : cables) {
    if (!cable.covers(frame)) continue;
    const auto t = static_cast<std::size_t>(frame - cable.first_frame);
    take(cable.core[t]);
    for (const std::vector<Base>& coil : cable.coils) take(coil[t]);
  }
  renderer.add(bases, planes);
}

}  // namespace

Planes frame_planes(const ClipFrames& clip, int frame) {
  const auto t = static_cast<std::size_t>(frame);
  return clip.colour.empty() ? Planes{clip.luma[t]} : to_planes(clip.colour[t], 3);
}

std::vector<Plane> luma_residuals(const ClipFrames& clip, const Planes& background, int jobs) {
  const Plane still = luma(background);
  std::vector<Plane> out(clip.luma.size());
  parallel_for(jobs, clip.num_frames(),
               [&](int t) { out[static_cast<std::size_t>(t)] = minus(clip.luma[static_cast<std::size_t>(t)], still); });
  return out;
}

ClipBackground::ClipBackground(const ClipFrames& clip, BackgroundKind kind, const JobContext& job) : kind_(kind) {
  job.progress("background", 0);
  const int middle = clip.num_frames() / 2;
  std::vector<Planes> frames;
  if (kind != BackgroundKind::kSmooth && kind != BackgroundKind::kFlat)
    for (const int t : sampled_frames(clip.num_frames())) frames.push_back(frame_planes(clip, t));
  still_ = estimate_background(frame_planes(clip, middle), frames, kind_);
  if (kind_ == BackgroundKind::kSmooth) {
    smooth_.resize(clip.luma.size());
    parallel_for(job.jobs, clip.num_frames(), [&](int t) {
      BackgroundKind smooth = BackgroundKind::kSmooth;
      smooth_[static_cast<std::size_t>(t)] =
          estimate_background({clip.luma[static_cast<std::size_t>(t)]}, {}, smooth).at(0);
    });
  }
  update_residuals(clip, job.jobs);
}

void ClipBackground::update_residuals(const ClipFrames& clip, int jobs) {
  if (smooth_.empty()) {
    residuals_ = luma_residuals(clip, still_, jobs);
    return;
  }
  residuals_.resize(clip.luma.size());
  parallel_for(jobs, clip.num_frames(), [&](int task) {
    const auto t = static_cast<std::size_t>(task);
    residuals_[t] = minus(clip.luma[t], smooth_[t]);
  });
}

void ClipBackground::refresh(const ClipFrames& clip, const std::vector<Cable>& cables, const JobContext& job) {
  if (!smooth_.empty() || kind_ == BackgroundKind::kFlat) return;
  const std::vector<int> sampled = sampled_frames(clip.num_frames());
  std::vector<Planes> frames(sampled.size());
  parallel_for(job.jobs, static_cast<int>(sampled.size()), [&](int k) {
    BaseRenderer renderer;
    std::vector<Base> bases;
    Planes& planes = frames[static_cast<std::size_t>(k)];
    planes = frame_planes(clip, sampled[static_cast<std::size_t>(k)]);
    subtract_frame(planes, cables, sampled[static_cast<std::size_t>(k)], renderer, bases);
  });
  job.check_cancelled();
  still_ = quantile_over_time(frames, 0.5);
  update_residuals(clip, job.jobs);
}

void ClipBackground::shift(const ClipFrames& clip, const Plane& luma_change, int jobs) {
  for (Plane& plane : still_)
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] += luma_change.values[i];
  update_residuals(clip, jobs);
}

void subtract_cables(std::vector<Plane>& residuals, const std::vector<Cable>& cables, int jobs) {
  parallel_for(jobs, static_cast<int>(residuals.size()), [&](int t) {
    BaseRenderer renderer;
    std::vector<Base> bases;
    Planes planes{std::move(residuals[static_cast<std::size_t>(t)])};
    subtract_frame(planes, cables, t, renderer, bases);
    residuals[static_cast<std::size_t>(t)] = std::move(planes[0]);
  });
}

double psnr_of(const std::vector<Plane>& residuals) {
  double sum = 0, count = 0;
  for (const Plane& plane : residuals) {
    sum += sum_of_squares(plane);
    count += static_cast<double>(plane.values.size());
  }
  return 10 * std::log10(255.0 * 255.0 * count / std::max(sum, 1e-300));
}

}  // namespace motex
