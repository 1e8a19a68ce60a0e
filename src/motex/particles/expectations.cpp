// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/expectations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motex/core/quantile.h"
#include "motex/particles/fit_element_model.h"

namespace motex {
namespace {

constexpr std::size_t kSureLength = 4;  // sights that a path needs before it says what to expect
constexpr double kFarVariance = 0.5;    // pixels², of a place that is known well
constexpr double kLeastTurn = 0.08;     // radians
constexpr double kWidening = 1.5;       // of the deviations expected: paths may be wrong

}  // namespace

Expectations::Expectations(const BlobFrames& blobs, std::vector<std::size_t> num_found, const ElementModel& model,
                           const ExpectationOptions& options)
    : blobs_(blobs), num_found_(std::move(num_found)), model_(model), options_(options), frames_(blobs.size()) {}

bool Expectations::is_known(const SightChain& chain, const SmoothedPlace& place, int frame) const {
  const int away = std::max(chain.sights.front().frame - frame, frame - chain.sights.back().frame);
  return away <= options_.reach_out || std::max(place.variance_x, place.variance_y) < kFarVariance;
}

void Expectations::add(const SightChain& chain) {
  const bool is_sure = chain.sights.size() >= kSureLength;
  const int last_frame = static_cast<int>(frames_.size()) - 1, far = std::max(options_.reach_out, options_.farthest);
  const int before = is_sure ? std::min(far, chain.sights.front().frame) : 0,
            after = is_sure ? std::min(far, last_frame - chain.sights.back().frame) : 0;
  const std::vector<SmoothedPlace> places = smooth_path(model_, chain.sights, before, after);
  const int first = chain.sights.front().frame - before;
  std::size_t k = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int frame = first + static_cast<int>(i);
    if (!is_known(chain, places[i], frame)) continue;
    while (k + 1 < chain.sights.size() && chain.sights[k + 1].frame <= frame) ++k;
    ExpectedBlob one;
    one.blob = blob_at(blobs_, chain, k);
    one.is_seen = chain.sights[k].frame == frame &&
                  static_cast<std::size_t>(chain.idx[k]) < num_found_[static_cast<std::size_t>(frame)];
    one.num_sights = static_cast<int>(chain.sights.size());
    if (is_sure) set_prior(chain, places[i], k, one);
    if (!one.is_seen && !is_inside(places[i].x, places[i].y, options_.width, options_.height)) continue;
    frames_[static_cast<std::size_t>(frame)].push_back(one);
  }
}

/// Typical of the sights of the path near k, and how much single ones differ.
double Expectations::typical(const SightChain& chain, std::size_t k, double Blob::*field, double& deviation) const {
  std::vector<double> values;
  const std::size_t first = k > 7 ? k - 7 : 0, end = std::min(chain.idx.size(), k + 8);
  for (std::size_t i = first; i < end; ++i) values.push_back(blob_at(blobs_, chain, i).*field);
  const double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  deviation = 1.4826 * median(values);
  return middle;
}

void Expectations::set_prior(const SightChain& chain, const SmoothedPlace& place, std::size_t k,
                             ExpectedBlob& one) const {
  double scale_spread = 0, amplitude_spread = 0;
  const double log_scale = typical(chain, k, &Blob::log_scale, scale_spread);
  const double amplitude = typical(chain, k, &Blob::amplitude, amplitude_spread);
  scale_spread = std::max(0.04, kWidening * scale_spread);
  amplitude_spread = std::max(0.05 * std::abs(amplitude), kWidening * amplitude_spread);
  const double wider = kWidening * kWidening;
  const double vx = 0.01 + wider * place.others_variance_x, vy = 0.01 + wider * place.others_variance_y;
  one.prior.mean = {place.others_x, place.others_y, log_scale, 0, 0, amplitude};
  one.prior.precision = {1 / vx, 1 / vy, 1 / (scale_spread * scale_spread),
                         0,      0,      1 / (amplitude_spread * amplitude_spread)};
  if (options_.is_oriented)
    for (const std::size_t p : {std::size_t{3}, std::size_t{4}}) {
      double spread = 0;
      one.prior.mean[p] = typical(chain, k, p == 3 ? &Blob::e1 : &Blob::e2, spread);
      one.prior.precision[p] = 1 / std::max(0.04, wider * spread * spread);
    }
  double turn_spread = 0;
  one.blob.turn = typical(chain, k, &Blob::turn, turn_spread);
  turn_spread = std::max(kLeastTurn, kWidening * turn_spread);
  one.turn_precision = 1 / (turn_spread * turn_spread);
  if (one.is_seen) return;
  one.blob.x = place.x;
  one.blob.y = place.y;
  one.blob.log_scale = log_scale;
  one.blob.amplitude = amplitude;
}

}  // namespace motex
