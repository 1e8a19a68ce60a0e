// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/screen_surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motex/core/quantile.h"

namespace motex {
namespace {

using Colour = Eigen::Vector3d;
using Terms = Eigen::Matrix<double, 6, 1>;

constexpr int kCellsAcross = 40;
constexpr double kBorder = 0.12;                              // share of the frame's sides that counts as border
constexpr double kBorderWeight = 3;                           // of a sample near the border, where the actor seldom is
constexpr int kBins = 16;                                     // of a channel
constexpr double kMostSpread = 10, kMostSpreadColoured = 26;  // grey levels around the surface
constexpr double kMinShare = 0.2, kMinBorderShare = 0.4;

/// Mean colour of a small square of one frame.
struct Sample {
  Colour colour;
  double x, y;  // −1 … 1
  bool at_border;
};

Terms terms_of(double x, double y) { return Terms{1, x, y, x * x, x * y, y * y}; }

Colour mean_colour(const Image& image, int left, int top, int side) {
  Colour sum = Colour::Zero();
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      const Rgba& p = image.at(x, y);
      sum += Colour(p.r, p.g, p.b);
    }
  }
  return sum / (side * side);
}

std::vector<Sample> samples_of(std::span<const Image> frames, const Mask* garbage) {
  const int width = frames[0].width, height = frames[0].height;
  const int step = std::max(1, std::max(width, height) / kCellsAcross), side = std::min(4, step);
  std::vector<Sample> samples;
  for (const Image& frame : frames) {
    for (int top = 0; top + side <= height; top += step) {
      for (int left = 0; left + side <= width; left += step) {
        if (garbage != nullptr && garbage->at(left, top)) continue;
        const double x = (left + side / 2.0) / width * 2 - 1, y = (top + side / 2.0) / height * 2 - 1;
        const bool at_border = std::abs(x) > 1 - 2 * kBorder || y < 2 * kBorder - 1;
        samples.push_back({mean_colour(frame, left, top, side), x, y, at_border});
      }
    }
  }
  return samples;
}

double weight_of(const Sample& sample) { return sample.at_border ? kBorderWeight : 1; }

/// Centre of the 3 × 3 × 3 bins with the most weight, as their mean colour.
Colour commonest_colour(const std::vector<Sample>& samples) {
  std::vector<double> counts(static_cast<std::size_t>(kBins * kBins * kBins));
  const auto bin = [](double level) { return std::clamp(static_cast<int>(level * kBins / 256), 0, kBins - 1); };
  const auto idx = [](int r, int g, int b) { return static_cast<std::size_t>((r * kBins + g) * kBins + b); };
  for (const Sample& s : samples) counts[idx(bin(s.colour[0]), bin(s.colour[1]), bin(s.colour[2]))] += weight_of(s);
  const auto around = [&](int r, int g, int b) {
    double sum = 0;
    for (int dr = -1; dr <= 1; ++dr)
      for (int dg = -1; dg <= 1; ++dg)
        for (int db = -1; db <= 1; ++db)
          if (std::min({r + dr, g + dg, b + db}) >= 0 && std::max({r + dr, g + dg, b + db}) < kBins)
            sum += counts[idx(r + dr, g + dg, b + db)];
    return sum;
  };
  std::array<int, 3> best{};
  double most = -1;
  for (int r = 0; r < kBins; ++r) {
    for (int g = 0; g < kBins; ++g) {
      for (int b = 0; b < kBins; ++b) {
        const double sum = around(r, g, b);
        if (sum > most) most = sum, best = {r, g, b};
      }
    }
  }
  Colour mean = Colour::Zero();
  double weight = 0;
  for (const Sample& s : samples) {
    const bool near = std::abs(bin(s.colour[0]) - best[0]) <= 1 && std::abs(bin(s.colour[1]) - best[1]) <= 1 &&
                      std::abs(bin(s.colour[2]) - best[2]) <= 1;
    if (near) mean += weight_of(s) * s.colour, weight += weight_of(s);
  }
  return mean / weight;
}

/// Whether a colour is the screen's in other light: near k · screen, 0.45 ≤ k ≤ 1.9.
bool is_shade_of(const Colour& colour, const Colour& screen) {
  const double length = screen.squaredNorm();
  const double k = std::clamp(colour.dot(screen) / std::max(length, 1.0), 0.45, 1.9);
  return (colour - k * screen).norm() <= 10 + 0.08 * std::sqrt(length) * k;
}

/// Least squares over the samples with weight > 0.
std::array<std::array<double, 6>, 3> fit(const std::vector<Sample>& samples, const std::vector<double>& weights) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Identity() * 1e-6;
  Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (weights[i] == 0) continue;
    const Terms terms = terms_of(samples[i].x, samples[i].y);
    normal += weights[i] * terms * terms.transpose();
    right += weights[i] * terms * samples[i].colour.transpose();
  }
  const Eigen::Matrix<double, 6, 3> solution = normal.ldlt().solve(right);
  std::array<std::array<double, 6>, 3> coefficients{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 6; ++k)
      coefficients[c][k] = solution(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c));
  return coefficients;
}

double distance_to(const ScreenSurface& surface, const Sample& s) {
  const Terms terms = terms_of(s.x, s.y);
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double level = Eigen::Map<const Terms>(surface.coefficients[c].data()).dot(terms);
    sum += (s.colour[static_cast<Eigen::Index>(c)] - level) * (s.colour[static_cast<Eigen::Index>(c)] - level);
  }
  return std::sqrt(sum);
}

/// Fits, leaves out what is far from the surface (Tukey's biweight, scale by the median), and again.
void settle(ScreenSurface& surface, const std::vector<Sample>& samples, std::vector<double>& weights) {
  constexpr int kRounds = 8;
  std::vector<double> start = weights, residuals;
  for (int round = 0; round < kRounds; ++round) {
    surface.coefficients = fit(samples, weights);
    residuals.clear();
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (start[i] > 0) residuals.push_back(distance_to(surface, samples[i]));
    surface.spread = std::max(1.0, quantile(residuals, 0.5));
    const double limit = 4.7 * surface.spread;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (start[i] == 0) continue;
      const double u = distance_to(surface, samples[i]) / limit;
      weights[i] = u < 1 ? start[i] * (1 - u * u) * (1 - u * u) : 0;
    }
  }
}

}  // namespace

std::array<float, 3> ScreenSurface::at(double x, double y) const {
  const Terms terms = terms_of((x + 0.5) / width * 2 - 1, (y + 0.5) / height * 2 - 1);
  std::array<float, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<float>(Eigen::Map<const Terms>(coefficients[c].data()).dot(terms));
  return colour;
}

std::optional<ScreenSurface> find_screen(std::span<const Image> frames, const Mask* garbage) {
  const std::vector<Sample> samples = samples_of(frames, garbage);
  if (samples.empty()) return std::nullopt;
  const Colour screen = commonest_colour(samples);
  std::vector<double> weights(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    weights[i] = is_shade_of(samples[i].colour, screen) ? weight_of(samples[i]) : 0;
  ScreenSurface surface{frames[0].width, frames[0].height};
  settle(surface, samples, weights);
  double num_border = 0, num_on = 0, num_on_border = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool on = weights[i] > 0;
    num_on += on ? 1 : 0;
    num_border += samples[i].at_border ? 1 : 0;
    num_on_border += on && samples[i].at_border ? 1 : 0;
  }
  surface.share = num_on / static_cast<double>(samples.size());
  surface.border_share = num_on_border / std::max(1.0, num_border);
  // One hue says screen even where its light varies; greys in all shades are a scene.
  const bool coloured = screen.maxCoeff() - screen.minCoeff() > 0.4 * screen.maxCoeff();
  if (surface.spread > (coloured ? kMostSpreadColoured : kMostSpread)) return std::nullopt;
  if (surface.share < kMinShare || surface.border_share < kMinBorderShare) return std::nullopt;
  return surface;
}

}  // namespace motex
