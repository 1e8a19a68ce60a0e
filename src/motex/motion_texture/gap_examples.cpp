// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/gap_examples.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "motex/core/error.h"
#include "motex/core/gemm.h"

namespace motex {
namespace {

constexpr double kLagSecs[] = {0, 1.0 / 30, 1.0 / 15, 2.0 / 15, 0.2, 0.3};
constexpr Index kMostExamples = 12000;
constexpr Index kFewestExamples = 50;
constexpr double kRidge = 0.003;
constexpr double kKernelWidth = 0.25;  // of the least squared distance

/// 0 and the lags above in frames, those below `length`.
std::vector<Index> lags_of(double frame_time_secs, Index length) {
  std::vector<Index> lags;
  for (const double secs : kLagSecs) {
    const Index lag = std::max<Index>(std::lround(secs / frame_time_secs), lags.empty() ? 0 : 1);
    if (lag < length && (lags.empty() || lag > lags.back())) lags.push_back(lag);
  }
  return lags;
}

/// Root of every corpus row, each run from (0, 0, 0) on; x, z in cm.
FrameMatrix integrate_roots(const MotionTexture& model) {
  FrameMatrix roots(model.corpus.rows(), 3);
  const Vector& w = model.features.weights;
  const double cm = model.features.cm_per_unit;
  for (const Run& run : model.runs) {
    double x = 0, z = 0, heading = 0;
    for (Index r = run.row; r < run.row + run.length; ++r) {
      if (r > run.row) {
        const double vx = cm * static_cast<double>(model.corpus(r, 0)) / w[0],
                     vz = cm * static_cast<double>(model.corpus(r, 1)) / w[1];
        x += std::cos(heading) * vx + std::sin(heading) * vz;
        z += -std::sin(heading) * vx + std::cos(heading) * vz;
        heading += static_cast<double>(model.corpus(r, 3)) / w[3];
      }
      roots.row(r) << x, z, heading;
    }
  }
  return roots;
}

RootStep step_between(double heading, double dx, double dz, double turn) {
  const double c = std::cos(heading), s = std::sin(heading);
  return {c * dx - s * dz, s * dx + c * dz, turn};
}

RootStep step_between(const FrameMatrix& roots, Index from, Index to) {
  return step_between(roots(from, 2), roots(to, 0) - roots(from, 0), roots(to, 1) - roots(from, 1),
                      roots(to, 2) - roots(from, 2));
}

}  // namespace

RootStep root_step(const FeatureSpace& space, const RootPlace& here, const RootPlace& there) {
  return step_between(here.heading, space.cm_per_unit * (there.x - here.x), space.cm_per_unit * (there.z - here.z),
                      there.heading - here.heading);
}

RootPlace place_after(const FeatureSpace& space, const RootPlace& here, const RootStep& step) {
  const double c = std::cos(here.heading), s = std::sin(here.heading);
  return {here.x + (c * step[0] + s * step[1]) / space.cm_per_unit,
          here.z + (-s * step[0] + c * step[1]) / space.cm_per_unit, here.heading + step[2]};
}

struct GapExamples::State {
  State(const MotionTexture& m, const GapShape& s)
      : model(m),
        shape(s),
        before_lags(lags_of(m.frame_time_secs(), s.num_before)),
        after_lags(lags_of(m.frame_time_secs(), s.num_after)),
        roots(integrate_roots(m)) {
    find_rows();
    describe_rows();
    factor();
  }

  /// Every frame, or every second, third … where there are too many.
  void find_rows() {
    const Index before = std::max<Index>(2, shape.num_before), after = std::max<Index>(2, shape.num_after);
    Index total = 0;
    for (const Run& run : model.runs) total += std::max<Index>(0, run.length - before - shape.num_frames - after + 1);
    if (total < kFewestExamples)
      throw InvalidInput("a gap of " + std::to_string(shape.num_frames) +
                         " frames is longer than what the model was learned from can show; make it shorter, or lead "
                         "over it with motex motion choreograph");
    const Index step = (total + kMostExamples - 1) / kMostExamples;
    for (const Run& run : model.runs)
      for (Index r = run.row + before - 1; r + shape.num_frames + after < run.row + run.length; r += step)
        rows.push_back(r);
  }

  Index num_seen() const {
    return static_cast<Index>(before_lags.size() + after_lags.size()) * model.global_subspace.basis.cols() +
           (shape.is_end_placed ? 3 : 0);
  }

  /// states_before: row i is lag before_lags[i] before the gap.
  template <typename Out>
  void describe(const FrameMatrix& before, const FrameMatrix& after, const RootStep& step, Out&& out) const {
    const Index d = model.global_subspace.basis.cols();
    Index at = 0;
    for (const FrameMatrix* side : {&before, &after})
      for (Index i = 0; i < side->rows(); ++i, at += d) {
        out.segment(at, d) = side->row(i);
        if (i > 0) out.segment(at, d) -= side->row(i - 1);
      }
    if (shape.is_end_placed) {
      out[at] = step[0];
      out[at + 1] = step[1];
      out[at + 2] = step[2] * model.features.weights[4];
    }
  }

  void describe_rows() {
    const Subspace& space = model.global_subspace;
    const FrameMatrix states = (model.corpus.cast<double>().rowwise() - space.mean.transpose()) * space.basis;
    seen.resize(static_cast<Index>(rows.size()), num_seen());
    FrameMatrix before(static_cast<Index>(before_lags.size()), states.cols()),
        after(static_cast<Index>(after_lags.size()), states.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Index end = rows[k] + shape.num_frames + 1;
      for (std::size_t i = 0; i < before_lags.size(); ++i)
        before.row(static_cast<Index>(i)) = states.row(rows[k] - before_lags[i]);
      for (std::size_t i = 0; i < after_lags.size(); ++i)
        after.row(static_cast<Index>(i)) = states.row(end + after_lags[i]);
      describe(before, after, step_between(roots, rows[k], end), seen.row(static_cast<Index>(k)));
    }
  }

  /// Centres and scales what is seen; Cholesky factor of its ridged covariance.
  void factor() {
    const auto n = static_cast<double>(seen.rows());
    mean = seen.colwise().mean().transpose();
    seen.rowwise() -= mean.transpose();
    scale = (seen.colwise().squaredNorm().transpose() / n).cwiseSqrt().cwiseMax(1e-6);
    seen.array().rowwise() /= scale.transpose().array();
    const Index s = seen.cols();
    Matrix covariance = Matrix::Identity(s, s) * (kRidge * n);
    gemm(true, false, s, s, seen.rows(), 1.0, seen.data(), s, seen.data(), s, 1.0, covariance.data(), s);
    factored.compute(covariance);
    if (factored.info() != Eigen::Success) throw NumericalFailure("the examples of a gap are not finite");
  }

  Vector squared_distances(const Vector& standardised) const {
    const Vector squares = scale.cwiseAbs2();
    Vector out(seen.rows());
    for (Index k = 0; k < seen.rows(); ++k) out[k] = (seen.row(k).transpose() - standardised).cwiseAbs2().dot(squares);
    return out;
  }

  const MotionTexture& model;
  GapShape shape;
  std::vector<Index> before_lags, after_lags;
  FrameMatrix roots;
  std::vector<Index> rows;
  FrameMatrix seen;  ///< standardised
  Vector mean, scale;
  Eigen::LLT<Matrix> factored;
};

GapExamples::GapExamples(const MotionTexture& model, const GapShape& shape)
    : state_(std::make_unique<State>(model, shape)) {}
GapExamples::~GapExamples() = default;
GapExamples::GapExamples(GapExamples&&) noexcept = default;

Index GapExamples::row(int example) const { return state_->rows[static_cast<std::size_t>(example)]; }
int GapExamples::size() const { return static_cast<int>(state_->rows.size()); }

Vector GapExamples::seen(const FrameMatrix& before, const FrameMatrix& after, const RootStep& step) const {
  const Subspace& space = state_->model.global_subspace;
  const auto states = [&](const FrameMatrix& features, const std::vector<Index>& lags, bool at_end) {
    FrameMatrix out(static_cast<Index>(lags.size()), space.basis.cols());
    for (std::size_t i = 0; i < lags.size(); ++i)
      out.row(static_cast<Index>(i)) =
          (features.row(at_end ? features.rows() - 1 - lags[i] : lags[i]) - space.mean.transpose()) * space.basis;
    return out;
  };
  Vector out(state_->num_seen());
  state_->describe(states(before, state_->before_lags, true), states(after, state_->after_lags, false), step, out);
  return out;
}

double GapExamples::nearest_distance(const Vector& seen) const {
  const Vector z = (seen - state_->mean).cwiseQuotient(state_->scale);
  return std::sqrt(state_->squared_distances(z).minCoeff() / static_cast<double>(seen.size()));
}

GapExamples::Weights GapExamples::weigh(const Vector& seen, int examples, double strength) const {
  const State& s = *state_;
  const Vector z = (seen - s.mean).cwiseQuotient(s.scale);
  const Vector distances = s.squared_distances(z);
  Weights out;
  out.nearest.resize(s.rows.size());
  std::iota(out.nearest.begin(), out.nearest.end(), 0);
  const auto kept = static_cast<std::size_t>(std::clamp<int>(examples, 1, size()));
  std::partial_sort(out.nearest.begin(), out.nearest.begin() + static_cast<std::ptrdiff_t>(kept), out.nearest.end(),
                    [&](int a, int b) { return distances[a] != distances[b] ? distances[a] < distances[b] : a < b; });
  out.nearest.resize(kept);
  const double least = distances[out.nearest[0]];
  out.distance = std::sqrt(least / static_cast<double>(seen.size()));
  Vector followed = Vector::Zero(size());
  for (const int k : out.nearest)
    followed[k] = std::exp(-(distances[k] - least) / std::max(1e-9, kKernelWidth * least));
  followed *= strength / followed.sum();
  const Vector left = z - s.seen.transpose() * followed;
  out.weights = s.seen * s.factored.solve(left) + followed;
  out.weights.array() += (1 - strength) / static_cast<double>(size());
  return out;
}

GapPath GapExamples::mix(const Vector& weights) const {
  const State& s = *state_;
  const Index length = s.shape.num_frames + 4;
  GapPath path{FrameMatrix::Zero(length, s.model.features.size()), FrameMatrix::Zero(length, 3)};
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    const double a = weights[static_cast<Index>(k)];
    const Index first = s.rows[k] - 1;
    path.features += a * s.model.corpus.middleRows(first, length).cast<double>();
    for (Index t = 0; t < length; ++t) path.root.row(t) += a * step_between(s.roots, s.rows[k], first + t).transpose();
  }
  return path;
}

}  // namespace motex
