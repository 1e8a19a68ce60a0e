// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/painted_products.h"

#include <algorithm>
#include <climits>
#include <cstring>

namespace motex {
namespace {

constexpr int kLanes = 4;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

int lanes_of(const BasePatch& patch) { return (patch.width + kLanes - 1) / kLanes; }

Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

}  // namespace

PaintedProducts::PaintedProducts(const std::vector<BasePatch>& patches) : places_(patches.size()) {
  int left = INT_MAX, top = INT_MAX, right = INT_MIN, bottom = INT_MIN;
  std::size_t num_values = 0;
  for (const BasePatch& patch : patches) {
    if (patch.values.empty()) continue;
    left = std::min(left, patch.left);
    top = std::min(top, patch.top);
    right = std::max(right, patch.left + kLanes * lanes_of(patch));
    bottom = std::max(bottom, patch.top + patch.height);
    num_values += static_cast<std::size_t>(kLanes * lanes_of(patch)) * static_cast<std::size_t>(patch.height);
  }
  if (num_values == 0) return;
  stride_ = static_cast<std::size_t>(right - left);
  num_pixels_ = stride_ * static_cast<std::size_t>(bottom - top);
  values_.resize(num_values);
  std::size_t next = 0;
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const BasePatch& patch = patches[j];
    if (patch.values.empty()) continue;
    places_[j] = {next,
                  static_cast<std::size_t>(patch.top - top) * stride_ + static_cast<std::size_t>(patch.left - left),
                  patch.height, lanes_of(patch)};
    for (int y = 0; y < patch.height; ++y, next += static_cast<std::size_t>(kLanes * lanes_of(patch)))
      std::copy_n(patch.row(y), patch.width, values_.data() + next);
  }
}

void PaintedProducts::multiply(const std::vector<double>& in, std::vector<double>& out,
                               std::vector<float>& canvas) const {
  canvas.assign(num_pixels_, 0.0F);
  for (std::size_t j = 0; j < places_.size(); ++j) {
    const Place& place = places_[j];
    const float *value = values_.data() + place.first_value, weight = static_cast<float>(in[j]);
    float* row = canvas.data() + place.first_pixel;
    for (int y = 0; y < place.num_rows; ++y, row += stride_)
      for (int k = 0; k < place.num_lanes; ++k, value += kLanes) {
        const Lanes sum = load(row + kLanes * k) + weight * load(value);
        std::memcpy(row + kLanes * k, &sum, sizeof sum);
      }
  }
  for (std::size_t j = 0; j < places_.size(); ++j) {
    const Place& place = places_[j];
    const float *value = values_.data() + place.first_value, *row = canvas.data() + place.first_pixel;
    Lanes sum{};
    for (int y = 0; y < place.num_rows; ++y, row += stride_)
      for (int k = 0; k < place.num_lanes; ++k, value += kLanes) sum += load(value) * load(row + kLanes * k);
    out[j] = static_cast<double>((sum[0] + sum[1]) + (sum[2] + sum[3]));
  }
}

}  // namespace motex
