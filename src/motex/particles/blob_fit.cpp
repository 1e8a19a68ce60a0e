// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/blob_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace motex {
namespace {

constexpr double kReach = 3.3;          // deviations; e^{−3.3²/2} = 0.004
constexpr double kJointDistance = 2.5;  // mean scales: nearer blobs are fitted together
constexpr std::size_t kLargestCluster = 10;
constexpr int kMaxIterations = 8;
constexpr double kMaxStretch = 2;    // aspect e² at most
constexpr double kEnoughGain = 0.3;  // of the squared error in squared noises: less is not worth a step
constexpr double kSettled = 0.1;     // step in pixels (or of ln s) that does not touch the neighbours

double square(double value) { return value * value; }
double square_distance(const Blob& a, const Blob& b) { return square(a.x - b.x) + square(a.y - b.y); }

/// P of Blob.
struct Precision {
  double xx, xy, yy;
};

Precision precision_of(double log_scale, double e1, double e2) {
  const double inverse = std::exp(-2 * log_scale), e = std::hypot(e1, e2);
  if (e < 1e-9) return {inverse * (1 - e1), -inverse * e2, inverse * (1 + e1)};
  const double even = std::cosh(e), odd = std::sinh(e) / e;
  return {inverse * (even - odd * e1), -inverse * odd * e2, inverse * (even + odd * e1)};
}

/// Pixels left … right − 1, top … bottom − 1.
struct Box {
  int left = 0, top = 0, right = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
  bool is_empty() const { return right <= left || bottom <= top; }
  std::size_t area() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
};

Box intersection(const Box& a, const Box& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

Box box_of(const Blob& blob, const Plane& image, double margin) {
  const Precision p = precision_of(blob.log_scale, blob.e1, blob.e2);
  const double area = p.xx * p.yy - p.xy * p.xy;
  const double reach_x = kReach * std::sqrt(p.yy / area) + margin, reach_y = kReach * std::sqrt(p.xx / area) + margin;
  const auto pixel = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(size) + 1));
  };
  return {std::max(0, pixel(std::ceil(blob.x - reach_x), image.width)),
          std::max(0, pixel(std::ceil(blob.y - reach_y), image.height)),
          std::min(image.width, pixel(std::floor(blob.x + reach_x), image.width) + 1),
          std::min(image.height, pixel(std::floor(blob.y + reach_y), image.height) + 1)};
}

/// e^{−q/2} over the box, row by row.
void fill_gaussian(const Blob& blob, const Box& box, float* out) {
  const Precision p = precision_of(blob.log_scale, blob.e1, blob.e2);
  std::array<float, 256> columns;
  const bool is_separable = blob.e1 == 0 && blob.e2 == 0 && box.width() <= static_cast<int>(columns.size());
  if (is_separable)
    for (int x = 0; x < box.width(); ++x) {
      const double dx = box.left + x - blob.x;
      columns[static_cast<std::size_t>(x)] = static_cast<float>(std::exp(-0.5 * p.xx * dx * dx));
    }
  const double ratio_step = std::exp(-p.xx);
  for (int y = box.top; y < box.bottom; ++y) {
    const double dy = y - blob.y;
    if (is_separable) {
      const auto row = static_cast<float>(std::exp(-0.5 * p.yy * dy * dy));
      for (int x = 0; x < box.width(); ++x) *out++ = row * columns[static_cast<std::size_t>(x)];
      continue;
    }
    // Along a row the exponent is a square polynomial: it goes on by multiplication.
    const double dx = box.left - blob.x;
    double value = std::exp(-0.5 * (p.xx * dx * dx + 2 * p.xy * dx * dy + p.yy * dy * dy));
    double ratio = std::exp(-p.xx * (dx + 0.5) - p.xy * dy);
    for (int x = 0; x < box.width(); ++x) {
      *out++ = static_cast<float>(value);
      value *= ratio;
      ratio *= ratio_step;
    }
  }
}

double* parameter(Blob& blob, int idx) {
  double* const all[] = {&blob.x, &blob.y, &blob.log_scale, &blob.e1, &blob.e2, &blob.amplitude};
  return all[idx];
}

/// Which parameters of a blob are free, in the order of BlobPrior.
struct FreeParameters {
  int num;
  std::array<int, 6> idx;
};
constexpr FreeParameters kRound{4, {0, 1, 2, 5, 0, 0}};
constexpr FreeParameters kOriented{6, {0, 1, 2, 3, 4, 5}};

/// One blob of a cluster on its box: values, and for each pixel the derivatives by its free parameters (padded to N).
struct Member {
  Blob blob;
  Box box;
  std::vector<float> values;
  std::vector<float> derivatives;
};

void fill_values(Member& member) {
  member.values.resize(member.box.area());
  fill_gaussian(member.blob, member.box, member.values.data());
}

template <int N>
void fill_derivatives(Member& member) {
  const Blob& b = member.blob;
  const Precision p = precision_of(b.log_scale, b.e1, b.e2);
  member.derivatives.assign(member.box.area() * N, 0.0F);
  constexpr double kStep = 1e-4;
  const Precision up1 = precision_of(b.log_scale, b.e1 + kStep, b.e2),
                  up2 = precision_of(b.log_scale, b.e1, b.e2 + kStep);
  const auto slope = [&](const Precision& up) {
    return std::array<float, 3>{static_cast<float>((up.xx - p.xx) / kStep), static_cast<float>((up.xy - p.xy) / kStep),
                                static_cast<float>((up.yy - p.yy) / kStep)};
  };
  const std::array<float, 3> d1 = slope(up1), d2 = slope(up2);
  const auto xx = static_cast<float>(p.xx), xy = static_cast<float>(p.xy), yy = static_cast<float>(p.yy);
  const auto amplitude = static_cast<float>(b.amplitude);
  const float* value = member.values.data();
  float* out = member.derivatives.data();
  for (int y = member.box.top; y < member.box.bottom; ++y) {
    const auto dy = static_cast<float>(y - b.y);
    for (int x = member.box.left; x < member.box.right; ++x, ++value, out += N) {
      const auto dx = static_cast<float>(x - b.x);
      const float g = *value, scaled = amplitude * g;
      const float along = xx * dx + xy * dy, across = xy * dx + yy * dy;
      out[0] = scaled * along;
      out[1] = scaled * across;
      out[2] = scaled * (along * dx + across * dy);
      if constexpr (N == 4) {
        out[3] = g;
      } else {
        out[3] = -0.5F * scaled * (d1[0] * dx * dx + 2 * d1[1] * dx * dy + d1[2] * dy * dy);
        out[4] = -0.5F * scaled * (d2[0] * dx * dx + 2 * d2[1] * dx * dy + d2[2] * dy * dy);
        out[5] = g;
      }
    }
  }
}

/// Levenberg–Marquardt of the members of one cluster; N = padded number of parameters.
template <int N>
class ClusterSolver {
 public:
  ClusterSolver(const Plane& image, const FitBlobsOptions& options, const FreeParameters& free)
      : image_(image), options_(options), free_(free) {}

  void clear() {
    num_ = 0;
    priors_.clear();
  }
  void take(const Blob& blob, const BlobPrior& prior) {
    if (num_ == members_.size()) {
      members_.emplace_back();
      next_.emplace_back();
    }
    members_[num_].blob = blob;
    members_[num_].box = next_[num_].box = box_of(blob, image_, 1);
    priors_.push_back(prior);
    ++num_;
  }

  /// Returns whether it moved by more than a little.
  bool solve() {
    cut_out();
    for (std::size_t k = 0; k < num_; ++k) fill_values(members_[k]);
    double cost = cost_of(members_, errors_);
    double damping = 1e-3;
    bool is_new = true, has_moved = false;
    for (int step = 0; step < kMaxIterations; ++step) {
      if (is_new) linearise();
      const Eigen::VectorXd change = damped_step(damping);
      if (!change.allFinite()) break;
      double largest = 0;
      for (std::size_t k = 0; k < num_; ++k) {
        next_[k].blob = moved(members_[k].blob, change, k, largest);
        fill_values(next_[k]);
      }
      const double next_cost = cost_of(next_, next_errors_);
      is_new = next_cost < cost;
      damping = is_new ? damping * 0.2 : damping * 8;
      if (is_new) {
        has_moved = has_moved || largest > kSettled;
        const double gain = cost - next_cost;
        cost = next_cost;
        std::swap(members_, next_);
        std::swap(errors_, next_errors_);
        if (gain < std::max(kEnoughGain, 1e-3 * cost) || largest < 0.003) break;
      } else if (largest < 1e-3 || damping > 1e6) {
        break;
      }
    }
    measure_spreads();
    return has_moved;
  }

  const Blob& blob(std::size_t k) const { return members_[k].blob; }

 private:
  using Block = Eigen::Matrix<float, N, N>;
  using Gradient = Eigen::Matrix<float, N, 1>;

  void cut_out() {
    frame_ = members_[0].box;
    for (std::size_t k = 0; k < num_; ++k) {
      const Member& member = members_[k];
      if (member.box.is_empty()) continue;
      if (frame_.is_empty()) frame_ = member.box;
      frame_ = {std::min(frame_.left, member.box.left), std::min(frame_.top, member.box.top),
                std::max(frame_.right, member.box.right), std::max(frame_.bottom, member.box.bottom)};
    }
    target_.clear();
    for (int y = frame_.top; y < frame_.bottom; ++y)
      target_.insert(target_.end(), image_.row(y) + frame_.left, image_.row(y) + frame_.right);
  }

  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y - frame_.top) * static_cast<std::size_t>(frame_.width()) +
           static_cast<std::size_t>(x - frame_.left);
  }

  double cost_of(const std::vector<Member>& members, std::vector<float>& errors) const {
    errors = target_;
    double cost = 0;
    for (std::size_t k = 0; k < num_; ++k) {
      const Member& member = members[k];
      const float* value = member.values.data();
      const auto amplitude = static_cast<float>(member.blob.amplitude);
      for (int y = member.box.top; y < member.box.bottom; ++y) {
        float* error = errors.data() + place(member.box.left, y);
        for (int x = 0; x < member.box.width(); ++x) error[x] -= amplitude * *value++;
      }
      Blob blob = member.blob;
      for (int i = 0; i < free_.num; ++i) {
        const auto p = static_cast<std::size_t>(free_.idx[static_cast<std::size_t>(i)]);
        const double off = *parameter(blob, static_cast<int>(p)) - priors_[k].mean[p];
        cost += priors_[k].precision[p] * off * off;
      }
    }
    std::array<float, 8> sums{};
    std::size_t i = 0;
    for (; i + 8 <= errors.size(); i += 8)
      for (std::size_t lane = 0; lane < 8; ++lane) sums[lane] += errors[i + lane] * errors[i + lane];
    double energy = 0;
    for (; i < errors.size(); ++i) energy += static_cast<double>(errors[i]) * static_cast<double>(errors[i]);
    for (const float sum : sums) energy += static_cast<double>(sum);
    return cost + energy / (options_.noise * options_.noise);
  }

  void linearise() {
    const Eigen::Index n = free_.num, size = n * static_cast<Eigen::Index>(num_);
    curvature_.setZero(size, size);
    slope_.setZero(size);
    for (std::size_t k = 0; k < num_; ++k) fill_derivatives<N>(members_[k]);
    const double weight = 1 / (options_.noise * options_.noise);
    for (std::size_t k = 0; k < num_; ++k) {
      const Eigen::Index row = n * static_cast<Eigen::Index>(k);
      slope_.segment(row, n) += weight * gradient(members_[k]).head(n).template cast<double>();
      for (std::size_t m = 0; m <= k; ++m) {
        const Eigen::Index column = n * static_cast<Eigen::Index>(m);
        const Eigen::MatrixXd block =
            weight * product(members_[k], members_[m]).topLeftCorner(n, n).template cast<double>();
        curvature_.block(row, column, n, n) = block;
        if (m < k) curvature_.block(column, row, n, n) = block.transpose();
      }
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto p = static_cast<std::size_t>(free_.idx[static_cast<std::size_t>(i)]);
        const double off = *parameter(members_[k].blob, static_cast<int>(p)) - priors_[k].mean[p];
        slope_[row + i] -= priors_[k].precision[p] * off;
        curvature_(row + i, row + i) += priors_[k].precision[p];
      }
    }
  }

  Gradient gradient(const Member& member) const {
    Gradient sum = Gradient::Zero();
    const float* d = member.derivatives.data();
    for (int y = member.box.top; y < member.box.bottom; ++y) {
      const float* error = errors_.data() + place(member.box.left, y);
      for (int x = 0; x < member.box.width(); ++x, d += N) sum += Eigen::Map<const Gradient>(d) * error[x];
    }
    return sum;
  }

  Block product(const Member& a, const Member& b) const {
    Block sum = Block::Zero();
    const Box common = intersection(a.box, b.box);
    if (common.is_empty()) return sum;
    for (int y = common.top; y < common.bottom; ++y) {
      const auto at = [&](const Member& m) {
        return m.derivatives.data() +
               (static_cast<std::size_t>(y - m.box.top) * static_cast<std::size_t>(m.box.width()) +
                static_cast<std::size_t>(common.left - m.box.left)) *
                   N;
      };
      const float *da = at(a), *db = at(b);
      for (int x = 0; x < common.width(); ++x, da += N, db += N)
        sum.noalias() += Eigen::Map<const Gradient>(da) * Eigen::Map<const Gradient>(db).transpose();
    }
    return sum;
  }

  Eigen::VectorXd damped_step(double damping) const {
    Eigen::MatrixXd damped = curvature_;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-9;
    return damped.ldlt().solve(slope_);
  }

  Blob moved(Blob blob, const Eigen::VectorXd& change, std::size_t k, double& largest) const {
    const Eigen::Index row = free_.num * static_cast<Eigen::Index>(k);
    const double scale = blob.scale();
    for (Eigen::Index i = 0; i < free_.num; ++i) {
      const int p = free_.idx[static_cast<std::size_t>(i)];
      double step = change[row + i];
      const double limit = p < 2 ? 0.7 * scale : p < 5 ? 0.4 : 0.6 * std::abs(blob.amplitude) + options_.noise;
      step = std::clamp(step, -limit, limit);
      *parameter(blob, p) += step;
      if (p < 5) largest = std::max(largest, std::abs(step));
    }
    blob.log_scale = std::clamp(blob.log_scale, std::log(options_.min_scale), std::log(options_.max_scale));
    blob.x = std::clamp(blob.x, -1.5 * scale, image_.width - 1 + 1.5 * scale);
    blob.y = std::clamp(blob.y, -1.5 * scale, image_.height - 1 + 1.5 * scale);
    const double stretch = std::hypot(blob.e1, blob.e2);
    if (stretch > kMaxStretch) {
      blob.e1 *= kMaxStretch / stretch;
      blob.e2 *= kMaxStretch / stretch;
    }
    return blob;
  }

  /// By the curvature of the last step, which lies near enough.
  void measure_spreads() {
    const Eigen::Index n = free_.num;
    Eigen::MatrixXd damped = curvature_;
    damped.diagonal().array() += 1e-9;
    const Eigen::MatrixXd covariance = damped.ldlt().solve(Eigen::MatrixXd::Identity(damped.rows(), damped.cols()));
    for (std::size_t k = 0; k < num_; ++k) {
      const Eigen::Index row = n * static_cast<Eigen::Index>(k);
      Blob& blob = members_[k].blob;
      blob.place_spread = std::sqrt(std::max(0.0, 0.5 * (covariance(row, row) + covariance(row + 1, row + 1))));
      blob.log_scale_spread = std::sqrt(std::max(0.0, covariance(row + 2, row + 2)));
      blob.amplitude_spread = std::sqrt(std::max(0.0, covariance(row + n - 1, row + n - 1)));
    }
  }

  const Plane& image_;
  const FitBlobsOptions& options_;
  FreeParameters free_;
  std::size_t num_ = 0;  // of members in use
  std::vector<Member> members_, next_;
  std::vector<BlobPrior> priors_;
  Box frame_;
  std::vector<float> target_, errors_, next_errors_;
  Eigen::MatrixXd curvature_;
  Eigen::VectorXd slope_;
};

}  // namespace

double Blob::scale() const { return std::exp(log_scale); }
double Blob::aspect() const { return std::exp(std::hypot(e1, e2)); }
double Blob::angle() const {
  const double angle = 0.5 * std::atan2(e2, e1);
  return angle < 0 ? angle + std::numbers::pi : angle;
}

struct BlobFitter::Solver {
  Solver(const Plane& image, const FitBlobsOptions& options)
      : round(image, options, kRound), oriented(image, options, kOriented) {}
  ClusterSolver<4> round;
  ClusterSolver<8> oriented;
};

BlobFitter::BlobFitter(const Plane& image, const FitBlobsOptions& options)
    : options_(options), residual_(image), solver_(std::make_unique<Solver>(residual_, options_)) {}
BlobFitter::~BlobFitter() = default;

void BlobFitter::add(const Blob& blob, const BlobPrior& prior) {
  unsettle_near(blob);
  blobs_.push_back(blob);
  priors_.push_back(prior);
  is_settled_.push_back(0);
  paint(blob, 1);
}

void BlobFitter::remove(std::size_t idx) {
  paint(blobs_[idx], -1);
  unsettle_near(blobs_[idx]);
  const auto place = static_cast<std::ptrdiff_t>(idx);
  blobs_.erase(blobs_.begin() + place);
  priors_.erase(priors_.begin() + place);
  is_settled_.erase(is_settled_.begin() + place);
}

void BlobFitter::unsettle_near(const Blob& blob) {
  for (std::size_t k = 0; k < blobs_.size(); ++k)
    if (square_distance(blobs_[k], blob) < square(2 * (blobs_[k].scale() + blob.scale()))) is_settled_[k] = 0;
}

void BlobFitter::paint(const Blob& blob, float sign) {
  const Box box = box_of(blob, residual_, 0);
  if (box.is_empty()) return;
  std::vector<float>& values = painted_;
  values.resize(box.area());
  fill_gaussian(blob, box, values.data());
  const float weight = sign * static_cast<float>(blob.amplitude);
  const float* value = values.data();
  for (int y = box.top; y < box.bottom; ++y) {
    float* row = residual_.row(y) + box.left;
    for (int x = 0; x < box.width(); ++x) row[x] -= weight * *value++;
  }
}

double BlobFitter::misfit(std::size_t idx) const {
  const Blob& blob = blobs_[idx];
  const Precision p = precision_of(blob.log_scale, blob.e1, blob.e2);
  const Box box = box_of(blob, residual_, 0);
  double sum = 0;
  int num = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const double dx = x - blob.x, dy = y - blob.y;
      if (p.xx * dx * dx + 2 * p.xy * dx * dy + p.yy * dy * dy > 4) continue;
      sum += static_cast<double>(residual_.at(x, y)) * static_cast<double>(residual_.at(x, y));
      ++num;
    }
  return num > 0 ? sum / num : 0;
}

double BlobFitter::cost_near(const Blob& blob) const {
  const Box box = box_of(blob, residual_, 2);
  double sum = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x)
      sum += static_cast<double>(residual_.at(x, y)) * static_cast<double>(residual_.at(x, y));
  return sum / (options_.noise * options_.noise);
}

bool BlobFitter::split(std::size_t idx, double min_gain) {
  const Blob one = blobs_[idx];
  const Box box = box_of(one, residual_, 0);
  // Second moments of what is left, weighted by the spot: two spots leave more along their line than across.
  double along = 0, diagonal = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const double dx = x - one.x, dy = y - one.y;
      const double weight = std::exp(-0.25 * (dx * dx + dy * dy) / (one.scale() * one.scale()));
      const double value = weight * static_cast<double>(residual_.at(x, y)) * (one.amplitude > 0 ? 1 : -1);
      along += value * (dx * dx - dy * dy);
      diagonal += value * 2 * dx * dy;
    }
  const double angle = 0.5 * std::atan2(diagonal, along), away = 0.7 * one.scale();
  const double before = cost_near(one);
  Blob a = one, b = one;
  a.x += away * std::cos(angle);
  a.y += away * std::sin(angle);
  b.x -= away * std::cos(angle);
  b.y -= away * std::sin(angle);
  for (Blob* half : {&a, &b}) {
    half->amplitude *= 0.65;
    half->log_scale -= 0.15;
  }
  paint(one, -1);
  blobs_[idx] = a;
  paint(a, 1);
  blobs_.push_back(b);
  priors_.emplace_back();
  is_settled_.push_back(0);
  paint(b, 1);
  fit_cluster({static_cast<int>(idx), static_cast<int>(blobs_.size()) - 1});
  if (before - cost_near(one) >= min_gain) {
    unsettle_near(one);
    return true;
  }
  paint(blobs_.back(), -1);
  blobs_.pop_back();
  priors_.pop_back();
  is_settled_.pop_back();
  paint(blobs_[idx], -1);
  blobs_[idx] = one;
  paint(one, 1);
  return false;
}

std::vector<std::vector<int>> BlobFitter::clusters() const {
  // Nearest pairs first, so that a cluster that grows too large keeps those that overlap most.
  struct Pair {
    double distance;
    int a, b;
  };
  std::vector<int> by_x(blobs_.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  const auto blob = [&](int k) -> const Blob& { return blobs_[static_cast<std::size_t>(k)]; };
  std::sort(by_x.begin(), by_x.end(),
            [&](int a, int b) { return blob(a).x < blob(b).x || (blob(a).x == blob(b).x && a < b); });
  double largest = 0;
  for (const Blob& b : blobs_) largest = std::max(largest, b.scale());
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t j = i + 1; j < by_x.size(); ++j) {
      const Blob &a = blob(by_x[i]), &b = blob(by_x[j]);
      if (b.x - a.x > kJointDistance * largest) break;
      const double distance = square_distance(a, b) / square(0.5 * (a.scale() + b.scale()));
      if (distance < square(kJointDistance)) pairs.push_back({distance, by_x[i], by_x[j]});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance, a.a, a.b) < std::tie(b.distance, b.a, b.b);
  });
  std::vector<std::vector<int>> groups(blobs_.size());
  std::vector<int> group_of(blobs_.size());
  for (std::size_t k = 0; k < blobs_.size(); ++k) {
    groups[k] = {static_cast<int>(k)};
    group_of[k] = static_cast<int>(k);
  }
  for (const Pair& pair : pairs) {
    const auto a = static_cast<std::size_t>(group_of[static_cast<std::size_t>(pair.a)]),
               b = static_cast<std::size_t>(group_of[static_cast<std::size_t>(pair.b)]);
    if (a == b || groups[a].size() + groups[b].size() > kLargestCluster) continue;
    for (const int k : groups[b]) group_of[static_cast<std::size_t>(k)] = static_cast<int>(a);
    groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
    groups[b].clear();
  }
  std::erase_if(groups, [](const std::vector<int>& group) { return group.empty(); });
  return groups;
}

bool BlobFitter::fit_cluster(const std::vector<int>& members) {
  for (const int k : members) paint(blobs_[static_cast<std::size_t>(k)], -1);
  bool has_moved = false;
  const auto solve = [&](auto& solver) {
    solver.clear();
    for (const int k : members) solver.take(blobs_[static_cast<std::size_t>(k)], priors_[static_cast<std::size_t>(k)]);
    has_moved = solver.solve();
    for (std::size_t k = 0; k < members.size(); ++k) blobs_[static_cast<std::size_t>(members[k])] = solver.blob(k);
  };
  if (options_.oriented) {
    solve(solver_->oriented);
  } else {
    solve(solver_->round);
  }
  for (const int k : members) paint(blobs_[static_cast<std::size_t>(k)], 1);
  return has_moved;
}

void BlobFitter::fit(int num_sweeps) {
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    bool is_done = true;
    for (const std::vector<int>& members : clusters()) {
      bool is_settled = true;
      for (const int k : members) is_settled = is_settled && is_settled_[static_cast<std::size_t>(k)] != 0;
      if (is_settled) continue;
      const bool has_moved = fit_cluster(members);
      if (has_moved)
        for (const int k : members) unsettle_near(blobs_[static_cast<std::size_t>(k)]);
      for (const int k : members) is_settled_[static_cast<std::size_t>(k)] = 1;
      is_done = is_done && !has_moved;
    }
    if (is_done) break;
  }
}

}  // namespace motex
