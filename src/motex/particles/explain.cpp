// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/explain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/element_likelihood.h"

namespace motex {
namespace {

constexpr double kUniformShare = 0.2;                     // of places: the map says what it saw, not what there can be
constexpr double kUsualSurprise = 2, kMostSurprise = 20;  // deviations
constexpr double kLeastHazard = 0.002, kMostHazard = 0.9;

/// Number of elements born in a frame: negative binomial with the mean and variance seen, at least those of a Poisson.
class CountLikelihood {
 public:
  explicit CountLikelihood(const std::vector<double>& counts) {
    // One frame of one birth keeps a model without births from being sure of it.
    double sum = 1, square = 1, num = 1;
    for (const double count : counts) {
      sum += count;
      square += count * count;
      num += 1;
    }
    mean_ = sum / num;
    const double variance = square / num - mean_ * mean_;
    size_ = mean_ * mean_ / std::max(variance - mean_, 0.02 * mean_);
  }
  double operator()(double count) const {
    const double share = mean_ / (mean_ + size_);
    return std::lgamma(count + size_) - std::lgamma(size_) - std::lgamma(count + 1) + size_ * std::log1p(-share) +
           count * std::log(share);
  }

 private:
  double mean_ = 1, size_ = 1;
};

/// A map read at the places of a clip of another size.
class ScaledMap {
 public:
  ScaledMap(const Plane& plane, const TexturedMotion& observed)
      : plane_(plane),
        x_(static_cast<double>(plane.width) / observed.width),
        y_(static_cast<double>(plane.height) / observed.height) {}
  double at(double x, double y) const {
    const int column = std::clamp(static_cast<int>((x + 0.5) * x_), 0, plane_.width - 1),
              row = std::clamp(static_cast<int>((y + 0.5) * y_), 0, plane_.height - 1);
    return static_cast<double>(plane_.at(column, row));
  }
  double pixel_share() const { return x_ * y_; }  ///< of the map's pixels in one of the clip

 private:
  const Plane& plane_;
  double x_, y_;
};

double sum_of(const Plane& plane) {
  double sum = 0;
  for (const float value : plane.values) sum += static_cast<double>(value);
  return sum;
}

std::vector<double> births_by_frame(const TexturedMotion& clip) {
  std::vector<double> births(static_cast<std::size_t>(std::max<std::int64_t>(1, clip.num_frames)), 0);
  for (const Cable& cable : clip.cables)
    if (cable.first_frame >= 0 && cable.first_frame < clip.num_frames)
      births[static_cast<std::size_t>(cable.first_frame)] += 1;
  return births;
}

/// Elements in each frame.
std::vector<double> elements_by_frame(const TexturedMotion& clip) {
  std::vector<double> elements(static_cast<std::size_t>(std::max<std::int64_t>(1, clip.num_frames)), 0);
  for (const Cable& cable : clip.cables)
    for (std::int64_t frame = std::max<std::int64_t>(0, cable.first_frame);
         frame < std::min(cable.end_frame(), clip.num_frames); ++frame)
      elements[static_cast<std::size_t>(frame)] += 1;
  return elements;
}

/// A model made ready to score clips.
class Explainer {
 public:
  explicit Explainer(const TexturedMotion& model) : model_(model), species_(species_of(model)) {
    maps_ = model.maps;
    if (maps_.width == 0 || maps_.source.values.empty() || maps_.hazard.values.empty())
      maps_ = estimate_maps(model.cables, model.width, model.height, std::max<std::int64_t>(1, model.num_frames));
    total_source_ = sum_of(maps_.source);
    total_occupancy_ = sum_of(maps_.occupancy);
  }

  /// nats: −log p of every step.
  Explanation score(const TexturedMotion& observed, std::vector<std::vector<double>>& nats) const {
    Explanation result;
    result.num_frames = static_cast<double>(observed.num_frames);
    score_counts(observed, result);
    for (const Cable& cable : observed.cables) {
      nats.push_back(score_cable(cable, observed, result));
      result.num_elements += static_cast<double>(cable.num_frames());
    }
    return result;
  }

 private:
  void score_counts(const TexturedMotion& observed, Explanation& result) const {
    std::vector<double> known = births_by_frame(model_), seen = births_by_frame(observed);
    known.erase(known.begin());
    const CountLikelihood births(known), elements(elements_by_frame(model_));
    result.births += elements(seen[0]);
    for (std::size_t k = 1; k < seen.size(); ++k) result.births += births(seen[k]);
  }

  /// log density of a place under a map of any total.
  double place(const Plane& map, double total, const Base& base, const TexturedMotion& observed) const {
    const ScaledMap scaled(map, observed);
    const double uniform = 1.0 / (static_cast<double>(observed.width) * observed.height);
    const double density = total > 0 ? scaled.at(base.x, base.y) / total * scaled.pixel_share() : uniform;
    return std::log((1 - kUniformShare) * density + kUniformShare * uniform);
  }

  std::vector<double> score_cable(const Cable& cable, const TexturedMotion& observed, Explanation& result) const {
    std::vector<double> amplitudes;
    for (const Base& base : cable.core) {
      Base grey = base;
      grey.coefficients[0] = static_cast<float>(luma_coefficient(base, observed.num_planes));
      amplitudes.push_back(peak_amplitude(grey));
    }
    // Σ over species; its parts are shared out as in the species that explains the cable best.
    std::vector<CableLikelihood> all;
    double best = -1e300, sum = 0;
    std::size_t best_idx = 0;
    for (const SpeciesLikelihood& species : species_) {
      all.push_back(likelihood_of(cable, amplitudes, species));
      const double nats = species.log_share + all.back().looks + all.back().motion;
      if (nats > best) {
        best = nats;
        best_idx = all.size() - 1;
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k)
      sum += std::exp(species_[k].log_share + all[k].looks + all[k].motion - best);
    CableLikelihood& chosen = all[best_idx];
    const double rest = best + std::log(sum) - chosen.looks - chosen.motion;
    result.looks += chosen.looks + rest;
    result.motion += chosen.motion;
    chosen.steps.front() += rest;

    const bool is_born = cable.first_frame > 0;
    const double birth = is_born ? place(maps_.source, total_source_, cable.core.front(), observed)
                                 : place(maps_.occupancy, total_occupancy_, cable.core.front(), observed);
    result.places += birth;
    chosen.steps.front() += birth;
    add_fate(cable, observed, chosen.steps, result);
    for (double& step : chosen.steps) step = -step;
    return std::move(chosen.steps);
  }

  void add_fate(const Cable& cable, const TexturedMotion& observed, std::vector<double>& steps,
                Explanation& result) const {
    const ScaledMap hazard(maps_.hazard, observed);
    for (std::size_t k = 0; k < cable.core.size(); ++k) {
      if (cable.first_frame + static_cast<std::int64_t>(k) >= observed.num_frames - 1) break;
      const double h = std::clamp(hazard.at(cable.core[k].x, cable.core[k].y), kLeastHazard, kMostHazard);
      const double nats = k + 1 < cable.core.size() ? std::log1p(-h) : std::log(h);
      result.deaths += nats;
      steps[k] += nats;
    }
  }

  const TexturedMotion& model_;
  std::vector<SpeciesLikelihood> species_;
  BirthDeathMaps maps_;
  double total_source_ = 0, total_occupancy_ = 0;
};

/// Mean and deviation of what the model's own elements cost, at birth and after.
struct Usual {
  SeenNumbers birth, step;
};

Usual usual_of(const std::vector<std::vector<double>>& nats) {
  std::vector<double> births, steps;
  for (const std::vector<double>& cable : nats)
    for (std::size_t k = 0; k < cable.size(); ++k) (k == 0 ? births : steps).push_back(cable[k]);
  return {SeenNumbers::of(births, 15, 0.5), SeenNumbers::of(steps, 5, 0.5)};
}

/// Every element is now and then a little surprising.
double excess_of(double surprise) { return std::clamp(surprise - kUsualSurprise, 0.0, kMostSurprise); }

}  // namespace

Explanation explain_cables(const TexturedMotion& model, const TexturedMotion& observed) {
  if (model.cables.empty())
    throw InvalidInput("a model without elements explains nothing; learn it from a longer clip");
  if (observed.cables.empty() || observed.width < 1 || observed.height < 1 || observed.num_frames < 1)
    throw InvalidInput("nothing was followed in the clip");
  const Explainer explainer(model);
  std::vector<std::vector<double>> own, nats;
  explainer.score(model, own);
  const Usual usual = usual_of(own);
  Explanation result = explainer.score(observed, nats);
  for (std::vector<double>& cable : nats)
    for (std::size_t k = 0; k < cable.size(); ++k) {
      const SeenNumbers& seen = k == 0 ? usual.birth : usual.step;
      cable[k] = (cable[k] - seen.mean) / seen.deviation;
    }
  result.surprise = std::move(nats);
  return result;
}

std::vector<double> model_probabilities(const std::vector<Explanation>& explanations) {
  std::vector<double> shares;
  double best = -1e300, sum = 0;
  for (const Explanation& one : explanations) best = std::max(best, one.total());
  for (const Explanation& one : explanations) sum += shares.emplace_back(std::exp(one.total() - best));
  for (double& share : shares) share /= sum;
  return shares;
}

Plane abnormality_map(const TexturedMotion& observed, const Explanation& explanation, double bandwidth) {
  Plane sum(observed.width, observed.height);
  const int reach = static_cast<int>(std::ceil(3 * bandwidth));
  for (std::size_t c = 0; c < observed.cables.size(); ++c) {
    const Cable& cable = observed.cables[c];
    for (std::size_t k = 0; k < cable.core.size(); ++k) {
      const Base& base = cable.core[k];
      const double excess = excess_of(explanation.surprise[c][k]);
      if (excess == 0) continue;
      const int column = static_cast<int>(std::lround(base.x)), row = static_cast<int>(std::lround(base.y));
      for (int y = std::max(0, row - reach); y <= std::min(observed.height - 1, row + reach); ++y)
        for (int x = std::max(0, column - reach); x <= std::min(observed.width - 1, column + reach); ++x) {
          const double dx = x - base.x, dy = y - base.y;
          sum.at(x, y) += static_cast<float>(excess * std::exp(-(dx * dx + dy * dy) / (2 * bandwidth * bandwidth)));
        }
    }
  }
  return sum;
}

std::vector<double> abnormality_over_time(const TexturedMotion& observed, const Explanation& explanation) {
  std::vector<double> sum(static_cast<std::size_t>(std::max<std::int64_t>(0, observed.num_frames)), 0);
  for (std::size_t c = 0; c < observed.cables.size(); ++c)
    for (std::size_t k = 0; k < observed.cables[c].core.size(); ++k) {
      const std::int64_t frame = observed.cables[c].first_frame + static_cast<std::int64_t>(k);
      if (frame >= 0 && frame < observed.num_frames)
        sum[static_cast<std::size_t>(frame)] += excess_of(explanation.surprise[c][k]);
    }
  return sum;
}

}  // namespace motex
