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
constexpr float kLargest = 12;  // of z: a run that explodes stays finite
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

int past_frames_of(const StarModel& model) {
  int most = 0;
  for (const StarModel::Neighbour& n : model.neighbours) most = std::max(most, -n.dt);
  return most;
}

}  // namespace

/// Planes of z with a margin of zeros, and where in them the neighbours of each pixel lie: flow · dt upstream.
class StarGrid {
 public:
  StarGrid(const StarModel& model, int width, int height) : width_(width), height_(height) {
    const int past = past_frames_of(model);
    int reach = 0;
    for (const StarModel::Neighbour& n : model.neighbours) reach = std::max({reach, std::abs(n.dx), std::abs(n.dy)});
    double speed = 0;
    for (const Plane* plane : {&model.flow.vx, &model.flow.vy})
      for (const float v : plane->values) speed = std::max(speed, std::abs(static_cast<double>(v)));
    pad_ = reach + static_cast<int>(std::ceil(std::min(speed, kMaxSpeed) * past)) + 1;
    stride_ = width + 2 * pad_;
    origins_.resize(static_cast<std::size_t>(past) + 1);
    for (int back = 0; back <= past; ++back) fill_origins(model.flow, back);
    for (const StarModel::Neighbour& n : model.neighbours) taps_.push_back({-n.dt, n.dy * stride_ + n.dx});
  }

  std::vector<float> padded() const {
    return std::vector<float>(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_ + 2 * pad_), 0.0F);
  }
  std::vector<float> padded(const Plane& z) const {
    std::vector<float> out = padded();
    for (int y = 0; y < height_; ++y) std::copy_n(z.row(y), width_, out.data() + place(0, y));
    return out;
  }
  std::size_t place(int x, int y) const { return static_cast<std::size_t>((y + pad_) * stride_ + x + pad_); }
  std::size_t num_taps() const { return taps_.size(); }
  /// Value of neighbour `tap` of pixel number `pixel`; frames[k]: k frames back.
  float value(const std::vector<const float*>& frames, std::size_t pixel, std::size_t tap) const {
    const Tap& t = taps_[tap];
    const auto back = static_cast<std::size_t>(t.back);
    return frames[back][origins_[back][pixel] + t.offset];
  }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  static constexpr double kMaxSpeed = 64;  // pixels a frame
  struct Tap {
    int back, offset;
  };
  void fill_origins(const FlowField& flow, int back) {
    std::vector<int>& origins = origins_[static_cast<std::size_t>(back)];
    const auto whole = [&](double v) {
      return static_cast<int>(std::lround(-back * std::clamp(v, -kMaxSpeed, kMaxSpeed)));
    };
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const FlowField::Velocity v = flow.at(x, y);
        const int from_x = std::clamp(x + whole(v.x), -1, width_), from_y = std::clamp(y + whole(v.y), -1, height_);
        origins.push_back((from_y + pad_) * stride_ + from_x + pad_);
      }
  }

  int width_, height_, pad_ = 0, stride_ = 0;
  std::vector<std::vector<int>> origins_;  ///< [frames back][pixel]
  std::vector<Tap> taps_;
};

namespace {

/// Normal equations over pixels drawn evenly.
void regress(const std::vector<Plane>& z, StarModel& model) {
  const auto p = static_cast<Index>(model.neighbours.size());
  const int width = z[0].width, height = z[0].height, past = past_frames_of(model);
  const StarGrid grid(model, width, height);
  std::vector<std::vector<float>> padded;
  for (const Plane& plane : z) padded.push_back(grid.padded(plane));
  Matrix normal = 1e-6 * Matrix::Identity(p, p);
  Vector right = Vector::Zero(p), row(p);
  double squares = 1e-12, total = 1e-12;
  Rng rng(1);
  const auto num = static_cast<std::uint64_t>(z.size()) - static_cast<std::uint64_t>(past);
  std::vector<const float*> frames(static_cast<std::size_t>(past) + 1);
  for (std::size_t k = 0; k < kMaxSamples; ++k) {
    const auto t = static_cast<std::size_t>(rng.below(num)) + static_cast<std::size_t>(past);
    const int x = static_cast<int>(rng.below(static_cast<std::uint64_t>(width)));
    const int y = static_cast<int>(rng.below(static_cast<std::uint64_t>(height)));
    const double deviation = static_cast<double>(model.deviation.at(x, y)), weight = deviation * deviation;
    for (std::size_t back = 0; back < frames.size(); ++back) frames[back] = padded[t - back].data();
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    for (std::size_t i = 0; i < grid.num_taps(); ++i)
      row[static_cast<Index>(i)] = static_cast<double>(grid.value(frames, pixel, i));
    const double value = static_cast<double>(z[t].values[pixel]);
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

/// One frame of z into frames[0]: expectation, plus noise where rng is given.
void advance(const StarModel& model, const StarGrid& grid, const std::vector<const float*>& frames, Rng* rng,
             float* out) {
  std::size_t pixel = 0;
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x, ++pixel) {
      auto sum = rng != nullptr ? static_cast<float>(model.noise * rng->normal()) : 0.0F;
      for (std::size_t i = 0; i < grid.num_taps(); ++i)
        sum += static_cast<float>(model.neighbours[i].weight) * grid.value(frames, pixel, i);
      out[grid.place(x, y)] = std::clamp(sum, -kLargest, kLargest);
    }
}

void show(const StarModel& model, const StarGrid& grid, const std::vector<float>& z, Plane& out) {
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.at(x, y) = model.mean.at(x, y) + model.deviation.at(x, y) * z[grid.place(x, y)];
}

/// Root mean square of z over the pixels (weighted by deviation²) of a run, per frame.
std::vector<double> trial_run(const StarModel& model, int num_frames) {
  StarSampler sampler(model, 11);
  std::vector<double> out;
  for (int t = 0; t < num_frames; ++t) {
    const Plane& shown = sampler.next();
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < model.deviation.values.size(); ++i) {
      const double w = static_cast<double>(model.deviation.values[i]) * static_cast<double>(model.deviation.values[i]);
      const double value = static_cast<double>((shown.values[i] - model.mean.values[i]) / model.deviation.values[i]);
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
  regress(z, model);
  calibrate(model);
  return model;
}

Plane predict_star(const StarModel& model, const std::vector<Plane>& past) {
  const int num = past_frames_of(model);
  if (past.size() < static_cast<std::size_t>(num))
    throw InvalidInput("the prediction needs " + std::to_string(num) + " past frames");
  Plane out = model.mean;
  const StarGrid grid(model, out.width, out.height);
  std::vector<std::vector<float>> padded{grid.padded()};
  for (std::size_t k = 0; k < static_cast<std::size_t>(num); ++k)
    padded.push_back(grid.padded(standardised(past[past.size() - 1 - k], model)));
  std::vector<const float*> frames;
  for (const std::vector<float>& z : padded) frames.push_back(z.data());
  advance(model, grid, frames, nullptr, padded[0].data());
  show(model, grid, padded[0], out);
  return out;
}

StarSampler::StarSampler(StarModel model, std::uint64_t seed)
    : model_(std::move(model)),
      grid_(std::make_unique<StarGrid>(model_, model_.mean.width, model_.mean.height)),
      rng_(seed),
      shown_(model_.mean) {
  past_.assign(static_cast<std::size_t>(past_frames_of(model_)) + 1, grid_->padded());
}
StarSampler::~StarSampler() = default;
StarSampler::StarSampler(StarSampler&&) noexcept = default;
StarSampler& StarSampler::operator=(StarSampler&&) noexcept = default;

const Plane& StarSampler::next() {
  std::rotate(past_.begin(), past_.end() - 1, past_.end());
  std::vector<const float*> frames;
  for (const std::vector<float>& z : past_) frames.push_back(z.data());
  advance(model_, *grid_, frames, &rng_, past_[0].data());
  show(model_, *grid_, past_[0], shown_);
  return shown_;
}

}  // namespace motex
