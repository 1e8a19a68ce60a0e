// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/core_proposal.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kLogRootTwoPi = 0.9189385332046727;
constexpr int kFitSteps = 5;
constexpr double kWidening = 1.15;   // of deviations
constexpr double kWideBelief = 0.9;  // pixels: above, the start is searched
constexpr double kMaxSearch = 7;     // pixels
constexpr double kLeastPeak = 1.5;   // deviations of a smoothed pixel
constexpr double kSettled = 0.02;    // of the scale: one Newton step from there is exact enough

}  // namespace

bool FittedCoreProposal::factor(Square& matrix) const {
  for (std::size_t j = 0; j < num_; ++j) {
    for (std::size_t i = j; i < num_; ++i) {
      double sum = matrix[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      if (i == j) {
        if (!(sum > 1e-12)) return false;
        matrix[j][j] = std::sqrt(sum);
      } else {
        matrix[i][j] = sum / matrix[j][j];
      }
    }
  }
  return true;
}

void FittedCoreProposal::fit(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, CoreState z) {
  num_ = is_round(kind) ? kCoreAngle : kNumCoreCoordinates;
  const double weight = 1 / (prior_.noise * prior_.noise);
  const double low = std::log(prior_.min_scale), high = std::log(prior_.max_scale);
  for (int step = 0; step <= kFitSteps; ++step) {
    const CoreLinearisation line = linearise_core(image, kind, z);
    for (std::size_t i = 0; i < num_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) root_[i][j] = weight * line.curvature[i][j];
      // far from everything the state is still held: by a pixel, a factor e, a grey level
      root_[i][i] += belief.precision[i] + (i == kCoreAmplitude ? 1e-4 : 1e-2);
    }
    factor(root_);
    if (step == kFitSteps) break;
    CoreState move{};
    for (std::size_t i = 0; i < num_; ++i) {
      double sum = weight * line.slope[i] + belief.precision[i] * (belief.mean[i] - z[i]);
      for (std::size_t k = 0; k < i; ++k) sum -= root_[i][k] * move[k];
      move[i] = sum / root_[i][i];
    }
    for (std::size_t i = num_; i-- > 0;) {
      for (std::size_t k = i + 1; k < num_; ++k) move[i] -= root_[k][i] * move[k];
      move[i] /= root_[i][i];
    }
    const double scale = std::exp(z[kCoreLogScale]);
    const double longest = std::max({std::abs(move[kCoreX]) / scale, std::abs(move[kCoreY]) / scale,
                                     2 * std::abs(move[kCoreLogScale]), 2 * std::abs(move[kCoreAngle])});
    const double damping = longest > 0.8 ? 0.8 / longest : 1;
    for (std::size_t i = 0; i < num_; ++i) z[i] += damping * move[i];
    z[kCoreLogScale] = std::clamp(z[kCoreLogScale], low, high);
    if (longest < kSettled) break;
  }
  mean_ = z;
  log_norm_ = -static_cast<double>(num_) * (kLogRootTwoPi + std::log(kWidening));
  for (std::size_t i = 0; i < num_; ++i) log_norm_ += std::log(root_[i][i]);
}

CoreState FittedCoreProposal::best_start(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief) const {
  const auto radius = [&](std::size_t k) {
    return belief.precision[k] > 0 ? std::min(2 / std::sqrt(belief.precision[k]), kMaxSearch) : kMaxSearch;
  };
  const double weight = 1 / (2 * prior_.noise * prior_.noise), pitch = std::max(1.0, 0.8 * std::exp(belief.mean[2]));
  const int nx = static_cast<int>(radius(kCoreX) / pitch), ny = static_cast<int>(radius(kCoreY) / pitch);
  CoreState best = belief.mean, z = belief.mean;
  double most = -1e300;
  for (int j = -ny; j <= ny; ++j)
    for (int i = -nx; i <= nx; ++i) {
      z[kCoreX] = belief.mean[kCoreX] + i * pitch;
      z[kCoreY] = belief.mean[kCoreY] + j * pitch;
      const double worth = weight * explained_by(image, kind, z) -
                           0.5 * (belief.precision[kCoreX] * i * i + belief.precision[kCoreY] * j * j) * pitch * pitch;
      if (worth > most) {
        most = worth;
        best = z;
      }
    }
  return best;
}

void FittedCoreProposal::look_around(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief) {
  const double least = std::min(belief.precision[kCoreX], belief.precision[kCoreY]);
  fit(image, kind, belief, least * kWideBelief * kWideBelief < 1 ? best_start(image, kind, belief) : belief.mean);
}

void FittedCoreProposal::look_near(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, double x,
                                   double y, double radius) {
  CoreBelief somewhere = belief;
  somewhere.mean[kCoreX] = x;
  somewhere.mean[kCoreY] = y;
  somewhere.precision[kCoreX] = somewhere.precision[kCoreY] = 4 / (radius * radius);
  fit(image, kind, somewhere, best_start(image, kind, somewhere));
}

bool FittedCoreProposal::look_in_cell(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief,
                                      const PictureCell& cell) {
  const double sign = prior_.sign != 0 ? prior_.sign : 1;
  double most = kLeastPeak * prior_.noise;
  int peak_x = -1, peak_y = -1;
  for (int y = cell.top; y < cell.top + cell.height; ++y) {
    const float* rows[3] = {image.row(std::max(y - 1, 0)), image.row(y),
                            image.row(std::min(y + 1, image.height() - 1))};
    for (int x = cell.left; x < cell.left + cell.width; ++x) {
      const int left = std::max(x - 1, 0), right = std::min(x + 1, image.width() - 1);
      float sum = 0;
      for (int k = 0; k < 3; ++k) {
        const float part = rows[k][left] + 2 * rows[k][x] + rows[k][right];
        sum += k == 1 ? 2 * part : part;
      }
      double value = static_cast<double>(sum) / 16;
      value = prior_.sign == 0 ? std::abs(value) : sign * value;
      if (value > most) {
        most = value;
        peak_x = x;
        peak_y = y;
      }
    }
  }
  if (peak_x < 0) return false;
  CoreState start{};
  start[kCoreX] = peak_x;
  start[kCoreY] = peak_y;
  start[kCoreLogScale] = belief.mean[kCoreLogScale];
  const CoreProducts products = core_products(image, kind, start);
  start[kCoreAmplitude] = products.own > 0 ? products.image / products.own : belief.mean[kCoreAmplitude];
  if (!is_round(kind)) {
    CoreState turned = start;
    double explained = 0;
    for (int k = 0; k < kNumOrientations; ++k) {
      turned[kCoreAngle] = k * 3.14159265358979 / kNumOrientations;
      const CoreProducts at = core_products(image, kind, turned);
      const double gain = at.own > 0 ? at.image * at.image / at.own : 0;
      if (gain <= explained) continue;
      explained = gain;
      start[kCoreAngle] = turned[kCoreAngle];
      start[kCoreAmplitude] = at.image / at.own;
    }
  }
  fit(image, kind, belief, start);
  return true;
}

CoreState FittedCoreProposal::draw(Rng& rng) const {
  CoreState z{};
  for (std::size_t i = 0; i < num_; ++i) z[i] = kWidening * rng.normal();
  for (std::size_t i = num_; i-- > 0;) {  // rootᵀ z = normal
    for (std::size_t k = i + 1; k < num_; ++k) z[i] -= root_[k][i] * z[k];
    z[i] /= root_[i][i];
  }
  for (std::size_t i = 0; i < num_; ++i) z[i] += mean_[i];
  return z;
}

double FittedCoreProposal::log_density(const CoreState& state) const {
  double square = 0;
  for (std::size_t i = 0; i < num_; ++i) {
    double u = 0;
    for (std::size_t k = i; k < num_; ++k) u += root_[k][i] * (state[k] - mean_[k]);
    square += u * u;
  }
  return log_norm_ - 0.5 * square / (kWidening * kWidening);
}

CoreState FittedCoreProposal::step(BaseKind kind, const CoreState& state, Rng& rng) const {
  constexpr std::array<double, 3> kSizes{0.02, 0.08, 0.3};
  CoreState z = state;
  const double size = kSizes[rng.below(kSizes.size())];
  z[kCoreX] += size * rng.normal();
  z[kCoreY] += size * rng.normal();
  z[kCoreLogScale] += 0.5 * size * rng.normal();
  z[kCoreAmplitude] += size * std::abs(prior_.amplitude.mean) * rng.normal();
  if (!is_round(kind)) z[kCoreAngle] += size * rng.normal();
  return z;
}

}  // namespace motex
