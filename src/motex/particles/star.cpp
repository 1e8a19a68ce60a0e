// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/star.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/matrix.h"

namespace motex {
namespace {

constexpr float kLeastDeviation = 0.25F;  // grey levels
constexpr std::size_t kMaxSamples = 150000;
constexpr int kWarmUp = 30, kTrialFrames = 30;

std::vector<StarModel::Neighbour> neighbours_of(const StarOptions& options) {
  std::vector<StarModel::Neighbour> out;
  for (int back = 1; back <= options.past_frames; ++back) {
    const int reach = std::max(0, options.past_radius - (back - 1));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) out.push_back({dx, dy, -back, 0});
  }
  for (int dy = -options.same_radius; dy <= 0; ++dy)
    for (int dx = -options.same_radius; dx <= options.same_radius; ++dx)
      if (dy < 0 || dx < 0) out.push_back({dx, dy, 0, 0});
  return out;
}

void find_moments(const std::vector<Plane>& frames, Plane& mean, Plane& deviation) {
  mean = deviation = Plane(frames[0].width, frames[0].height);
  const auto num = static_cast<float>(frames.size());
  for (std::size_t i = 0; i < mean.values.size(); ++i) {
    float sum = 0, squares = 0;
    for (const Plane& frame : frames) sum += frame.values[i];
    for (const Plane& frame : frames) squares += (frame.values[i] - sum / num) * (frame.values[i] - sum / num);
    mean.values[i] = sum / num;
    deviation.values[i] = std::max(kLeastDeviation, std::sqrt(squares / num));
  }
}

Plane standardised(const Plane& frame, const StarModel& model) {
  Plane z = frame;
  for (std::size_t i = 0; i < z.values.size(); ++i)
    z.values[i] = (z.values[i] - model.mean.values[i]) / model.deviation.values[i];
  return z;
}

/// Where the neighbours in the past of each pixel lie, whole pixels: dt · flow.
class Upstream {
 public:
  Upstream(const FlowField& flow, int width, int height, int past_frames) : width_(width), height_(height) {
    offsets_.resize(static_cast<std::size_t>(past_frames) + 1);
    const auto area = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (int back = 0; back <= past_frames; ++back) {
      std::vector<Offset>& table = offsets_[static_cast<std::size_t>(back)];
      table.resize(area);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const FlowField::Velocity v = flow.at(x, y);
          table[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = {
              static_cast<std::int16_t>(std::lround(-back * v.x)), static_cast<std::int16_t>(std::lround(-back * v.y))};
        }
    }
  }
  /// Value of the neighbour; outside the picture the nearest pixel inside.
  float value(const Plane& z, int x, int y, const StarModel::Neighbour& n) const {
    const Offset o =
        offsets_[static_cast<std::size_t>(-n.dt)]
                [static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    return z.at(std::clamp(x + n.dx + o.x, 0, width_ - 1), std::clamp(y + n.dy + o.y, 0, height_ - 1));
  }

 private:
  struct Offset {
    std::int16_t x, y;
  };
  int width_, height_;
  std::vector<std::vector<Offset>> offsets_;
};

int past_frames_of(const StarModel& model) {
  int most = 0;
  for (const StarModel::Neighbour& n : model.neighbours) most = std::max(most, -n.dt);
  return most;
}

/// Normal equations over pixels drawn evenly; returns the weighted variance of what is left.
void regress(const std::vector<Plane>& z, StarModel& model, const Upstream& upstream) {
  const auto p = static_cast<Index>(model.neighbours.size());
  const int width = z[0].width, height = z[0].height, past = past_frames_of(model);
  Matrix normal = 1e-6 * Matrix::Identity(p, p);
  Vector right = Vector::Zero(p), row(p);
  double squares = 1e-12, total = 1e-12;
  Rng rng(1);
  const auto num = static_cast<std::uint64_t>(z.size()) - static_cast<std::uint64_t>(past);
  for (std::size_t k = 0; k < kMaxSamples; ++k) {
    const auto t = static_cast<std::size_t>(rng.below(num)) + static_cast<std::size_t>(past);
    const int x = static_cast<int>(rng.below(static_cast<std::uint64_t>(width)));
    const int y = static_cast<int>(rng.below(static_cast<std::uint64_t>(height)));
    const double weight = static_cast<double>(model.deviation.at(x, y)) * static_cast<double>(model.deviation.at(x, y));
    for (Index i = 0; i < p; ++i) {
      const StarModel::Neighbour& n = model.neighbours[static_cast<std::size_t>(i)];
      row[i] = static_cast<double>(upstream.value(z[t - static_cast<std::size_t>(-n.dt)], x, y, n));
    }
    const double value = static_cast<double>(z[t].at(x, y));
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    right += weight * value * row;
    squares += weight * value * value;
    total += weight;
  }
  const Eigen::LLT<Matrix, Eigen::Lower> factor(normal);
  if (factor.info() != Eigen::Success) throw NumericalFailure("the frames give no autoregression; are they numbers?");
  const Vector weights = factor.solve(right);
  for (Index i = 0; i < p; ++i) model.neighbours[static_cast<std::size_t>(i)].weight = weights[i];
  model.noise = std::sqrt(std::max(1e-12, (squares - weights.dot(right)) / total));
}

/// One frame of z into `out`: expectation, plus noise where rng is given. past: newest first.
template <typename Past>
void advance(const StarModel& model, const Upstream& upstream, const Past& past, Rng* rng, Plane& out) {
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      double sum = rng != nullptr ? model.noise * rng->normal() : 0;
      for (const StarModel::Neighbour& n : model.neighbours) {
        if (n.dt == 0 && (y + n.dy < 0 || x + n.dx < 0 || x + n.dx >= out.width)) continue;
        const Plane& from = n.dt == 0 ? out : past[static_cast<std::size_t>(-n.dt) - 1];
        sum += n.weight * static_cast<double>(upstream.value(from, x, y, n));
      }
      out.at(x, y) = static_cast<float>(std::clamp(sum, -12.0, 12.0));
    }
}

/// Root mean square of z over the pixels (weighted by deviation²) of a run, per frame.
std::vector<double> trial_run(const StarModel& model, int num_frames) {
  StarSampler sampler(model, 11);
  std::vector<double> out;
  for (int t = 0; t < num_frames; ++t) {
    sampler.next();
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < model.deviation.values.size(); ++i) {
      const double w = static_cast<double>(model.deviation.values[i]) * static_cast<double>(model.deviation.values[i]);
      const double value = static_cast<double>(sampler.state().values[i]);
      sum += w * value * value;
      total += w;
    }
    out.push_back(std::sqrt(sum / total));
  }
  return out;
}

double mean_of_last(const std::vector<double>& values, int num) {
  double sum = 0;
  for (std::size_t k = values.size() - static_cast<std::size_t>(num); k < values.size(); ++k) sum += values[k];
  return sum / num;
}

void calibrate(StarModel& model) {
  constexpr int kTries = 12;
  for (int k = 0; k < kTries; ++k) {
    const std::vector<double> run = trial_run(model, kWarmUp + kTrialFrames);
    const double now = mean_of_last(run, kTrialFrames / 2);
    const double before = mean_of_last({run.begin(), run.end() - kTrialFrames / 2}, kTrialFrames / 2);
    if (now > 1.2 * before || now > 4) {
      for (StarModel::Neighbour& n : model.neighbours) n.weight *= n.dt < 0 ? 0.97 : 0.99;
      continue;
    }
    if (now > 1e-6) model.noise /= now;
    return;
  }
  for (StarModel::Neighbour& n : model.neighbours) n.weight = 0;  // nothing stable: white noise
  model.noise = 1;
}

}  // namespace

StarModel fit_star(const std::vector<Plane>& frames, const FlowField& flow, const StarOptions& options) {
  if (frames.size() < static_cast<std::size_t>(options.past_frames) + 2)
    throw InvalidInput("an autoregression over " + std::to_string(options.past_frames) +
                       " past frames needs at least " + std::to_string(options.past_frames + 2) + " frames");
  for (const Plane& frame : frames)
    if (frame.width != frames[0].width || frame.height != frames[0].height || frame.values.empty())
      throw InvalidInput("the frames of an autoregression must have one size");
  StarModel model;
  model.neighbours = neighbours_of(options);
  model.flow = flow;
  find_moments(frames, model.mean, model.deviation);
  std::vector<Plane> z;
  for (const Plane& frame : frames) z.push_back(standardised(frame, model));
  regress(z, model, Upstream(flow, frames[0].width, frames[0].height, options.past_frames));
  calibrate(model);
  return model;
}

Plane predict_star(const StarModel& model, const std::vector<Plane>& past) {
  const int num = past_frames_of(model);
  if (past.size() < static_cast<std::size_t>(num))
    throw InvalidInput("the prediction needs " + std::to_string(num) + " past frames");
  std::vector<Plane> newest_first;
  for (int k = 0; k < num; ++k)
    newest_first.push_back(standardised(past[past.size() - 1 - static_cast<std::size_t>(k)], model));
  Plane out = model.mean;
  advance(model, Upstream(model.flow, out.width, out.height, num), newest_first, nullptr, out);
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = model.mean.values[i] + model.deviation.values[i] * out.values[i];
  return out;
}

StarSampler::StarSampler(StarModel model, std::uint64_t seed) : model_(std::move(model)), rng_(seed) {
  past_.assign(static_cast<std::size_t>(past_frames_of(model_)) + 1, Plane(model_.mean.width, model_.mean.height));
  shown_ = model_.mean;
}

const Plane& StarSampler::next() {
  Plane out = std::move(past_.back());
  past_.pop_back();
  advance(model_, Upstream(model_.flow, out.width, out.height, past_frames_of(model_)), past_, &rng_, out);
  for (std::size_t i = 0; i < out.values.size(); ++i)
    shown_.values[i] = model_.mean.values[i] + model_.deviation.values[i] * out.values[i];
  past_.push_front(std::move(out));
  return shown_;
}

}  // namespace motex
