// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/root_path.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/options_check.h"

namespace motex {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr double kTurnCm = 20;          // a radian of turning costs as much as so many cm of stepping
constexpr double kSmoothSecs = 0.25;    // over which movement is averaged
constexpr double kTaperSecs = 0.25;     // before and after a frame whose speed stays
constexpr double kStandingShare = 0.1;  // of the mean movement: what standing frames count
constexpr double kLeastMoveCm = 1e-3;
constexpr double kSpareCm = 1;        // beyond the body's radius, around boxes
constexpr double kLongestDetour = 2;  // around boxes, against the way without them
constexpr double kShortestWay = 0.5;  // of the old one: less is walking on the spot
constexpr int kContinuation = 8, kPushSteps = 2, kMostNewton = 30, kMostPushes = 40;

/// coefficients · (x, z, ψ), averaged over the frames frame − spread … frame + spread, shall be `value`.
struct Row {
  Index frame = 0, spread = 0;
  Vector3 coefficients = Vector3::Zero();
  double value = 0;
};

Vector2 turned(const Vector2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() + s * v.y(), -s * v.x() + c * v.y()};
}

class Bender {
 public:
  Bender(const RootPath& path, double frame_time_secs, double cm_per_unit);
  /// Correction goes to 0 around this frame.
  void hold(Index frame);
  Index num_frames() const { return path_.num_frames(); }
  Index smooth_frames() const { return smooth_; }
  const RootPath& path() const { return path_; }
  double cost() const;
  /// False when some row is not met.
  bool meet(const std::vector<Row>& rows, int continuation);

 private:
  Vector residuals(const std::vector<Row>& rows) const;
  Matrix jacobian(const std::vector<Row>& rows) const;
  void step(const std::vector<Row>& rows, double share);
  void integrate();

  double cm_;
  Index smooth_, taper_;
  RootPath path_;
  FrameMatrix steps_;        // frames × 3: v_x, v_z, Δψ of the path as it was
  FrameMatrix corrections_;  // b_x, b_z, a
  Vector freedom_;           // B_t; A_t = B_t / kTurnCm²
};

Bender::Bender(const RootPath& path, double frame_time_secs, double cm_per_unit)
    : cm_(cm_per_unit),
      smooth_(std::max<Index>(1, std::lround(kSmoothSecs / frame_time_secs / 2))),
      taper_(std::max<Index>(1, std::lround(kTaperSecs / frame_time_secs))),
      path_(path) {
  const Index n = path.num_frames();
  taper_ = std::min(taper_, std::max<Index>(1, n / 4));
  steps_.setZero(n, 3);
  corrections_.setZero(n, 3);
  Vector moved = Vector::Zero(n);
  for (Index t = 1; t < n; ++t) {
    const Vector2 step = turned({path.x[t] - path.x[t - 1], path.z[t] - path.z[t - 1]}, -path.heading[t - 1]);
    steps_.row(t) << step.x(), step.y(), path.heading[t] - path.heading[t - 1];
    moved[t] = cm_ * step.norm() + kTurnCm * std::abs(steps_(t, 2));
  }
  const double standing = kStandingShare * moved.mean() + kLeastMoveCm;
  freedom_.resize(n);
  for (Index t = 0; t < n; ++t) {
    const Index first = std::max<Index>(1, t - smooth_), last = std::min(n - 1, t + smooth_);
    freedom_[t] = standing + (last < first ? 0 : moved.segment(first, last + 1 - first).mean());
  }
  hold(0);
  hold(n - 1);
}

void Bender::hold(Index frame) {
  for (Index t = std::max<Index>(0, frame - taper_); t <= std::min(num_frames() - 1, frame + taper_ + 1); ++t) {
    // The step into a frame and the one out of it are both the frame's own.
    const double away =
        std::max<double>(0, t <= frame ? static_cast<double>(frame - t) : static_cast<double>(t - frame - 1));
    const double u = away / static_cast<double>(taper_);
    freedom_[t] *= u >= 1 ? 1 : u * u * (3 - 2 * u);
  }
}

void Bender::integrate() {
  for (Index t = 1; t < num_frames(); ++t) {
    const Vector2 step =
        turned({steps_(t, 0) + corrections_(t, 0), steps_(t, 1) + corrections_(t, 1)}, path_.heading[t - 1]);
    path_.x[t] = path_.x[t - 1] + step.x();
    path_.z[t] = path_.z[t - 1] + step.y();
    path_.heading[t] = path_.heading[t - 1] + steps_(t, 2) + corrections_(t, 2);
  }
}

Vector Bender::residuals(const std::vector<Row>& rows) const {
  Vector out(static_cast<Index>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Index first = rows[r].frame - rows[r].spread, count = 2 * rows[r].spread + 1;
    const Vector3 mean(path_.x.segment(first, count).mean(), path_.z.segment(first, count).mean(),
                       path_.heading.segment(first, count).mean());
    out[static_cast<Index>(r)] = rows[r].value - rows[r].coefficients.dot(mean);
  }
  return out;
}

/// Rows × 3·frames.
Matrix Bender::jacobian(const std::vector<Row>& rows) const {
  Matrix out = Matrix::Zero(static_cast<Index>(rows.size()), 3 * num_frames());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    const Vector2 d = row.coefficients.head<2>();
    const double weight = 1 / static_cast<double>(2 * row.spread + 1);
    double later = 0;  // share of the average at this frame or after it
    Vector2 mean = Vector2::Zero();
    for (Index t = row.frame + row.spread; t > 0; --t) {
      if (t >= row.frame - row.spread) {
        later += weight;
        mean += weight * Vector2(path_.x[t], path_.z[t]);
      }
      const Vector2 lever = mean - later * Vector2(path_.x[t], path_.z[t]);
      const Vector2 local = later * turned(d, -path_.heading[t - 1]);
      out.block<1, 3>(static_cast<Index>(r), 3 * t) << local.x(), local.y(),
          later * row.coefficients[2] + d.x() * lever.y() - d.y() * lever.x();
    }
  }
  return out;
}

/// Takes away that share of what is missing, in the cheapest way.
void Bender::step(const std::vector<Row>& rows, double share) {
  const Matrix j = jacobian(rows);
  Matrix weighted = j;
  for (Index t = 0; t < num_frames(); ++t) {
    weighted.middleCols(3 * t, 2) *= freedom_[t] / (cm_ * cm_);
    weighted.col(3 * t + 2) *= freedom_[t] / (kTurnCm * kTurnCm);
  }
  Matrix gram = weighted * j.transpose();
  gram.diagonal() *= 1 + 1e-12;
  const Vector change = weighted.transpose() * Eigen::LDLT<Matrix>(gram).solve(Vector(share * residuals(rows)));
  if (!change.allFinite()) return;
  for (Index t = 0; t < num_frames(); ++t) corrections_.row(t) += change.segment<3>(3 * t).transpose();
  integrate();
}

bool Bender::meet(const std::vector<Row>& rows, int continuation) {
  if (rows.empty()) return true;
  for (int k = 0; k < continuation; ++k) step(rows, 1.0 / (continuation - k));
  const double scale = 1 + path_.x.cwiseAbs().maxCoeff() + path_.z.cwiseAbs().maxCoeff();
  for (int k = 0; k < kMostNewton; ++k) {
    if (residuals(rows).cwiseAbs().maxCoeff() < 1e-11 * scale) break;
    step(rows, 1);
  }
  return path_.x.allFinite() && path_.z.allFinite() && residuals(rows).cwiseAbs().maxCoeff() < 1e-9 * scale;
}

double Bender::cost() const {
  double sum = 0;
  for (Index t = 1; t < num_frames(); ++t)
    if (freedom_[t] > 0)
      sum += (cm_ * cm_ * corrections_.row(t).head<2>().squaredNorm() +
              kTurnCm * kTurnCm * corrections_(t, 2) * corrections_(t, 2)) /
             freedom_[t];
  return sum;
}

double way_length(const RootPath& path) {
  double sum = 0;
  for (Index t = 1; t < path.num_frames(); ++t) sum += std::hypot(path.x[t] - path.x[t - 1], path.z[t] - path.z[t - 1]);
  return sum;
}

std::string described(const FloorBox& box) {
  const auto text = [](double value) {
    std::string s = std::to_string(value);
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s;
  };
  return "the box " + text(box.x0) + "," + text(box.z0) + "," + text(box.x1) + "," + text(box.z1);
}

FloorBox grown(const FloorBox& box, double by) {
  return {std::min(box.x0, box.x1) - by, std::min(box.z0, box.z1) - by, std::max(box.x0, box.x1) + by,
          std::max(box.z0, box.z1) + by};
}

/// Distance to a box with sides in order; negative inside.
double distance(const FloorBox& box, double x, double z) {
  const double dx = std::max(box.x0 - x, x - box.x1), dz = std::max(box.z0 - z, z - box.z1);
  return dx <= 0 || dz <= 0 ? std::max(dx, dz) : std::hypot(dx, dz);
}

/// Sides of a box: the outward direction and how far out it lies.
struct Side {
  Vector2 out;
  double at;
};
std::vector<Side> sides(const FloorBox& box) {
  return {{{-1, 0}, -box.x0}, {{1, 0}, box.x1}, {{0, -1}, -box.z0}, {{0, 1}, box.z1}};
}

/// A stretch of frames inside a box that is pushed out on one side.
struct Push {
  std::size_t box;
  Index first, last;
  Side side;
  std::vector<Row> rows;
};

/// Farthest that a frame of first … last must go to be beyond the side; the frame is `deepest`.
double depth(const RootPath& path, Index first, Index last, const Side& side, Index& deepest) {
  double most = -std::numeric_limits<double>::infinity();
  for (Index t = first; t <= last; ++t) {
    const double now = side.at - side.out.dot(Vector2(path.x[t], path.z[t]));
    if (now > most) most = now, deepest = t;
  }
  return most;
}

/// The side on which the stretch comes out with the `rank`-th least push.
Side choose_side(const RootPath& path, Index first, Index last, const FloorBox& box, int rank) {
  std::vector<std::pair<double, Side>> choices;
  Index deepest = first;
  for (const Side& side : sides(box)) choices.emplace_back(depth(path, first, last, side, deepest), side);
  std::stable_sort(choices.begin(), choices.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return choices[static_cast<std::size_t>(rank)].second;
}

/// Adds or strengthens the rows that push what is inside boxes out of them. False when nothing is inside.
bool push_out(const Bender& bender, const std::vector<FloorBox>& boxes, double spare, int rank,
              std::vector<Push>& pushes) {
  const RootPath& path = bender.path();
  bool any = false;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (Index t = 0; t < path.num_frames(); ++t) {
      if (distance(boxes[b], path.x[t], path.z[t]) >= 0) continue;
      Index last = t;
      while (last + 1 < path.num_frames() && distance(boxes[b], path.x[last + 1], path.z[last + 1]) < 0) ++last;
      any = true;
      auto push = std::find_if(pushes.begin(), pushes.end(), [&](const Push& p) {
        return p.box == b && p.first <= last + bender.smooth_frames() && p.last + bender.smooth_frames() >= t;
      });
      if (push == pushes.end())
        push = pushes.insert(pushes.end(), {b, t, last, choose_side(path, t, last, boxes[b], rank), {}});
      push->first = std::min(push->first, t), push->last = std::max(push->last, last);
      Index deepest = t;
      const double missing = depth(path, t, last, push->side, deepest) + spare;
      const Index spread = std::min({bender.smooth_frames(), deepest, path.num_frames() - 1 - deepest});
      const auto near = std::find_if(push->rows.begin(), push->rows.end(), [&](const Row& r) {
        return std::abs(r.frame - deepest) <= 2 * bender.smooth_frames();
      });
      if (near != push->rows.end()) {
        near->value += missing;
      } else {
        const double here = push->side.out.x() * path.x.segment(deepest - spread, 2 * spread + 1).mean() +
                            push->side.out.y() * path.z.segment(deepest - spread, 2 * spread + 1).mean();
        push->rows.push_back({deepest, spread, {push->side.out.x(), push->side.out.y(), 0}, here + missing});
      }
      t = last;
    }
  return any;
}

std::vector<Row> target_rows(const RootPath& path, std::span<const RootTarget> targets) {
  std::vector<Row> rows;
  for (const RootTarget& target : targets) {
    if (target.frame <= 0 || target.frame >= path.num_frames())
      throw InvalidInput("no place can be asked for at frame " + std::to_string(target.frame) + ": frames 1 … " +
                         std::to_string(path.num_frames() - 1) + " can be led somewhere");
    for (const Row& row : rows)
      if (row.frame == target.frame)
        throw InvalidInput("two places are asked for at frame " + std::to_string(target.frame));
    rows.push_back({target.frame, 0, Vector3::UnitX(), target.x});
    rows.push_back({target.frame, 0, Vector3::UnitY(), target.z});
    if (!target.heading) continue;
    const double now = path.heading[target.frame];
    rows.push_back(
        {target.frame, 0, Vector3::UnitZ(), now + std::remainder(*target.heading - now, 2 * std::numbers::pi)});
  }
  return rows;
}

void check_outside(const std::vector<FloorBox>& grown_boxes, std::span<const FloorBox> boxes, double x, double z,
                   const std::string& what) {
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (distance(grown_boxes[b], x, z) < 0)
      throw InvalidInput(what + " lies inside " + described(boxes[b]) + " or nearer to it than the body's radius");
}

}  // namespace

double clearance(const RootPath& path, std::span<const FloorBox> boxes, Index& frame) {
  double least = std::numeric_limits<double>::infinity();
  for (const FloorBox& box : boxes)
    for (Index t = 0; t < path.num_frames(); ++t) {
      const double now = distance(grown(box, 0), path.x[t], path.z[t]);
      if (now < least) least = now, frame = t;
    }
  return least;
}

BendPathReport bend_root_path(RootPath& path, double frame_time_secs, double cm_per_unit,
                              std::span<const RootTarget> targets, std::span<const FloorBox> boxes,
                              std::span<const Index> fixed, const BendPathOptions& options) {
  check_options(options);
  const std::vector<Row> wanted = target_rows(path, targets);
  std::vector<FloorBox> around;
  for (const FloorBox& box : boxes) around.push_back(grown(box, options.body_radius / cm_per_unit));
  if (path.num_frames() > 0) check_outside(around, boxes, path.x[0], path.z[0], "the start");
  for (const RootTarget& target : targets)
    check_outside(around, boxes, target.x, target.z, "the place at frame " + std::to_string(target.frame));
  double direct = way_length(path);
  for (int rank = 0; rank < (boxes.empty() ? 1 : 4); ++rank) {
    Bender bender(path, frame_time_secs, cm_per_unit);
    for (const Index frame : fixed) bender.hold(frame);
    for (const RootTarget& target : targets) bender.hold(target.frame);
    std::vector<Push> pushes;
    std::vector<Row> rows = wanted;
    bool met = bender.meet(rows, kContinuation), inside = true;
    if (!met && rank == 0) throw InvalidInput("the places asked for cannot be reached by this dance");
    direct = std::max(direct, way_length(bender.path()));
    const double shortest = std::min(way_length(path), way_length(bender.path()));
    for (int k = 0; met && inside && k < kMostPushes; ++k) {
      inside = push_out(bender, around, kSpareCm / cm_per_unit, rank, pushes);
      if (!inside) break;
      rows = wanted;
      for (const Push& push : pushes) rows.insert(rows.end(), push.rows.begin(), push.rows.end());
      met = bender.meet(rows, kPushSteps) && way_length(bender.path()) < kLongestDetour * direct;
    }
    if (!met || inside || way_length(bender.path()) < kShortestWay * shortest) continue;
    BendPathReport report;
    report.cost = bender.cost();
    report.largest_turn = (bender.path().heading - path.heading).cwiseAbs().maxCoeff();
    report.largest_shift =
        ((bender.path().x - path.x).cwiseAbs2() + (bender.path().z - path.z).cwiseAbs2()).cwiseSqrt().maxCoeff();
    report.way = way_length(bender.path()) / std::max(way_length(path), 1e-9);
    Index frame = 0;
    path = bender.path();
    report.clearance = clearance(path, boxes, frame);
    return report;
  }
  Index frame = 0;
  clearance(path, boxes, frame);
  std::size_t nearest = 0;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (distance(around[b], path.x[frame], path.z[frame]) < distance(around[nearest], path.x[frame], path.z[frame]))
      nearest = b;
  throw InvalidInput("no way around " + described(boxes[nearest]) + " was found (frame " + std::to_string(frame) +
                     "); give the dance more frames, or another seed or place");
}

}  // namespace motex
