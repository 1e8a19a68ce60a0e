// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/moveton_light.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/particles/cable_tracks.h"

namespace motex {
namespace {

constexpr double kRidge = 0.02;
constexpr double kLeastNoise = 1;  // grey levels

std::vector<Base> copies_of(const std::vector<Base*>& places) {
  std::vector<Base> out;
  out.reserve(places.size());
  for (const Base* base : places) out.push_back(*base);
  return out;
}

void solve_plane(const JointFit& fit, const Plane& target, const std::vector<Base*>& places, std::size_t plane,
                 int times) {
  std::vector<float> alpha(places.size());
  for (std::size_t j = 0; j < alpha.size(); ++j) alpha[j] = places[j]->coefficients[plane];
  for (int k = 0; k < times; ++k) alpha = fit.solve(target, alpha);
  for (std::size_t j = 0; j < alpha.size(); ++j) places[j]->coefficients[plane] = alpha[j];
}

void check_sizes(const ClipFrames& clip, const Planes& background, const std::vector<Plane>& residuals) {
  if (static_cast<int>(background.size()) != clip.num_planes())
    throw InvalidInput("the background must have as many planes as the clip");
  if (!residuals.empty() && residuals.size() != clip.luma.size())
    throw InvalidInput("there must be as many residuals as frames of the clip");
  const auto check = [&](const Plane& plane) {
    if (plane.width != clip.width || plane.height != clip.height)
      throw InvalidInput("the background must have the size of the clip");
  };
  std::for_each(background.begin(), background.end(), check);
  std::for_each(residuals.begin(), residuals.end(), check);
}

}  // namespace

MovetonLight::MovetonLight(const ClipFrames& clip, const Planes& background, std::vector<Plane> residuals,
                           std::vector<Cable>& cables, double reach, const JobContext& job)
    : clip_(clip), background_(background), residuals_(std::move(residuals)), cables_(cables), job_(job) {
  check_sizes(clip, background, residuals_);
  grey_background_ = luma(background);
  frames_.resize(clip.luma.size());
  for (std::size_t c = 0; c < cables.size(); ++c)
    for (std::size_t at = 0; at < cables[c].core.size(); ++at) {
      cables[c].core[at].coefficients = {static_cast<float>(luma_coefficient(cables[c].core[at], clip.num_planes())), 0,
                                         0};
      const std::int64_t frame = cables[c].first_frame + static_cast<std::int64_t>(at);
      if (frame >= 0 && frame < clip.num_frames()) frames_[static_cast<std::size_t>(frame)].push_back({c, at});
    }
  left_.resize(clip.luma.size());
  squares_.resize(clip.luma.size());
  find_neighbours(reach);
}

void MovetonLight::find_neighbours(double reach) {
  neighbours_.resize(cables_.size());
  for (std::size_t c = 0; c < cables_.size(); ++c) neighbours_[c].resize(cables_[c].core.size());
  parallel_for(job_.jobs, clip_.num_frames(), [&](int frame) {
    const std::vector<Occupant>& here = frames_[static_cast<std::size_t>(frame)];
    for (const Occupant& a : here)
      for (const Occupant& b : here) {
        if (a.cable == b.cable) continue;
        const Base &core = cables_[a.cable].core[a.at], &other = cables_[b.cable].core[b.at];
        // farther than that from the window's edge it owns nothing there
        const double limit = ((reach + 2) * core.scale + 1) * (1 + other.scale / core.scale);
        if (std::abs(core.x - other.x) > limit || std::abs(core.y - other.y) > limit) continue;
        if (std::hypot(core.x - other.x, core.y - other.y) < limit) neighbours_[a.cable][a.at].push_back(other);
      }
  });
}

Plane MovetonLight::target(std::size_t frame) const {
  return residuals_.empty() ? minus(clip_.luma[frame], grey_background_) : residuals_[frame];
}

/// Where the background differs from frame to frame only its luma is known: the colours differ as much.
Planes MovetonLight::colour_targets(std::size_t frame) const {
  Planes out = to_planes(clip_.colour[frame], 3);
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = minus(std::move(out[k]), background_[k]);
    if (residuals_.empty()) continue;
    for (std::size_t i = 0; i < out[k].values.size(); ++i)
      out[k].values[i] -= clip_.luma[frame].values[i] - residuals_[frame].values[i] - grey_background_.values[i];
  }
  return out;
}

std::vector<Base*> MovetonLight::bases_of(int frame) {
  std::vector<Base*> out;
  for (const Occupant& who : frames_[static_cast<std::size_t>(frame)]) {
    Cable& cable = cables_[who.cable];
    out.push_back(&cable.core[who.at]);
    for (std::vector<Base>& coil : cable.coils) out.push_back(&coil[who.at]);
  }
  return out;
}

void MovetonLight::fit_luma() {
  parallel_for(job_.jobs, clip_.num_frames(), [&](int frame) {
    job_.check_cancelled();
    const auto idx = static_cast<std::size_t>(frame);
    const std::vector<Base*> places = bases_of(frame);
    const JointFit fit(copies_of(places), clip_.width, clip_.height, kRidge);
    Plane& left = left_[idx] = target(idx);
    solve_plane(fit, left, places, 0, 1);
    for (std::size_t j = 0; j < places.size(); ++j) add_patch(left, fit.patches()[j], -places[j]->coefficients[0]);
    squares_[idx] = 0;
    for (const float value : left.values) squares_[idx] += static_cast<double>(value) * static_cast<double>(value);
  });
}

/// Solved twice, the second time from what the first gave, so that the ridge does not draw colours towards grey.
void MovetonLight::fit_colours() {
  if (clip_.colour.empty()) return;
  parallel_for(job_.jobs, clip_.num_frames(), [&](int frame) {
    job_.check_cancelled();
    const std::vector<Base*> places = bases_of(frame);
    const JointFit fit(copies_of(places), clip_.width, clip_.height, kRidge);
    const Planes targets = colour_targets(static_cast<std::size_t>(frame));
    for (Base* base : places) base->coefficients.fill(base->coefficients[0]);
    for (std::size_t k = 0; k < 3; ++k) solve_plane(fit, targets[k], places, k, 2);
  });
}

double MovetonLight::psnr() const {
  double sum = 0;
  for (const double square : squares_) sum += square;
  return psnr_of(sum);
}

double MovetonLight::background_psnr() const {
  double sum = 0;
  for (std::size_t frame = 0; frame < clip_.luma.size(); ++frame)
    for (const float value : target(frame).values) sum += static_cast<double>(value) * static_cast<double>(value);
  return psnr_of(sum);
}

double MovetonLight::psnr_of(double sum_of_squares) const {
  const double num = static_cast<double>(clip_.num_frames()) * clip_.width * clip_.height;
  return 10 * std::log10(255.0 * 255.0 * num / sum_of_squares);
}

double MovetonLight::noise() const {
  std::vector<float> values;
  for (const Plane& plane : left_)
    for (std::size_t i = 0; i < plane.values.size(); i += 7) values.push_back(std::abs(plane.values[i]));
  if (values.empty()) return kLeastNoise;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max(kLeastNoise, 1.4826 * static_cast<double>(*middle));
}

}  // namespace motex
