// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/water_synthesis.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr std::int64_t kLoopBlend = 12;  // frames, at most

const WaterModel& water_of(const TexturedMotion& model) {
  if (!model.water)
    throw InvalidInput("the model is not one of water: it has no flow field; learn it with --tracking carry");
  return *model.water;
}

/// Both, each base times its weight.
void append_weighted(const MovetonFrame& from, double weight, MovetonFrame& to) {
  const std::size_t first = to.bases.size();
  for (Base base : from.bases) {
    for (float& coefficient : base.coefficients) coefficient *= static_cast<float>(weight);
    to.bases.push_back(base);
  }
  for (Moveton moveton : from.movetons) {
    moveton.first_base += first;
    to.movetons.push_back(moveton);
  }
}

/// light(x, y) at the centres of the pixels of a magnified picture, bilinear.
void add_light(const Plane& light, double magnification, Planes& planes) {
  const int width = planes[0].width, height = planes[0].height;
  for (int y = 0; y < height; ++y) {
    const double from_y = std::clamp((y + 0.5) / magnification - 0.5, 0.0, light.height - 1.0);
    const int top = std::min(static_cast<int>(from_y), std::max(0, light.height - 2));
    const int bottom = std::min(top + 1, light.height - 1);
    const auto fy = static_cast<float>(from_y - top);
    for (int x = 0; x < width; ++x) {
      const double from_x = std::clamp((x + 0.5) / magnification - 0.5, 0.0, light.width - 1.0);
      const int left = std::min(static_cast<int>(from_x), std::max(0, light.width - 2));
      const int right = std::min(left + 1, light.width - 1);
      const auto fx = static_cast<float>(from_x - left);
      const float value = (1 - fy) * ((1 - fx) * light.at(left, top) + fx * light.at(right, top)) +
                          fy * ((1 - fx) * light.at(left, bottom) + fx * light.at(right, bottom));
      for (Plane& plane : planes) plane.at(x, y) += value;
    }
  }
}

void add_light(const Plane& light, Planes& planes) {
  for (Plane& plane : planes)
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] += light.values[i];
}

}  // namespace

WaterSource::WaterSource(const TexturedMotion& model, const WaterReplayOptions& options, std::uint64_t seed,
                         std::int64_t loop_frames)
    : replay_(model.cables, model.num_frames, model.width, model.height, water_of(model).flow, options, seed) {
  if (loop_frames < 0 || loop_frames == 1) throw InvalidInput("a loop of water needs at least 2 frames");
  if (loop_frames > 0) record_loop(loop_frames);
}

void WaterSource::record_loop(std::int64_t num_frames) {
  const std::int64_t blend = std::min(kLoopBlend, num_frames / 2);
  loop_.resize(static_cast<std::size_t>(num_frames));
  for (MovetonFrame& frame : loop_) replay_.next(frame);
  MovetonFrame after;
  for (std::int64_t t = 0; t < blend; ++t) {
    // what follows the last frame fades into what the first frames show; variances add up to one
    const double share = (static_cast<double>(t) + 0.5) / static_cast<double>(blend);
    replay_.next(after);
    MovetonFrame& frame = loop_[static_cast<std::size_t>(t)];
    MovetonFrame both;
    both.frame = t;
    append_weighted(after, std::sqrt(1 - share), both);
    append_weighted(frame, std::sqrt(share), both);
    frame = std::move(both);
  }
}

bool WaterSource::next_frame(MovetonFrame& frame) {
  if (loop_.empty()) {
    replay_.next(frame);
    return true;
  }
  frame = loop_[static_cast<std::size_t>(num_shown_ % static_cast<std::int64_t>(loop_.size()))];
  frame.frame = num_shown_++;
  return true;
}

WaterPainter::WaterPainter(const TexturedMotion& model, Planes background, double magnification, std::uint64_t seed)
    : background_(std::move(background)), renderer_(magnification), light_(water_of(model).light, seed ^ 0x11647) {
  fill_image(background_, background_image_);
  sum_ = background_;
}

void WaterPainter::paint(const MovetonFrame& frame, Image& picture, Image& layer) {
  for (std::size_t k = 0; k < sum_.size(); ++k)
    std::copy(background_[k].values.begin(), background_[k].values.end(), sum_[k].values.begin());
  renderer_.add(frame.bases, sum_);
  const Plane& light = light_.next();
  if (renderer_.magnification() == 1)
    add_light(light, sum_);
  else
    add_light(light, renderer_.magnification(), sum_);
  fill_image(sum_, picture);
  make_layer(picture, background_image_, layer);
}

}  // namespace motex
