// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/blob_cluster.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "motex/core/wide.h"
#include "motex/particles/blob_shape.h"

namespace motex {
namespace {

constexpr int kMaxIterations = 8;
constexpr double kMaxStretch = 2;    // aspect e² at most
constexpr double kEnoughGain = 0.3;  // of the squared error in squared noises: less is not worth a step
constexpr double kSettled = 0.1;     // step in pixels (or of ln s) that does not touch the neighbours

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
  PixelBox box;
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
  const BlobPrecision p = precision_of(b.log_scale, b.e1, b.e2);
  member.derivatives.assign(member.box.area() * N, 0.0F);
  constexpr double kStep = 1e-4;
  const BlobPrecision up1 = precision_of(b.log_scale, b.e1 + kStep, b.e2),
                      up2 = precision_of(b.log_scale, b.e1, b.e2 + kStep);
  const auto slope = [&](const BlobPrecision& up) {
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

using FourLanes = float __attribute__((vector_size(4 * sizeof(float))));
using EightLanes = float __attribute__((vector_size(8 * sizeof(float))));
template <int N>
using Lanes = std::conditional_t<N == 4, FourLanes, EightLanes>;

/// sum[i] += Σ a[i] b over `num` pixels, a and b their N derivatives.
template <int N>
[[gnu::always_inline]] inline void add_products(const float* a, const float* b, int num, Lanes<N>* sum) {
  Lanes<N> sums[N];
  for (int i = 0; i < N; ++i) sums[i] = sum[i];
  for (; num > 0; --num, a += N, b += N) {
    Lanes<N> row;
    std::memcpy(&row, b, sizeof row);
    for (int i = 0; i < N; ++i) sums[i] += a[i] * row;
  }
  for (int i = 0; i < N; ++i) sum[i] = sums[i];
}

MOTEX_WIDE void add_outer(const float* a, const float* b, int num, Lanes<4>* sum) { add_products<4>(a, b, num, sum); }
MOTEX_WIDE void add_outer(const float* a, const float* b, int num, Lanes<8>* sum) { add_products<8>(a, b, num, sum); }

/// Of parameter p: 1 / variance = what the picture says + what the prior says.
double variance_without_prior(double variance, const BlobPrior& prior, std::size_t p) {
  constexpr double kLeastShare = 0.05;  // of what is known that the picture must say
  return variance / std::max(kLeastShare, 1 - variance * prior.precision[p]);
}

double without_prior(double value, double variance, const BlobPrior& prior, std::size_t p) {
  return value + prior.precision[p] * variance_without_prior(variance, prior, p) * (value - prior.mean[p]);
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
    const PixelBox common = intersection(a.box, b.box);
    if (common.is_empty()) return Block::Zero();
    std::array<Lanes<N>, N> sums{};
    for (int y = common.top; y < common.bottom; ++y) {
      const auto at = [&](const Member& m) {
        return m.derivatives.data() +
               (static_cast<std::size_t>(y - m.box.top) * static_cast<std::size_t>(m.box.width()) +
                static_cast<std::size_t>(common.left - m.box.left)) *
                   N;
      };
      add_outer(at(a), at(b), common.width(), sums.data());
    }
    Block sum;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) sum(i, j) = sums[static_cast<std::size_t>(i)][j];
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
    if (std::abs(blob.amplitude) > options_.max_light) {  // a centre half a pixel off in x and y hides some of its peak
      const double most =
          options_.max_light * std::exp(0.25 * std::exp(std::min(stretch, kMaxStretch) - 2 * blob.log_scale));
      blob.amplitude = std::clamp(blob.amplitude, -most, most);
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
      const double x_variance = std::max(0.0, covariance(row, row)),
                   y_variance = std::max(0.0, covariance(row + 1, row + 1));
      blob.place_spread = std::sqrt(0.5 * (x_variance + y_variance));
      blob.seen_x = without_prior(blob.x, x_variance, priors_[k], 0);
      blob.seen_y = without_prior(blob.y, y_variance, priors_[k], 1);
      blob.seen_spread = std::sqrt(0.5 * (variance_without_prior(x_variance, priors_[k], 0) +
                                          variance_without_prior(y_variance, priors_[k], 1)));
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
  PixelBox frame_;
  std::vector<float> target_, errors_, next_errors_;
  Eigen::MatrixXd curvature_;
  Eigen::VectorXd slope_;
};

}  // namespace

struct BlobCluster::Solvers {
  Solvers(const Plane& image, const FitBlobsOptions& options)
      : round(image, options, kRound), oriented(image, options, kOriented) {}
  ClusterSolver<4> round;
  ClusterSolver<8> oriented;
};

BlobCluster::BlobCluster(const Plane& image, const FitBlobsOptions& options)
    : solvers_(std::make_unique<Solvers>(image, options)), is_oriented_(options.oriented) {}
BlobCluster::~BlobCluster() = default;

void BlobCluster::clear() {
  solvers_->round.clear();
  solvers_->oriented.clear();
}
void BlobCluster::take(const Blob& blob, const BlobPrior& prior) {
  is_oriented_ ? solvers_->oriented.take(blob, prior) : solvers_->round.take(blob, prior);
}
bool BlobCluster::solve() { return is_oriented_ ? solvers_->oriented.solve() : solvers_->round.solve(); }
const Blob& BlobCluster::blob(std::size_t k) const {
  return is_oriented_ ? solvers_->oriented.blob(k) : solvers_->round.blob(k);
}

}  // namespace motex
