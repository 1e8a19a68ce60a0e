// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/detect_shaped.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motex/particles/blob_peaks.h"
#include "motex/particles/shape_fit.h"

namespace motex {
namespace {

constexpr int kSearches = 2;            // of what the elements found so far leave
constexpr double kKeptGain = 0.25;      // of the energy of an element as it is expected: it is there
constexpr double kKeptAgreement = 0.2;  // share of the light under it
constexpr double kGuessAgreement = 0.35;
constexpr double kNewAgreement = 0.5;
constexpr double kLeastGain = 60;   // of the squared error in squared noises
constexpr double kFaintest = 0.35;  // of the usual amplitude
constexpr double kNear = 2.5;       // scales of both: elements that may explain the same light
constexpr double kNeeded = 0.4;     // of the energy of an element, by which it must lower the squared error
constexpr double kApart = 0.6;      // scales between two elements, at least
constexpr std::pair<double, double> kOff[] = {
    {-1, 0}, {0, 0}, {1, 0}, {0, -1.3}, {0, 1.3}};  // deviations of sizes, turns
constexpr double kLeastSpread = 0.06;  // core scales: the pictures of states do not agree better on where the core is
constexpr double kLeastLevelSpread = 0.08;  // of ln scale and ln amplitude: nor on how large and dark it is
constexpr double kCrowdSpread = 0.3;        // core scales, of an element right above another one
constexpr double kPopulation = 1.5;         // deviations of sizes and amplitudes, widened: learned from few

class ShapedDetector {
 public:
  ShapedDetector(const Plane& residual, const ElementShapes& shapes, const DetectOptions& options, double noise)
      : shapes_(shapes), options_(options), noise_(noise), fitter_(residual, shapes, shapes.noise) {
    const double scale = kPopulation * shapes.log_scale_deviation, amplitude = kPopulation * shapes.amplitude_deviation;
    const double turn = kPopulation * shapes.turn_deviation;
    population_.mean = {0, 0, shapes.mean_log_scale, shapes.mean_amplitude, shapes.mean_turn};
    population_.precision = {0, 0, 1 / (scale * scale), 1 / (amplitude * amplitude), 1 / (turn * turn)};
  }

  /// Those seen before all together first, since each is in the light of the others; then the guesses.
  void expect(const std::vector<ExpectedBlob>& expected) {
    for (const ExpectedBlob& one : expected)
      if (one.is_seen) add_seen(one);
    fitter_.fit(4);
    clean_up();
    for (const ExpectedBlob& one : expected)
      if (!one.is_seen) add_guess(one);
    fitter_.fit(2);
    clean_up();
  }

  void search() {
    for (int k = 0; k < kSearches; ++k) {
      const std::size_t before = fitter_.elements().size();
      for (const BlobPeak& peak :
           find_blob_peaks(fitter_.left(), options_.max_scale, options_.min_significance * noise_, true))
        add_peak(peak);
      if (fitter_.elements().size() == before) break;
      fitter_.fit(3);
      clean_up();
    }
    remove_needless();
  }

  std::vector<Blob> cores() const {
    std::vector<Blob> out;
    for (const ShapedElement& e : fitter_.elements()) {
      Blob& blob = out.emplace_back(shapes_.core);
      blob.x = e.x;
      blob.y = e.y;
      blob.log_scale += e.log_scale;
      blob.amplitude *= e.amplitude;
      blob.turn = e.turn;
      blob.seen_x = e.x;
      blob.seen_y = e.y;
      blob.seen_spread = blob.place_spread =
          std::hypot(e.place_spread, blob.scale() * (kLeastSpread + kCrowdSpread * crowding(e)));
      blob.log_scale_spread = std::hypot(e.log_scale_spread, kLeastLevelSpread);
      blob.amplitude_spread =
          std::hypot(e.amplitude_spread * std::abs(shapes_.core.amplitude), kLeastLevelSpread * blob.amplitude);
    }
    return out;
  }

  const Plane& left() const { return fitter_.left(); }

 private:
  /// 1 = right above another element, 0 = none is near.
  double crowding(const ShapedElement& one) const {
    double most = 0;
    for (const ShapedElement& other : fitter_.elements()) {
      const double reach = kNear * (std::exp(one.log_scale) + std::exp(other.log_scale));
      if (&other != &one) most = std::max(most, 1 - std::hypot(other.x - one.x, other.y - one.y) / reach);
    }
    return most;
  }

  /// Σ (…)² / noise² of the element alone, as it is expected, roughly: of its core.
  double core_energy(double log_scale, double amplitude) const {
    const double scale = std::exp(log_scale + shapes_.core.log_scale), peak = amplitude * shapes_.core.amplitude;
    return 3.14 * scale * scale * peak * peak / (fitter_.noise() * fitter_.noise());
  }

  ShapedPrior prior_of(const ExpectedBlob& one) const {
    ShapedPrior prior = population_;
    if (one.prior.precision[2] <= 0) return prior;
    const double a = shapes_.core.amplitude;
    prior.mean = {one.prior.mean[0], one.prior.mean[1], one.prior.mean[2] - shapes_.core.log_scale,
                  one.prior.mean[5] / a, one.blob.turn};
    prior.precision = {one.prior.precision[0], one.prior.precision[1], one.prior.precision[2],
                       one.prior.precision[5] * a * a, std::max(one.turn_precision, population_.precision[4])};
    return prior;
  }

  ShapedElement element_of(const ExpectedBlob& one, const ShapedPrior& prior) const {
    ShapedElement element;
    const bool is_known = prior.precision[0] > 0;
    element.x = is_known ? prior.mean[0] : one.blob.x;
    element.y = is_known ? prior.mean[1] : one.blob.y;
    element.log_scale = is_known ? prior.mean[2] : one.blob.log_scale - shapes_.core.log_scale;
    element.amplitude = is_known ? prior.mean[3] : one.blob.amplitude / shapes_.core.amplitude;
    element.turn = one.blob.turn;
    return element;
  }

  void add_seen(const ExpectedBlob& one) {
    const ShapedPrior prior = prior_of(one);
    ShapedElement element = element_of(one, prior);
    fitter_.try_one(element, prior);
    fitter_.add(element, prior);
  }

  void add_guess(const ExpectedBlob& one) {
    const ShapedPrior prior = prior_of(one);
    ShapedElement element = element_of(one, prior);
    const double least = kKeptGain * core_energy(element.log_scale, element.amplitude);
    if (fitter_.try_one(element, prior) < std::max(kLeastGain, least) || is_taken(element)) return;
    fitter_.add(element, prior);
    const std::size_t idx = fitter_.elements().size() - 1;
    if (fitter_.agreement(idx) < kGuessAgreement) fitter_.remove(idx);
  }

  bool is_taken(const ShapedElement& element) const {
    return std::any_of(fitter_.elements().begin(), fitter_.elements().end(), [&](const ShapedElement& other) {
      return std::hypot(other.x - element.x, other.y - element.y) <
             kApart * std::exp(std::max(other.log_scale, element.log_scale));
    });
  }

  void add_peak(const BlobPeak& peak) {
    const bool is_bright = shapes_.mean_amplitude > 0;
    if (options_.sign != CoreSign::kBoth && (peak.amplitude > 0) != is_bright) return;
    if (std::abs(peak.amplitude) < 0.5 * kFaintest * std::abs(shapes_.mean_amplitude)) return;
    ShapedElement best;
    double most = -1e300;
    for (const auto& [size, turn] : kOff) {
      if (turn != 0 && !shapes_.are_turned()) continue;
      ShapedElement one;
      one.x = peak.x;
      one.y = peak.y;
      one.log_scale = shapes_.mean_log_scale + size * shapes_.log_scale_deviation;
      one.amplitude = shapes_.mean_amplitude;
      one.turn = shapes_.mean_turn + turn * shapes_.turn_deviation;
      const double gain = fitter_.try_one(one, population_);
      if (gain <= most) continue;
      most = gain;
      best = one;
    }
    if (most < kLeastGain || std::abs(best.amplitude) < kFaintest * std::abs(shapes_.mean_amplitude)) return;
    if (is_taken(best)) return;
    fitter_.add(best, population_);
    const std::size_t idx = fitter_.elements().size() - 1;
    if (fitter_.agreement(idx) < kNewAgreement) fitter_.remove(idx);
  }

  void clean_up() {
    for (std::size_t k = fitter_.elements().size(); k-- > 0;) {
      const ShapedElement e = fitter_.elements()[k];
      const bool stays = fitter_.gain(k) > std::max(kLeastGain, kKeptGain * core_energy(e.log_scale, e.amplitude)) &&
                         fitter_.agreement(k) > kKeptAgreement;
      if (!stays) fitter_.remove(k);
    }
    fitter_.fit(2);
  }

  bool has_neighbour(std::size_t idx) const {
    const std::vector<ShapedElement>& all = fitter_.elements();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (k != idx && std::hypot(all[k].x - all[idx].x, all[k].y - all[idx].y) <
                          kNear * (std::exp(all[k].log_scale) + std::exp(all[idx].log_scale)))
        return true;
    return false;
  }

  /// Elements that no path led to, without which their neighbours explain the frame nearly as well.
  void remove_needless() {
    for (std::size_t k = fitter_.elements().size(); k-- > 0;) {
      if (fitter_.prior(k).precision[0] > 0 || !has_neighbour(k)) continue;
      ShapeFitter without = fitter_;
      without.remove(k);
      without.fit(2);
      if (without.error() - fitter_.error() < kNeeded * fitter_.energy(k)) fitter_ = without;
    }
  }

  const ElementShapes& shapes_;
  const DetectOptions& options_;
  double noise_;
  ShapedPrior population_;
  ShapeFitter fitter_;
};

}  // namespace

std::vector<Blob> detect_shaped_blobs(const Plane& residual, const ElementShapes& shapes, const DetectOptions& options,
                                      double noise, const std::vector<ExpectedBlob>& expected, Plane* left) {
  ShapedDetector detector(residual, shapes, options, noise);
  detector.expect(expected);
  detector.search();
  if (left != nullptr) *left = detector.left();
  std::vector<Blob> cores = detector.cores();
  std::stable_sort(cores.begin(), cores.end(), [](const Blob& a, const Blob& b) {
    return std::abs(a.amplitude) * a.scale() > std::abs(b.amplitude) * b.scale();
  });
  return cores;
}

}  // namespace motex
