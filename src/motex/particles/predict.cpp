// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/predict.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/image/pyramid.h"
#include "motex/particles/best_pairs.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/track_elements.h"

namespace motex {
namespace {

constexpr int kFewestFrames = 8;
constexpr int kMostMissed = 2;        // frames in a row after which an element is gone
constexpr double kMostDistance = 25;  // squared deviations between an element and its sight
constexpr double kWider = 2;          // variances of expectations handed to the fit: filters are too sure
constexpr double kBirthBlur = 4;      // pixels
constexpr double kShownAgain = 0.7;   // weight of an element that was missed once

/// plane += A e^{−q/2} of the blob whose place is known to variance v in x and y: covariances add.
void add_expected(const Blob& blob, double variance, double weight, Plane& plane) {
  const double e = std::hypot(blob.e1, blob.e2), s2 = std::exp(2 * blob.log_scale);
  const double c = std::cosh(e), d = e > 1e-9 ? std::sinh(e) / e : 1;
  const double xx = s2 * (c + d * blob.e1) + variance, yy = s2 * (c - d * blob.e1) + variance, xy = s2 * d * blob.e2;
  const double determinant = xx * yy - xy * xy, peak = weight * blob.amplitude * s2 / std::sqrt(determinant);
  const double pxx = yy / determinant, pyy = xx / determinant, pxy = -xy / determinant;
  const double reach_x = 3.5 * std::sqrt(xx), reach_y = 3.5 * std::sqrt(yy);
  const int left = std::max(0, static_cast<int>(std::ceil(blob.x - reach_x))),
            right = std::min(plane.width - 1, static_cast<int>(std::floor(blob.x + reach_x)));
  const int top = std::max(0, static_cast<int>(std::ceil(blob.y - reach_y))),
            bottom = std::min(plane.height - 1, static_cast<int>(std::floor(blob.y + reach_y)));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double dx = x - blob.x, dy = y - blob.y;
      plane.at(x, y) += static_cast<float>(peak * std::exp(-0.5 * (pxx * dx * dx + 2 * pxy * dx * dy + pyy * dy * dy)));
    }
}

}  // namespace

FramePredictor::FramePredictor(const ClipFrames& training, const JobContext& job) {
  if (training.num_frames() < kFewestFrames)
    throw InvalidInput("a prediction is learned from at least " + std::to_string(kFewestFrames) + " frames");
  const ClipBackground background(training, BackgroundKind::kMedian, job);
  TrackElementsReport report;
  track_elements(training, luma(background.still()), 0, {}, job, &report);
  model_ = report.link.model;
  detect_ = report.detect;
  background_ = report.background;
  noise_ = report.noise;
  births_ = Plane(training.width, training.height);
  const int settled = training.num_frames() / 4;
  Plane missed = births_;
  for (int t = 0; t < training.num_frames(); ++t) {
    job.check_cancelled();
    const Plane& frame = training.luma[static_cast<std::size_t>(t)];
    if (t > settled) {
      const Plane error = minus(frame, predict());
      for (std::size_t i = 0; i < missed.values.size(); ++i)
        missed.values[i] += error.values[i] / static_cast<float>(training.num_frames() - settled - 1);
    }
    observe(frame);
  }
  births_ = gaussian_blur(missed, kBirthBlur);
}

std::vector<ExpectedBlob> FramePredictor::expectations() const {
  std::vector<ExpectedBlob> out;
  for (const Element& element : elements_) {
    ExpectedBlob one;
    one.blob = element.looks;
    one.blob.x = element.filter.expected_x(frame_);
    one.blob.y = element.filter.expected_y(frame_);
    one.is_seen = false;
    const bool inside =
        one.blob.x > -1 && one.blob.y > -1 && one.blob.x < background_.width && one.blob.y < background_.height;
    if (!inside || element.num_seen < 3) continue;
    const double place = 1 / (0.01 + kWider * element.filter.variance_y(frame_));
    const double amplitude = 0.1 * std::abs(element.looks.amplitude);
    one.prior.mean = {one.blob.x, one.blob.y, one.blob.log_scale, one.blob.e1, one.blob.e2, one.blob.amplitude};
    one.prior.precision = {place, place, 1 / 0.01, 0, 0, 1 / (amplitude * amplitude)};
    if (detect_.shape == CoreShape::kOriented) one.prior.precision[3] = one.prior.precision[4] = 1 / 0.04;
    out.push_back(one);
  }
  return out;
}

void FramePredictor::take_in(Element& element, const Blob& blob) const {
  element.filter.follow(sight_of(blob, frame_));
  ++element.num_seen;
  element.num_missed = 0;
  const double share = std::max(0.15, 1.0 / element.num_seen);  // recent sights count more: looks drift
  for (double Blob::*field : {&Blob::log_scale, &Blob::e1, &Blob::e2, &Blob::amplitude})
    element.looks.*field += share * (blob.*field - element.looks.*field);
}

void FramePredictor::take_in(const std::vector<Blob>& blobs) {
  std::vector<PairGain> pairs;
  for (std::size_t k = 0; k < elements_.size(); ++k)
    for (std::size_t b = 0; b < blobs.size(); ++b) {
      const double distance = elements_[k].filter.distance(sight_of(blobs[b], frame_));
      const double louder = std::log(std::max(1e-6, blobs[b].amplitude / elements_[k].looks.amplitude));
      const double gain = kMostDistance - distance - 4 * louder * louder;
      if (gain > 0) pairs.push_back({static_cast<int>(k), static_cast<int>(b), gain});
    }
  const std::vector<int> sight = best_pairs(static_cast<int>(elements_.size()), static_cast<int>(blobs.size()), pairs);
  std::vector<char> taken(blobs.size(), 0);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (sight[k] < 0) {
      ++elements_[k].num_missed;
      continue;
    }
    taken[static_cast<std::size_t>(sight[k])] = 1;
    take_in(elements_[k], blobs[static_cast<std::size_t>(sight[k])]);
  }
  std::erase_if(elements_, [&](const Element& element) {
    const double x = element.filter.expected_x(frame_), y = element.filter.expected_y(frame_), margin = 12;
    return element.num_missed > kMostMissed || (element.num_missed > 0 && element.num_seen < 3) || x < -margin ||
           y < -margin || x > background_.width + margin || y > background_.height + margin;
  });
  for (std::size_t b = 0; b < blobs.size(); ++b) {
    if (taken[b] != 0) continue;
    Element element{ElementFilter(model_), blobs[b], 1, 0};
    element.filter.start(sight_of(blobs[b], frame_));
    elements_.push_back(element);
  }
}

void FramePredictor::observe(const Plane& frame) {
  if (frame.width != background_.width || frame.height != background_.height)
    throw InvalidInput("the frame is of another size than those learned from");
  take_in(detect_blobs(minus(frame, background_), noise_, detect_, expectations()));
  ++frame_;
}

double FramePredictor::weight_of(const Element& element) const {
  return element.num_missed == 0 ? 1 : std::pow(kShownAgain, element.num_missed);
}

Plane FramePredictor::predict() const {
  Plane out = background_;
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += births_.values[i];
  for (const Element& element : elements_) {
    Blob blob = element.looks;
    blob.x = element.filter.expected_x(frame_);
    blob.y = element.filter.expected_y(frame_);
    add_expected(blob, element.filter.variance_y(frame_), weight_of(element), out);
  }
  for (float& value : out.values) value = std::clamp(value, 0.0F, 255.0F);
  return out;
}

}  // namespace motex
