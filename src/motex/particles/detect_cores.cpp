// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/detect_cores.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/particles/blob_peaks.h"
#include "motex/particles/cable.h"

namespace motex {
namespace {

constexpr int kRounds = 3;                // searches of what the spots found so far leave
constexpr double kRoundAspect = 1.5;      // a core below that is a Gaussian
constexpr double kGaussianMisfit = 0.04;  // up to that an element is a Gaussian, from twice that it has parts
constexpr int kCleanings = 4;
constexpr double kSuspicious = 2;    // deviations of the mean square of what a spot leaves
constexpr double kSplitGain = 35;    // of the squared error in squared noises, for four more parameters
constexpr double kAgreement = 0.4;   // of the amplitude expected: the frame agrees with a guess
constexpr double kMergeReach = 1.5;  // deviations of a spot within which others may be merged in it
constexpr double kMergeLoss = 10;    // of what a fit minimises, for spots that longer paths lead to
constexpr double kWeakRatio = 0.2;   // of a stronger spot's peak there: a part of it
constexpr double kMostLight = 1.2;   // of the most light of a pixel: more of it no spot shows

/// Distance of (x, y) from a spot in its deviations.
double distance_in(const Blob& blob, double x, double y) {
  const double dx = x - blob.x, dy = y - blob.y;
  if (blob.e1 == 0 && blob.e2 == 0) return std::sqrt(dx * dx + dy * dy) / blob.scale();
  const double c = std::cos(blob.angle()), s = std::sin(blob.angle()), e = std::hypot(blob.e1, blob.e2) / 2;
  return std::hypot((dx * c + dy * s) / std::exp(e), (dy * c - dx * s) / std::exp(-e)) / blob.scale();
}

/// Largest |value|.
double largest_of(const Plane& plane) {
  float largest = 0;
  for (const float value : plane.values) largest = std::max(largest, std::abs(value));
  return static_cast<double>(largest);
}

/// Height of a spot twice as wide at (x, y): how far its neighbourhood reaches.
double shadow(const Blob& blob, double x, double y) {
  const double distance = distance_in(blob, x, y) / 2;
  return std::abs(blob.amplitude) * std::exp(-0.5 * distance * distance);
}

class Detector {
 public:
  Detector(const Plane& residual, double noise, const DetectOptions& options)
      : noise_(noise),
        options_(options),
        fitter_(residual, fit_options(residual, noise, options)),
        structure_(std::clamp((options.shape_misfit - kGaussianMisfit) / kGaussianMisfit, 0.0, 1.0)) {}

  /// Those seen before first, then the guesses where what is left agrees with them.
  void expect(const std::vector<ExpectedBlob>& expected) {
    for (const ExpectedBlob& one : expected)
      if (one.is_seen) fitter_.add(one.blob, one.prior);
    fitter_.fit(3);
    std::vector<int> num_sights;
    for (const ExpectedBlob& one : expected)
      if (one.is_seen) num_sights.push_back(one.num_sights);
    std::vector<Rivals> rivals(num_sights.size());
    for (const ExpectedBlob& one : expected) {
      if (one.is_seen) continue;
      if (one.blob.amplitude * left_amplitude(one.blob) > kAgreement * one.blob.amplitude * one.blob.amplitude)
        fitter_.add(one.blob, one.prior);
      else if (const int idx = in_the_way_of(one, num_sights); idx >= 0)
        rivals[static_cast<std::size_t>(idx)].emplace_back(one.blob, one.prior);
    }
    fitter_.fit(2);
    for (std::size_t k = 0; k < rivals.size(); ++k)
      if (!rivals[k].empty()) fitter_.add_beside(k, rivals[k], kMergeLoss);
    clean_up();
    has_expected_ = !expected.empty();
  }

  std::vector<Blob> run() {
    for (int round = has_expected_ ? 1 : 0; round < kRounds; ++round) {
      if (!add_peaks(round)) break;
      fitter_.fit(3);
      clean_up();
    }
    if (split_pairs()) {
      fitter_.fit(2);
      clean_up();
    }
    return fitter_.blobs();
  }

  const Plane& left() const { return fitter_.residual(); }

 private:
  using Rivals = std::vector<std::pair<Blob, BlobPrior>>;

  /// The spot of a shorter path that has the light of this guess: two elements that pass one another, or come out of
  /// one place, are one spot for a while. −1 = none.
  int in_the_way_of(const ExpectedBlob& guess, const std::vector<int>& num_sights) const {
    int nearest = -1;
    double least = kMergeReach;
    for (std::size_t k = 0; k < num_sights.size(); ++k) {
      if (num_sights[k] >= guess.num_sights) continue;
      const double distance = distance_in(fitter_.blobs()[k], guess.blob.x, guess.blob.y);
      if (distance >= least) continue;
      least = distance;
      nearest = static_cast<int>(k);
    }
    return nearest;
  }

  static FitBlobsOptions fit_options(const Plane& residual, double noise, const DetectOptions& options) {
    // What elements are not Gaussian by is noise to their fit.
    const double misfit =
        std::max(0.0, options.shape_misfit - 0.75 * kGaussianMisfit) * options.min_amplitude / kFaintShare;
    FitBlobsOptions fit{std::hypot(noise, misfit), options.shape == CoreShape::kOriented, 0.8 * options.min_scale,
                        1.25 * options.max_scale};
    if (options.sign == CoreSign::kBoth) fit.max_light = kMostLight * largest_of(residual);
    return fit;
  }

  bool add_peaks(int round) {
    const std::size_t num_before = fitter_.blobs().size();
    const std::vector<BlobPeak> peaks =
        find_blob_peaks(fitter_.residual(), round == 0 ? options_.max_scale : std::min(3.0, options_.max_scale),
                        options_.min_significance * noise_, options_.sign == CoreSign::kBoth);
    for (const BlobPeak& peak : peaks) {
      if (std::abs(peak.amplitude) < 0.7 * options_.min_amplitude || is_shadowed(peak, num_before)) continue;
      fitter_.add({peak.x, peak.y, std::log(peak.scale), 0, 0, peak.amplitude});
    }
    return fitter_.blobs().size() > num_before;
  }

  /// Too near to another new one, or no more than a stronger spot's misfit.
  bool is_shadowed(const BlobPeak& peak, std::size_t num_before) const {
    const std::vector<Blob>& blobs = fitter_.blobs();
    const double least = weakest_beside();
    const double reach = 10 * options_.max_scale;
    for (std::size_t k = 0; k < blobs.size(); ++k) {
      if (std::abs(blobs[k].x - peak.x) > reach || std::abs(blobs[k].y - peak.y) > reach) continue;
      if (k < num_before && std::abs(blobs[k].amplitude) * least < std::abs(peak.amplitude)) continue;
      const double distance = std::hypot(blobs[k].x - peak.x, blobs[k].y - peak.y);
      if (k >= num_before && distance < (0.8 + 1.7 * structure_) * std::max(blobs[k].scale(), peak.scale)) return true;
      if (k < num_before && std::abs(peak.amplitude) < least * shadow(blobs[k], peak.x, peak.y)) return true;
    }
    return false;
  }

  /// Spots that leave more than noise and misfit may be two.
  bool split_pairs() {
    const std::size_t num = fitter_.blobs().size();
    for (std::size_t k = 0; k < num; ++k) {
      const Blob& blob = fitter_.blobs()[k];
      const double misfit = options_.shape_misfit * blob.amplitude, expected = noise_ * noise_ + 4 * misfit * misfit;
      const double num_pixels = 4 * std::numbers::pi * blob.scale() * blob.scale();
      if (fitter_.misfit(k) < expected * (1 + kSuspicious * std::sqrt(2 / num_pixels))) continue;
      const double least = kSplitGain * noise_ * noise_ + 4 * misfit * misfit * num_pixels;
      fitter_.split(k, least / (fitter_.noise() * fitter_.noise()));
    }
    return fitter_.blobs().size() > num;
  }

  /// Of a spot, what is asked of every pair.
  struct Facts {
    double x, y, scale, energy, reach_square;
  };
  void list_facts() {
    facts_.clear();
    for (const Blob& blob : fitter_.blobs()) {
      const double scale = blob.scale(), reach = 6 * scale * std::sqrt(blob.aspect());
      facts_.push_back({blob.x, blob.y, scale, blob.energy_root(), reach * reach});
    }
  }

  void clean_up() {
    for (int k = 0; k < kCleanings && remove_doubtful(); ++k) fitter_.fit(2);
  }

  /// Takes away spots that the fit has shown not to be elements; of two that overlap only the weaker: the other may be
  /// sound without it.
  bool remove_doubtful() {
    list_facts();
    std::vector<std::size_t> doubtful, gone;
    for (std::size_t k = 0; k < facts_.size(); ++k)
      if (is_doubtful(k)) doubtful.push_back(k);
    for (const std::size_t k : doubtful) {
      bool is_weakest = true;
      for (const std::size_t m : doubtful) {
        const double near = 2 * (facts_[k].scale + facts_[m].scale);
        if (m == k || square_distance(facts_[k], facts_[m]) > near * near) continue;
        is_weakest = is_weakest && std::make_pair(facts_[k].energy, k) < std::make_pair(facts_[m].energy, m);
      }
      if (is_weakest) gone.push_back(k);
    }
    for (auto k = gone.rbegin(); k != gone.rend(); ++k) fitter_.remove(*k);
    return !gone.empty();
  }

  static double square_distance(const Facts& a, const Facts& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
  }

  bool is_doubtful(std::size_t k) const {
    const std::vector<Blob>& blobs = fitter_.blobs();
    const Blob& blob = blobs[k];
    const Facts& own = facts_[k];
    if (options_.sign != CoreSign::kBoth && blob.amplitude <= 0) return true;
    if (std::abs(blob.amplitude) < 0.7 * options_.min_significance * blob.amplitude_spread) return true;
    if (std::abs(blob.amplitude) < options_.min_amplitude) return true;
    if (own.scale > 1.2 * options_.max_scale) return true;
    if (own.energy < options_.min_significance * noise_ * 0.7) return true;
    for (std::size_t m = 0; m < blobs.size(); ++m) {
      const Facts& other = facts_[m];
      const double distance = square_distance(own, other);
      if (distance > other.reach_square || m == k || other.energy < own.energy) continue;
      const double least = 0.3 * std::min(own.scale, other.scale);
      if (distance < least * least) return true;
      if (std::abs(blob.amplitude) < weakest_beside() * shadow(blobs[m], blob.x, blob.y)) return true;
      if (structure_ <= 0) continue;
      const double deviations = distance_in(blobs[m], blob.x, blob.y);
      if (deviations < 2.5 * structure_ || (deviations < 4 * structure_ && own.energy < 0.5 * other.energy))
        return true;
    }
    return false;
  }

  /// Amplitude that the spot would have if it were fitted to what is left, its shape and place fixed.
  double left_amplitude(const Blob& blob) const {
    const Plane& left = fitter_.residual();
    const double reach = 2 * blob.scale() * std::sqrt(blob.aspect());
    const double c = std::cos(blob.angle()), s = std::sin(blob.angle()), e = std::hypot(blob.e1, blob.e2) / 2;
    double product = 0, energy = 0;
    for (int y = std::max(0, static_cast<int>(std::ceil(blob.y - reach)));
         y <= std::min(left.height - 1, static_cast<int>(std::floor(blob.y + reach))); ++y)
      for (int x = std::max(0, static_cast<int>(std::ceil(blob.x - reach)));
           x <= std::min(left.width - 1, static_cast<int>(std::floor(blob.x + reach))); ++x) {
        const double dx = x - blob.x, dy = y - blob.y;
        const double u = (dx * c + dy * s) / (blob.scale() * std::exp(e)),
                     v = (dy * c - dx * s) / (blob.scale() * std::exp(-e));
        const double g = std::exp(-0.5 * (u * u + v * v));
        product += g * static_cast<double>(left.at(x, y));
        energy += g * g;
      }
    return energy > 0.5 ? product / energy : 0;
  }

  /// Of the height of a stronger one's shadow: less is a part of that.
  double weakest_beside() const { return std::max(kWeakRatio, 5 * options_.shape_misfit); }

  double noise_;
  DetectOptions options_;
  BlobFitter fitter_;
  std::vector<Facts> facts_;
  double structure_;  ///< 0 = elements are Gaussian, 1 = they have parts: none near a stronger one
  bool has_expected_ = false;
};

}  // namespace

std::vector<Blob> detect_blobs(const Plane& residual, double noise, const DetectOptions& options,
                               const std::vector<ExpectedBlob>& expected, Plane* left) {
  const bool is_open = options.sign == CoreSign::kAuto || options.shape == CoreShape::kAuto;
  const DetectOptions chosen = is_open ? decided(options, {residual}, noise) : options;
  const bool is_dark = chosen.sign == CoreSign::kDark;
  Detector detector(is_dark ? negated(residual) : residual, noise, chosen);
  if (is_dark) {
    std::vector<ExpectedBlob> turned = expected;
    for (ExpectedBlob& one : turned) {
      one.blob.amplitude = -one.blob.amplitude;
      one.prior.mean[5] = -one.prior.mean[5];
    }
    detector.expect(turned);
  } else {
    detector.expect(expected);
  }
  std::vector<Blob> blobs = detector.run();
  if (left != nullptr) *left = is_dark ? negated(detector.left()) : detector.left();
  if (is_dark)
    for (Blob& blob : blobs) blob.amplitude = -blob.amplitude;
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const Blob& a, const Blob& b) { return a.energy_root() > b.energy_root(); });
  return blobs;
}

BaseKind core_kind(double aspect) { return aspect >= kRoundAspect ? BaseKind::kStreak : BaseKind::kGaussian; }

Base core_of(const Blob& blob) { return core_of(blob, core_kind(blob.aspect())); }

Base core_of(const Blob& blob, BaseKind kind) {
  Base base{kind, blob.x, blob.y, blob.scale(), 0, {}};
  double stretch = blob.aspect();  // of the spot against the base, which is as large as it
  if (kind == BaseKind::kStreak) {
    base.scale /= std::sqrt(kGaborElongation);
    base.angle = std::fmod(blob.angle() + std::numbers::pi / 2, std::numbers::pi);
    stretch /= kGaborElongation;
  }
  base.scale = std::clamp(base.scale, 0.6, 10.0);
  const double projected = 2 * std::sqrt(stretch) / (1 + stretch);  // ⟨spot, ψ⟩ / ⟨ψ, ψ⟩ for peaks of 1
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, projected * blob.amplitude));
  return base;
}

std::vector<Base> detect_cores(const Plane& residual, double noise, const DetectOptions& options) {
  std::vector<Base> cores;
  for (const Blob& blob : detect_blobs(residual, noise, options)) cores.push_back(core_of(blob));
  return cores;
}

}  // namespace motex
