// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/element_shapes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/particles/shape_fit.h"

namespace motex {
namespace {

constexpr std::size_t kSureLength = 6;  // sights of a path that is learned from
constexpr std::size_t kFewest = 40;     // elements that stand alone, to learn from
constexpr double kFewestAlone = 0.27;   // share of all sights: where fewer do, overlaps decide
constexpr std::size_t kMost = 800;      // more are not looked at
constexpr std::size_t kEachShape = 20;  // elements
constexpr std::size_t kMostShapes = 8;
constexpr double kIsolation = 3;        // |distance| > 3 · (scale + other scale)
constexpr double kFromRim = 3;          // scales from the picture's edge
constexpr double kTurnDeviation = 0.5;  // radians, before anything is known
constexpr double kMostTurn = 0.8;       // as flight tells it
constexpr double kClearly = 0.9;        // of the distance from the pictures without turns
constexpr double kLevel = 0.11;         // deviation of turns up to which elements are level
constexpr double kNoTurn = 1e-3;
constexpr std::size_t kHeadingSights = 6;  // before and behind, that tell the direction of flight
constexpr int kGroupings = 12;
constexpr int kAlignments = 4;
constexpr double kOutlying = 2.5;  // times the median distance from the picture of its group
constexpr double kJump = 3;        // scales, of a second difference along a path: an outlier
constexpr float kPart = 0.06F;     // of the amplitude: what is fainter is no part
constexpr double kFade = 0.8;      // of the reach: from there pictures fade out

/// One element in one frame.
struct Example {
  std::size_t chain = 0, sight = 0;
  int frame = 0;
  ShapedElement element;
  ShapedPrior prior;
  double heading = 0;  // direction of flight, radians
  std::vector<float> picture;
  double distance = 0;  // squared, from the picture of its group
};

std::size_t index_of(int row, int column) {
  return static_cast<std::size_t>(row) * ShapeGrid::kSide + static_cast<std::size_t>(column);
}

double grid_value(int k) { return -ShapeGrid::kReach + k * ShapeGrid::kSpacing; }

double value_between(const Plane& image, double x, double y) {
  const double cx = std::clamp(x, 0.0, image.width - 1.001), cy = std::clamp(y, 0.0, image.height - 1.001);
  const int left = static_cast<int>(cx), top = static_cast<int>(cy);
  const double fx = cx - left, fy = cy - top;
  const auto at = [&](int dx, int dy) { return static_cast<double>(image.at(left + dx, top + dy)); };
  return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
}

std::vector<float> picture_of(const Plane& image, const ShapedElement& e) {
  std::vector<float> out(static_cast<std::size_t>(ShapeGrid::kSide) * ShapeGrid::kSide);
  const double along = std::exp(e.log_scale) * std::cos(e.turn), across = std::exp(e.log_scale) * std::sin(e.turn);
  for (int row = 0; row < ShapeGrid::kSide; ++row)
    for (int column = 0; column < ShapeGrid::kSide; ++column) {
      const double u = grid_value(column), v = grid_value(row);
      out[index_of(row, column)] = static_cast<float>(
          value_between(image, e.x + along * u - across * v, e.y + across * u + along * v) / e.amplitude);
    }
  return out;
}

double median_near(const std::vector<const Blob*>& path, std::size_t k, double Blob::*field) {
  std::vector<double> values;
  const std::size_t first = k > 7 ? k - 7 : 0, end = std::min(path.size(), k + 8);
  for (std::size_t i = first; i < end; ++i) values.push_back(path[i]->*field);
  return median(std::move(values));
}

/// Direction of a path around its k-th sight.
double heading_at(const SightChain& chain, std::size_t k) {
  const Sight &from = chain.sights[k > kHeadingSights ? k - kHeadingSights : 0],
              &to = chain.sights[std::min(chain.sights.size() - 1, k + kHeadingSights)];
  return std::atan2(to.y - from.y, to.x - from.x);
}

/// In (−π, π].
double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

bool stands_alone(const Blob& blob, const std::vector<Blob>& others, int width, int height) {
  const double scale = blob.scale(), rim = kFromRim * scale;
  if (blob.x < rim || blob.y < rim || blob.x > width - 1 - rim || blob.y > height - 1 - rim) return false;
  return std::none_of(others.begin(), others.end(), [&](const Blob& other) {
    return &other != &blob && std::hypot(other.x - blob.x, other.y - blob.y) < kIsolation * (scale + other.scale());
  });
}

class ShapeLearner {
 public:
  ShapeLearner(const std::vector<Plane>& residuals, const std::vector<std::vector<Blob>>& blobs,
               const std::vector<SightChain>& chains, double noise)
      : noise_(noise), residuals_(residuals) {
    for (std::size_t c = 0; c < chains.size(); ++c)
      if (chains[c].sights.size() >= kSureLength) collect(c, chains[c], blobs);
    std::size_t num = 1;
    for (const std::vector<Blob>& frame : blobs) num += frame.size();
    alone_ = static_cast<double>(examples_.size()) / static_cast<double>(num);
    if (examples_.size() <= kMost) return;
    std::vector<Example> some;
    for (std::size_t i = 0; i < kMost; ++i) some.push_back(std::move(examples_[i * examples_.size() / kMost]));
    examples_ = std::move(some);
  }

  ElementShapes run() {
    ElementShapes out;
    out.alone = alone_;
    if (examples_.size() < kFewest || alone_ < kFewestAlone) return out;
    const std::vector<Example> collected = examples_;
    out = learned();
    if (out.turn_deviation > kLevel) return out;
    examples_ = collected;  // turns would only blur the pictures
    is_level_ = true;
    for (Example& one : examples_) {
      one.element.turn = 0;
      one.prior.precision[4] = 1 / (kNoTurn * kNoTurn);
    }
    return learned();
  }

 private:
  ElementShapes learned() {
    ElementShapes out;
    out.alone = alone_;
    describe(out);
    group();
    if (!is_level_ && !are_turned()) turn_by_flight();
    for (int step = 0; step < kAlignments; ++step) {
      make_shapes(out);
      align(out);
      join_paths();
      look_again();
      regroup();
    }
    describe_turns(out);
    centre_core(out);
    make_shapes(out);
    judge(out);
    return out;
  }

  const Plane& image_of(const Example& one) const { return residuals_[static_cast<std::size_t>(one.frame)]; }

  void collect(std::size_t c, const SightChain& chain, const std::vector<std::vector<Blob>>& blobs) {
    std::vector<const Blob*> path;
    for (std::size_t k = 0; k < chain.sights.size(); ++k)
      path.push_back(&blobs[static_cast<std::size_t>(chain.sights[k].frame)][static_cast<std::size_t>(chain.idx[k])]);
    for (std::size_t k = 0; k < path.size(); ++k) {
      const int frame = chain.sights[k].frame;
      const Plane& image = residuals_[static_cast<std::size_t>(frame)];
      if (!stands_alone(*path[k], blobs[static_cast<std::size_t>(frame)], image.width, image.height)) continue;
      Example one;
      one.chain = c;
      one.sight = k;
      one.frame = frame;
      one.element.x = path[k]->x;
      one.element.y = path[k]->y;
      one.element.log_scale = median_near(path, k, &Blob::log_scale);
      one.element.amplitude = median_near(path, k, &Blob::amplitude);
      const double a = one.element.amplitude;
      one.prior.mean = {0, 0, one.element.log_scale, a, 0};
      one.prior.precision = {0, 0, 1 / (0.05 * 0.05), 1 / (0.1 * 0.1 * a * a), 1 / (kTurnDeviation * kTurnDeviation)};
      one.heading = heading_at(chain, k);
      one.element.turn = path[k]->turn;
      one.picture = picture_of(image, one.element);
      examples_.push_back(std::move(one));
    }
  }

  void describe(ElementShapes& out) const {
    std::vector<double> scales, amplitudes;
    for (const Example& one : examples_) {
      scales.push_back(one.element.log_scale);
      amplitudes.push_back(one.element.amplitude);
    }
    out.mean_log_scale = median(scales);
    out.log_scale_deviation = std::max(0.15, spread(scales, out.mean_log_scale));
    out.mean_amplitude = median(amplitudes);
    out.amplitude_deviation = std::max(0.15 * std::abs(out.mean_amplitude), spread(amplitudes, out.mean_amplitude));
  }

  void group() {
    start_groups();
    for (int step = 0; step < kGroupings; ++step) regroup();
  }

  /// Whether they were found by shapes, with their turns.
  bool are_turned() const {
    return std::any_of(examples_.begin(), examples_.end(), [](const Example& one) { return one.element.turn != 0; });
  }

  double median_distance() const {
    std::vector<double> distances;
    for (const Example& one : examples_) distances.push_back(one.distance);
    return median(std::move(distances));
  }

  /// Turns as the flight leads up or down, where that makes pictures of a group more alike.
  void turn_by_flight() {
    double x = 0, y = 0;
    for (const Example& one : examples_) {
      x += std::cos(one.heading);
      y += std::sin(one.heading);
    }
    const double usual = std::atan2(y, x), before = median_distance();
    const std::vector<Example> level = examples_;
    const std::vector<std::vector<float>> level_pictures = pictures_;
    for (Example& one : examples_) {
      one.element.turn = std::clamp(wrapped(one.heading - usual), -kMostTurn, kMostTurn);
      one.picture = picture_of(image_of(one), one.element);
    }
    group();
    if (median_distance() < kClearly * before) return;
    examples_ = level;
    pictures_ = level_pictures;
  }

  void describe_turns(ElementShapes& out) const {
    std::vector<double> turns;
    for (const Example& one : examples_) turns.push_back(one.element.turn);
    out.mean_turn = median(turns);
    out.turn_deviation = is_level_ ? kNoTurn : spread(std::move(turns), out.mean_turn);
  }

  static double spread(std::vector<double> values, double middle) {
    for (double& value : values) value = std::abs(value - middle);
    return 1.4826 * median(std::move(values));
  }

  static double distance(const std::vector<float>& a, const std::vector<float>& b) {
    float sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return static_cast<double>(sum);
  }

  /// Each new group begins with the example that is worst described by those before.
  void start_groups() {
    const std::size_t num = std::clamp<std::size_t>(examples_.size() / kEachShape, 1, kMostShapes);
    pictures_.assign(1, std::vector<float>(examples_[0].picture.size(), 0));
    for (Example& one : examples_) one.element.shape = 0;
    average();
    std::vector<double> least(examples_.size(), 1e300);
    while (pictures_.size() < num) {
      for (std::size_t i = 0; i < examples_.size(); ++i)
        least[i] = std::min(least[i], distance(examples_[i].picture, pictures_.back()));
      // The 90 % quantile: the very worst are no single elements.
      std::vector<std::pair<double, std::size_t>> order;
      for (std::size_t i = 0; i < least.size(); ++i) order.emplace_back(least[i], i);
      const auto place = order.begin() + static_cast<std::ptrdiff_t>(order.size() * 9 / 10);
      std::nth_element(order.begin(), place, order.end());
      pictures_.push_back(examples_[place->second].picture);
    }
  }

  void regroup() {
    for (Example& one : examples_) {
      double least = 1e300;
      for (std::size_t k = 0; k < pictures_.size(); ++k) {
        const double d = distance(one.picture, pictures_[k]);
        if (d >= least) continue;
        least = d;
        one.element.shape = static_cast<int>(k);
      }
    }
    average();
  }

  /// Mean pictures of the groups, outliers left out.
  void average() {
    std::vector<double> distances;
    for (Example& one : examples_) {
      one.distance = distance(one.picture, pictures_[static_cast<std::size_t>(one.element.shape)]);
      distances.push_back(one.distance);
    }
    const double limit = kOutlying * median(distances);
    for (std::size_t k = 0; k < pictures_.size(); ++k) {
      std::vector<float> sum(pictures_[k].size(), 0);
      float num = 0;
      for (const Example& one : examples_) {
        if (one.element.shape != static_cast<int>(k) || one.distance > limit) continue;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one.picture[i];
        num += 1;
      }
      if (num < 3) continue;
      for (float& value : sum) value /= num;
      pictures_[k] = std::move(sum);
    }
  }

  void make_shapes(ElementShapes& out) const {
    out.shapes.clear();
    for (const std::vector<float>& picture : pictures_) out.shapes.emplace_back(picture);
  }

  /// Examples to the places where the pictures of their groups fit best.
  void align(const ElementShapes& shapes) {
    parallel_for(0, static_cast<int>(examples_.size()), [&](int i) {
      Example& one = examples_[static_cast<std::size_t>(i)];
      ShapedElement next = one.element;
      ShapeFitter(image_of(one), shapes, noise_).try_shape(next, one.prior);
      if (std::hypot(next.x - one.element.x, next.y - one.element.y) < std::exp(one.element.log_scale))
        one.element = next;
    });
  }

  /// Shifts of whole groups after which second differences along paths are least (in scales).
  void join_paths() {
    const auto num = static_cast<Eigen::Index>(pictures_.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(num, num);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(num, 2);
    for (std::size_t i = 2; i < examples_.size(); ++i) {
      const Example &a = examples_[i - 2], &b = examples_[i - 1], &c = examples_[i];
      if (a.chain != c.chain || c.frame - a.frame != 2) continue;
      const double scale = std::exp(b.element.log_scale);
      const double turn_cos = std::cos(b.element.turn) / scale, turn_sin = std::sin(b.element.turn) / scale;
      const double ax = a.element.x - 2 * b.element.x + c.element.x, ay = a.element.y - 2 * b.element.y + c.element.y;
      const double dx = turn_cos * ax + turn_sin * ay, dy = turn_cos * ay - turn_sin * ax;
      if (std::hypot(dx, dy) > kJump) continue;
      Eigen::VectorXd row = Eigen::VectorXd::Zero(num);
      row[a.element.shape] += 1;
      row[b.element.shape] -= 2;
      row[c.element.shape] += 1;
      normal += row * row.transpose();
      right.col(0) -= dx * row;
      right.col(1) -= dy * row;
    }
    const Eigen::MatrixXd shift = normal.ldlt().solve(right);
    for (Example& one : examples_) move(one, shift(one.element.shape, 0), shift(one.element.shape, 1));
  }

  static void move(Example& one, double du, double dv) {
    const double scale = std::exp(one.element.log_scale), c = std::cos(one.element.turn),
                 s = std::sin(one.element.turn);
    one.element.x += scale * (c * du - s * dv);
    one.element.y += scale * (s * du + c * dv);
  }

  void look_again() {
    for (Example& one : examples_) one.picture = picture_of(image_of(one), one.element);
    average();
  }

  /// The core is what is there in (nearly) all states.
  void centre_core(ElementShapes& out) {
    Plane common(ShapeGrid::kSide, ShapeGrid::kSide);
    std::vector<double> values(pictures_.size());
    for (std::size_t i = 0; i < common.values.size(); ++i) {
      for (std::size_t k = 0; k < pictures_.size(); ++k) values[k] = static_cast<double>(pictures_[k][i]);
      common.values[i] = static_cast<float>(quantile(values, 0.25));
    }
    FitBlobsOptions fit{0.05, true, 0.3 / ShapeGrid::kSpacing, 2 / ShapeGrid::kSpacing};
    BlobFitter fitter(common, fit);
    constexpr double kMiddle = (ShapeGrid::kSide - 1) / 2.0;
    fitter.add({kMiddle, kMiddle, -std::log(ShapeGrid::kSpacing), 0, 0, 1});
    fitter.fit(3);
    out.core = fitter.blobs()[0];
    const double du = (out.core.x - kMiddle) * ShapeGrid::kSpacing, dv = (out.core.y - kMiddle) * ShapeGrid::kSpacing;
    out.core.x = out.core.y = 0;
    out.core.e1 = out.core.e2 = 0;  // round: what is longer is the coils' part
    out.core.log_scale += std::log(ShapeGrid::kSpacing);
    for (Example& one : examples_) move(one, du, dv);
    look_again();
  }

  /// What the pictures do not say of the examples is noise to those who fit them.
  void judge(ElementShapes& out) const {
    std::vector<double> shares, squares;
    for (const Example& one : examples_) {
      ShapeFitter fitter(image_of(one), out, noise_);
      fitter.add(one.element, one.prior);
      shares.push_back(fitter.agreement(0));
      squares.push_back(fitter.misfit(0));
    }
    out.explained = median(std::move(shares));
    out.noise = std::max(noise_, std::sqrt(median(std::move(squares))));
  }

  double noise_, alone_ = 0;
  bool is_level_ = false;  ///< turns are not learned
  const std::vector<Plane>& residuals_;
  std::vector<Example> examples_;
  std::vector<std::vector<float>> pictures_;
};

/// The points that hang together with the middle, and those next to them.
std::vector<char> parts_of(const std::vector<float>& values) {
  constexpr int kSide = ShapeGrid::kSide, kMiddle = kSide / 2;
  std::vector<char> out(values.size(), 0);
  std::vector<std::pair<int, int>> open;
  for (int row = kMiddle - 2; row <= kMiddle + 2; ++row)
    for (int column = kMiddle - 2; column <= kMiddle + 2; ++column) open.emplace_back(row, column);
  while (!open.empty()) {
    const auto [row, column] = open.back();
    open.pop_back();
    if (out[index_of(row, column)] != 0) continue;
    out[index_of(row, column)] = 1;
    if (values[index_of(row, column)] < kPart) continue;
    for (int r = std::max(0, row - 1); r <= std::min(kSide - 1, row + 1); ++r)
      for (int c = std::max(0, column - 1); c <= std::min(kSide - 1, column + 1); ++c)
        if (out[index_of(r, c)] == 0) open.emplace_back(r, c);
  }
  return out;
}

}  // namespace

ShapeGrid::ShapeGrid(const std::vector<float>& values) : reach_(1), points_(values.size()) {
  std::vector<float> faded = values;
  const std::vector<char> is_part = parts_of(values);
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      if (is_part[index_of(row, column)] == 0) {
        faded[index_of(row, column)] = 0;
        continue;
      }
      reach_ = std::max(reach_, std::hypot(grid_value(row), grid_value(column)));
      const double away = std::hypot(grid_value(row), grid_value(column)) / kReach;
      const double share = std::clamp((1 - away) / (1 - kFade), 0.0, 1.0);
      faded[index_of(row, column)] *= static_cast<float>(share * share * (3 - 2 * share));
    }
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      Point& point = points_[index_of(row, column)];
      point.value = faded[index_of(row, column)];
      if (row == 0 || column == 0 || row == kSide - 1 || column == kSide - 1) continue;
      constexpr auto kTwice = static_cast<float>(2 * kSpacing);
      point.along_u = (faded[index_of(row, column + 1)] - faded[index_of(row, column - 1)]) / kTwice;
      point.along_v = (faded[index_of(row + 1, column)] - faded[index_of(row - 1, column)]) / kTwice;
    }
  find_extent();
}

void ShapeGrid::find_extent() {
  extent_ = {kReach, kReach, -kReach, -kReach};
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const Point& p = points_[index_of(row, column)];
      if (p.value == 0 && p.along_u == 0 && p.along_v == 0) continue;
      // Between the points: up to the neighbours of those that are something.
      extent_.left = std::min(extent_.left, grid_value(column - 1));
      extent_.right = std::max(extent_.right, grid_value(column + 1));
      extent_.top = std::min(extent_.top, grid_value(row - 1));
      extent_.bottom = std::max(extent_.bottom, grid_value(row + 1));
    }
}

ElementShapes learn_element_shapes(const std::vector<Plane>& residuals, const std::vector<std::vector<Blob>>& blobs,
                                   const std::vector<SightChain>& chains, double noise) {
  return ShapeLearner(residuals, blobs, chains, noise).run();
}

}  // namespace motex
