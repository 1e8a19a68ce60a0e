// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/liveliness.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

double mean_speed(const MotionTexture& model, const Instance& x) {
  if (x.length < 2) return 0;
  const auto y = model.corpus.middleRows(x.row, x.length);
  const auto body = (y.bottomRows(x.length - 1) - y.topRows(x.length - 1)).rightCols(y.cols() - 4);
  const double step = model.features.cm_per_unit / model.features.weights[0];
  return static_cast<double>(body.rowwise().norm().mean()) +
         step * static_cast<double>(y.leftCols(2).rowwise().norm().mean());
}

}  // namespace

std::vector<double> liveliness(const MotionTexture& model) {
  std::vector<double> out;
  double count = 0, sum = 0, squares = 0;
  for (const Instance& x : model.instances) {
    const auto frames = static_cast<double>(x.length);
    const double speed = mean_speed(model, x);
    out.push_back(speed);
    count += frames, sum += frames * speed, squares += frames * speed * speed;
  }
  const double mean = sum / count, deviation = std::sqrt(std::max(1e-12, squares / count - mean * mean));
  for (double& z : out) z = (z - mean) / deviation;
  return out;
}

}  // namespace motex
