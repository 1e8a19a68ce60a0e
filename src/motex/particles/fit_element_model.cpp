// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/fit_element_model.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace motex {
namespace {

constexpr std::size_t kEnoughSights = 60;    // for anything to be learned
constexpr std::size_t kSightsPerFit = 5000;  // of as many paths as that takes
constexpr double kOutlier = 12;

/// −2 ln likelihood of one coordinate of the paths, the first sights taken as given.
class AxisLikelihood {
 public:
  AxisLikelihood(const std::vector<std::vector<Sight>>& paths, double Sight::*coordinate) {
    std::size_t num_sights = 0, num_long = 0;
    for (const auto& path : paths)
      if (path.size() >= 3) num_long += path.size();
    const std::size_t stride = std::max<std::size_t>(1, num_long / kSightsPerFit);
    std::size_t k = 0;
    for (const auto& path : paths) {
      if (path.size() < 3 || k++ % stride != 0) continue;
      num_sights += path.size();
      starts_.push_back(values_.size());
      for (const Sight& sight : path) {
        values_.push_back(sight.*coordinate);
        variances_.push_back(sight.place_variance);
        frames_.push_back(sight.frame);
      }
    }
    starts_.push_back(values_.size());
    is_enough_ = num_sights >= kEnoughSights;
  }

  bool is_enough() const { return is_enough_; }

  /// Mean displacement a frame.
  double mean_velocity() const {
    double sum = 0, frames = 0;
    for (std::size_t k = 0; k + 1 < starts_.size(); ++k) {
      sum += values_[starts_[k + 1] - 1] - values_[starts_[k]];
      frames += frames_[starts_[k + 1] - 1] - frames_[starts_[k]];
    }
    return frames > 0 ? sum / frames : 0;
  }

  double operator()(const AxisModel& m) const {
    double cost = 0;
    for (std::size_t k = 0; k + 1 < starts_.size(); ++k) {
      const std::size_t first = starts_[k];
      double p = values_[first], v = m.mean_velocity, pp = m.noise_variance + variances_[first], pv = 0,
             vv = m.start_variance;
      for (std::size_t i = first + 1; i < starts_[k + 1]; ++i) {
        for (int step = frames_[i - 1]; step < frames_[i]; ++step) {
          v = m.mean_velocity + m.persistence * (v - m.mean_velocity);
          p += v;
          const double next_vv = m.persistence * m.persistence * vv + m.step_variance, next_pv = m.persistence * pv;
          pp += 2 * next_pv + next_vv;
          pv = next_pv + next_vv;
          vv = next_vv;
        }
        const double noise = m.noise_variance + variances_[i], total = pp + noise, off = values_[i] - p;
        const double square = off * off / total;
        cost += std::log(total) + (square <= kOutlier ? square : kOutlier * (1 + std::log(square / kOutlier)));
        const double inflated = pp + noise * std::max(1.0, square / kOutlier), kp = pp / inflated, kv = pv / inflated;
        p += kp * off;
        v += kv * off;
        vv -= kv * pv;
        pv *= 1 - kp;
        pp *= 1 - kp;
      }
    }
    return cost;
  }

 private:
  std::vector<double> values_, variances_;
  std::vector<int> frames_;
  std::vector<std::size_t> starts_;
  bool is_enough_ = false;
};

/// Golden section within low … high.
double minimise(const std::function<double(double)>& cost, double low, double high, int num_steps) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double cost_a = cost(a), cost_b = cost(b);
  for (int step = 0; step < num_steps; ++step) {
    if (cost_a < cost_b) {
      high = b;
      b = a;
      cost_b = cost_a;
      a = high - kGolden * (high - low);
      cost_a = cost(a);
    } else {
      low = a;
      a = b;
      cost_a = cost_b;
      b = low + kGolden * (high - low);
      cost_b = cost(b);
    }
  }
  return cost_a < cost_b ? a : b;
}

AxisModel fit_axis(const AxisLikelihood& likelihood, AxisModel model) {
  if (!likelihood.is_enough()) return model;
  model.mean_velocity = likelihood.mean_velocity();
  const auto search = [&](double AxisModel::*field, double width, double low, double high) {
    const double start = std::log(model.*field);
    const double best = minimise(
        [&](double value) {
          AxisModel trial = model;
          trial.*field = std::exp(value);
          return likelihood(trial);
        },
        std::max(std::log(low), start - width), std::min(std::log(high), start + width), 7);
    AxisModel trial = model;
    trial.*field = std::exp(best);
    if (likelihood(trial) < likelihood(model)) model = trial;
  };
  for (const double width : {2.0, 1.0, 0.5}) {
    search(&AxisModel::noise_variance, width, 1e-4, 9);
    search(&AxisModel::step_variance, width, 1e-4, 100);
    AxisModel trial = model;
    trial.persistence = minimise(
        [&](double value) {
          AxisModel other = model;
          other.persistence = value;
          return likelihood(other);
        },
        std::max(0.0, model.persistence - 0.3 * width), std::min(0.995, model.persistence + 0.3 * width), 6);
    if (likelihood(trial) < likelihood(model)) model = trial;
    search(&AxisModel::start_variance, width, 1e-3, 1e3);
  }
  return model;
}

/// Variances of a level from mean squared differences one and two sights apart: q + 2r and 2q + 2r a frame.
LevelModel fit_level(const std::vector<std::vector<Sight>>& paths, double Sight::*value, double Sight::*variance,
                     const LevelModel& before) {
  std::vector<double> means, near, far, known;
  for (const auto& path : paths) {
    if (path.size() < 3) continue;
    double sum = 0;
    for (const Sight& sight : path) sum += sight.*value;
    means.push_back(sum / static_cast<double>(path.size()));
    for (std::size_t i = 2; i < path.size(); ++i) {
      const double d1 = path[i].*value - path[i - 1].*value, d2 = path[i].*value - path[i - 2].*value;
      near.push_back(d1 * d1);
      known.push_back(path[i].*variance + path[i - 1].*variance);
      far.push_back(d2 * d2);
    }
  }
  if (near.size() < kEnoughSights) return before;
  // Squares of normal deviates: mean = median / 0.455; overlaps make the tails heavy.
  const auto typical = [](std::vector<double>& squares) {
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return std::max(*middle / 0.455, 1e-8);
  };
  const double one = typical(near), two = typical(far), own = 0.455 * typical(known);
  LevelModel model;
  for (const double mean : means) model.mean += mean / static_cast<double>(means.size());
  for (const double mean : means)
    model.variance += (mean - model.mean) * (mean - model.mean) / static_cast<double>(means.size());
  if (model.variance < 1e-6) return {};
  model.step_variance = std::clamp(two - one, 0.02 * one, one);
  model.noise_variance = std::max(0.5 * (one - model.step_variance - own), 0.1 * one);
  return model;
}

}  // namespace

bool PictureEdges::is_entering(const ElementModel& m, double x, double y) const {
  const double sx = 1 + 1.5 * std::sqrt(m.x.start_variance), sy = 1 + 1.5 * std::sqrt(m.y.start_variance);
  const double back_x = x - m.x.mean_velocity, back_y = y - m.y.mean_velocity;
  return back_x - sx < 0 || back_y - sy < 0 || back_x + sx > width - 1 || back_y + sy > height - 1;
}

bool PictureEdges::is_leaving(const ElementModel& m, double x, double y) const {
  const double sx = 1 + 1.5 * std::sqrt(m.x.start_variance), sy = 1 + 1.5 * std::sqrt(m.y.start_variance);
  const double next_x = x + m.x.mean_velocity, next_y = y + m.y.mean_velocity;
  return next_x - sx < 0 || next_y - sy < 0 || next_x + sx > width - 1 || next_y + sy > height - 1;
}

ElementModel fit_element_model(const std::vector<std::vector<Sight>>& paths, const PictureEdges& edges, int num_frames,
                               const ElementModel& before) {
  ElementModel model = before;
  model.x = fit_axis(AxisLikelihood(paths, &Sight::x), before.x);
  model.y = fit_axis(AxisLikelihood(paths, &Sight::y), before.y);
  model.log_amplitude = fit_level(paths, &Sight::log_amplitude, &Sight::log_amplitude_variance, before.log_amplitude);
  model.log_scale = fit_level(paths, &Sight::log_scale, &Sight::log_scale_variance, before.log_scale);
  double singles = 0, sights = 0, gaps = 0, missed = 0, births = 0, entries = 0, deaths = 0, at_risk = 0;
  for (const auto& path : paths) {
    if (path.size() == 1) ++singles;
    if (path.size() < 3) continue;
    sights += static_cast<double>(path.size());
    for (std::size_t i = 1; i < path.size(); ++i) {
      const int gap = path[i].frame - path[i - 1].frame - 1;
      missed += gap;
      if (gap > 0) ++gaps;
    }
    for (const Sight& sight : path)
      if (!edges.is_leaving(model, sight.x, sight.y)) ++at_risk;
    if (path.front().frame > 0) ++(edges.is_entering(model, path.front().x, path.front().y) ? entries : births);
    if (path.back().frame < num_frames - 1 && !edges.is_leaving(model, path.back().x, path.back().y)) ++deaths;
  }
  if (sights < static_cast<double>(kEnoughSights)) return model;
  const double volume = std::max(1.0, edges.width * edges.height * num_frames);
  const double reach_x = std::abs(model.x.mean_velocity) + 2 + 3 * std::sqrt(model.x.start_variance),
               reach_y = std::abs(model.y.mean_velocity) + 2 + 3 * std::sqrt(model.y.start_variance);
  const double edge_volume =
      std::max(1.0, std::min(volume, num_frames * (reach_x * edges.height + reach_y * edges.width)));
  model.births = (births + 1) / volume;
  model.entries = std::max(model.births, (entries + 1) / edge_volume);
  model.clutter = (singles + 1) / volume;
  model.seen = std::clamp(1 - (gaps + 1) / (sights + 2), 0.5, 0.999);
  model.hidden = std::clamp((missed - gaps + 2) / (missed + 4), 0.2, 0.85);
  model.death = std::clamp((deaths + 1) / (at_risk + 2), 1e-4, 0.5);
  return model;
}

}  // namespace motex
