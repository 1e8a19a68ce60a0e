// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/bursts.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "motex/core/matrix.h"
#include "motex/core/options_check.h"
#include "motex/particles/fit_dynamics.h"

namespace motex {
namespace {

constexpr int kFramesOfBeginning = 12;
// first places are drawn away from the crowd that they come out of, when there are later ones to go by
constexpr int kDoubtfulFrames = 5;
constexpr double kDoubt = 0.05;
constexpr double kCell = 6;              // pixels, of the votes
constexpr double kPlaceDeviation = 0.5;  // pixels, of a measured place
constexpr double kGate = 3;              // deviations within which a path goes through the origin
constexpr double kOneSided = 0.8;        // mean length of the sum of unit velocities: all the same way = 1
constexpr int kRounds = 12;
constexpr int kSectors = 12;
constexpr double kStragglersWithin = 16;    // pixels of a burst's origin
constexpr double kLeastPersistence = 0.85;  // of what flies by itself after a burst

/// What all paths of a burst share: velocity v_t = φ v_{t−1} + pull. φ = 1, no pull: straight ones.
struct Drag {
  double persistence = 1;
  std::array<double, 2> pull{};

  /// Way of unit first velocity after so many frames (before, where negative), and its slope.
  double way(double frames) const {
    return persistence == 1 ? frames : (std::pow(persistence, frames) - 1) / (persistence - 1);
  }
  double way_slope(double frames) const {
    return persistence == 1 ? 1 : std::pow(persistence, frames) * std::log(persistence) / (persistence - 1);
  }
  /// Way by the pull alone, and its slope.
  double pulled(std::size_t axis, double frames) const {
    if (persistence == 1) return pull[axis] * frames * (frames - 1) / 2;
    return pull[axis] * (frames - way(frames)) / (1 - persistence);
  }
  double pulled_slope(std::size_t axis, double frames) const {
    if (persistence == 1) return pull[axis] * (frames - 0.5);
    return pull[axis] * (1 - way_slope(frames)) / (1 - persistence);
  }
};

/// Path near the beginning of a cable: p(t) = place + velocity · way(t − t₀) + ½ acceleration (t − t₀)² + pulled(t −
/// t₀).
struct Beginning {
  int cable = 0;
  double frame = 0;
  Drag drag;
  std::array<std::array<double, 3>, 2> path{};  ///< place, velocity, acceleration of x and of y
  Eigen::Matrix3d covariance;                   ///< of the three numbers, for a deviation of 1 pixel

  double at(std::size_t axis, double t) const {
    const double d = t - frame;
    return path[axis][0] + drag.way(d) * path[axis][1] + d * d * path[axis][2] / 2 + drag.pulled(axis, d);
  }
  double velocity(std::size_t axis, double t) const {
    const double d = t - frame;
    return drag.way_slope(d) * path[axis][1] + d * path[axis][2] + drag.pulled_slope(axis, d);
  }
  /// Of a place at that time.
  double variance(double t) const {
    const double d = t - frame;
    const Eigen::Vector3d row(1, drag.way(d), d * d / 2);
    return kPlaceDeviation * kPlaceDeviation * (1 + row.dot(covariance * row));
  }
};

/// acceleration: deviation of what the drag does not explain, pixels a frame².
Beginning beginning_of(const Cable& cable, int idx, const Drag& drag = {}, double acceleration = 0.15) {
  const int num = std::min(static_cast<int>(cable.core.size()), kFramesOfBeginning);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_x = Eigen::Vector3d::Zero(), right_y = Eigen::Vector3d::Zero();
  for (int k = 0; k < num; ++k) {
    const Eigen::Vector3d row(1, drag.way(k), 0.5 * k * k);
    const double weight = k < kDoubtfulFrames && num >= 2 * kDoubtfulFrames ? kDoubt : 1;
    normal += weight * row * row.transpose();
    right_x += weight * row * (cable.core[static_cast<std::size_t>(k)].x - drag.pulled(0, k));
    right_y += weight * row * (cable.core[static_cast<std::size_t>(k)].y - drag.pulled(1, k));
  }
  normal(2, 2) += kPlaceDeviation * kPlaceDeviation / (acceleration * acceleration);
  const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
  const Eigen::Vector3d x = factor.solve(right_x), y = factor.solve(right_y);
  Beginning out;
  out.cable = idx;
  out.frame = static_cast<double>(cable.first_frame);
  out.drag = drag;
  out.path = {{{x[0], x[1], x[2]}, {y[0], y[1], y[2]}}};
  out.covariance = factor.solve(Eigen::Matrix3d::Identity());
  return out;
}

struct Vote {
  int frame = 0, x = 0, y = 0;
  bool operator<(const Vote& other) const { return std::tie(y, x, frame) < std::tie(other.y, other.x, other.frame); }
  bool operator==(const Vote& other) const = default;
};

struct Peak {
  Vote cell;
  int count = 0;
};

/// Where and when paths carried back meet, most first: cells of 3 × 3 votes that hold many more than the same cells do
/// at other times.
std::vector<Peak> peaks_of(const std::vector<Beginning>& beginnings, const FindBurstsOptions& options) {
  std::vector<Vote> votes;
  double first = 1e300, last = -1e300;
  for (const Beginning& one : beginnings) {
    first = std::min(first, one.frame - options.max_delay);
    last = std::max(last, one.frame);
    for (int back = 0; back <= static_cast<int>(options.max_delay); ++back) {
      const double t = one.frame - back;
      const double x = std::floor(one.at(0, t) / kCell), y = std::floor(one.at(1, t) / kCell);
      if (!(std::abs(x) < 1e6 && std::abs(y) < 1e6)) break;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          votes.push_back({static_cast<int>(t), static_cast<int>(x) + i, static_cast<int>(y) + j});
    }
  }
  std::sort(votes.begin(), votes.end());
  std::vector<Peak> counts;
  for (const Vote& vote : votes) {
    if (counts.empty() || !(counts.back().cell == vote)) counts.push_back({vote, 0});
    ++counts.back().count;
  }
  std::vector<Peak> peaks;
  for (std::size_t i = 0; i < counts.size();) {  // one place
    std::size_t end = i;
    while (end < counts.size() && counts[end].cell.x == counts[i].cell.x && counts[end].cell.y == counts[i].cell.y)
      ++end;
    for (std::size_t k = i; k < end; ++k) {
      if (counts[k].count < options.min_cables) continue;
      double others = 0;
      for (std::size_t j = i; j < end; ++j)
        if (std::abs(counts[j].cell.frame - counts[k].cell.frame) > options.max_delay) others += counts[j].count;
      const double chance = others / std::max(1.0, last - first - 2 * options.max_delay);
      if (counts[k].count > chance + 5 * std::sqrt(chance)) peaks.push_back(counts[k]);
    }
    i = end;
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return a.count > b.count; });
  return peaks;
}

/// One step of robust least squares: p_i(τ) + δ v_i(τ) = o.
bool step_towards_origin(const std::vector<Beginning>& beginnings, double reach, Burst& burst) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  normal(2, 2) = 1e-3;
  for (const Beginning& one : beginnings) {
    const double variance = one.variance(burst.frame);
    const double dx = one.at(0, burst.frame) - burst.x, dy = one.at(1, burst.frame) - burst.y;
    const double square = (dx * dx + dy * dy) / (variance * reach * reach);
    const double weight = (square < 9 ? (1 - square / 9) * (1 - square / 9) : 0) / variance;  // Tukey's biweight
    if (weight <= 0) continue;
    for (const auto& [residual, row] : {std::pair(dx, Eigen::Vector3d(1, 0, -one.velocity(0, burst.frame))),
                                        std::pair(dy, Eigen::Vector3d(0, 1, -one.velocity(1, burst.frame)))}) {
      normal += weight * row * row.transpose();
      right += weight * residual * row;
    }
  }
  if (normal(0, 0) <= 0) return false;
  const Eigen::Vector3d step = Eigen::LDLT<Eigen::Matrix3d>(normal).solve(right);
  burst.x += step[0];
  burst.y += step[1];
  burst.frame += std::clamp(step[2], -1.0, 1.0);
  return std::isfinite(burst.x) && std::isfinite(burst.y) && std::isfinite(burst.frame);
}

bool goes_through(const Beginning& one, const Burst& burst, double max_delay) {
  const double delay = one.frame - burst.frame;
  if (delay < -1.5 || delay > max_delay) return false;
  const double dx = one.at(0, burst.frame) - burst.x, dy = one.at(1, burst.frame) - burst.y;
  return dx * dx + dy * dy < kGate * kGate * (1 + one.variance(burst.frame));
}

bool comes_from_many_sides(const std::vector<Beginning>& members, double frame) {
  double x = 0, y = 0, count = 0;
  for (const Beginning& one : members) {
    const double vx = one.velocity(0, frame), vy = one.velocity(1, frame), speed = std::hypot(vx, vy);
    if (speed < 1e-6) continue;
    x += vx / speed;
    y += vy / speed;
    count += 1;
  }
  return count > 0 && std::hypot(x, y) < kOneSided * count;
}

/// Square pixels in which cables begin.
double area_of(const std::vector<Beginning>& beginnings) {
  std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Beginning& one : beginnings)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], one.at(axis, one.frame));
      high[axis] = std::max(high[axis], one.at(axis, one.frame));
    }
  return std::max(1.0, (high[0] - low[0]) * (high[1] - low[1]));
}

/// How many would go through if they began anywhere: of crowds of short paths, whose way back is vague, many do.
double through_by_chance(const std::vector<Beginning>& beginnings, const Burst& burst, double max_delay, double area) {
  double sum = 0;
  for (const Beginning& one : beginnings) {
    const double delay = one.frame - burst.frame;
    if (delay < -1.5 || delay > max_delay) continue;
    sum += std::min(1.0, std::numbers::pi * kGate * kGate * (1 + one.variance(burst.frame)) / area);
  }
  return sum;
}

/// The burst near a peak, with its members taken out of `left`; no members: there is none. area: where cables begin.
Burst burst_at(const Peak& peak, double area, std::vector<Beginning>& left, const FindBurstsOptions& options) {
  Burst burst;
  burst.x = (peak.cell.x + 0.5) * kCell;
  burst.y = (peak.cell.y + 0.5) * kCell;
  burst.frame = peak.cell.frame;
  std::vector<Beginning> nearby;
  for (const Beginning& one : left)
    if (std::abs(one.frame - burst.frame) <= 2 * options.max_delay) nearby.push_back(one);
  for (int round = 0; round < kRounds; ++round)
    if (!step_towards_origin(nearby, std::max(1.0, 4.0 - round * 0.5), burst)) return {};
  std::vector<Beginning> members, others;
  for (const Beginning& one : left) (goes_through(one, burst, options.max_delay) ? members : others).push_back(one);
  if (static_cast<int>(members.size()) < options.min_cables || !comes_from_many_sides(members, burst.frame)) return {};
  const double chance = through_by_chance(others, burst, options.max_delay, area);
  if (static_cast<double>(members.size()) < chance + 5 * std::sqrt(chance)) return {};
  for (const Beginning& one : members) burst.cables.push_back(one.cable);
  left = std::move(others);
  return burst;
}

/// The burst that this one is a part of: its stragglers, whose paths bend more.
Burst* whole_of(const Burst& part, std::vector<Burst>& bursts, double max_delay) {
  for (Burst& burst : bursts)
    if (std::abs(burst.frame - part.frame) <= max_delay &&
        std::hypot(burst.x - part.x, burst.y - part.y) < kStragglersWithin)
      return &burst;
  return nullptr;
}

/// Once members are known they tell drag and gravity, which carry paths back better than parabolas do.
void refine(std::span<const Cable> cables, std::vector<Burst>& bursts) {
  std::vector<Cable> members;  // without their doubtful places
  for (const Burst& burst : bursts) {
    for (const int idx : burst.cables) {
      const Cable& cable = cables[static_cast<std::size_t>(idx)];
      if (cable.core.size() < 2 * kDoubtfulFrames) continue;
      members.emplace_back().core.assign(cable.core.begin() + kDoubtfulFrames, cable.core.end());
    }
  }
  if (members.size() < 8) return;
  FitDynamicsOptions measured;
  measured.estimate_errors = true;
  const MovetonDynamics dynamics = fit_dynamics(members, measured);
  const double persistence = (dynamics.x.persistence() + dynamics.y.persistence()) / 2;
  if (persistence < kLeastPersistence || persistence >= 1) return;
  const Drag drag{persistence, {dynamics.x.c, dynamics.y.c}};
  for (Burst& burst : bursts) {
    std::vector<Beginning> own;
    for (const int idx : burst.cables)
      own.push_back(beginning_of(cables[static_cast<std::size_t>(idx)], idx, drag, 0.02));
    Burst better = burst;
    bool solved = true;
    for (int round = 0; round < kRounds && solved; ++round) solved = step_towards_origin(own, 4.0, better);
    if (!solved || std::abs(better.frame - burst.frame) > 4 || std::hypot(better.x - burst.x, better.y - burst.y) > 12)
      continue;
    burst.x = better.x;
    burst.y = better.y;
    burst.frame = better.frame;
  }
}

}  // namespace

std::vector<Burst> find_bursts(std::span<const Cable> cables, const FindBurstsOptions& options) {
  check_options(options);
  std::vector<Beginning> left;
  for (std::size_t i = 0; i < cables.size(); ++i)
    if (cables[i].first_frame > 0 && cables[i].core.size() >= 2)
      left.push_back(beginning_of(cables[i], static_cast<int>(i)));
  const double area = area_of(left);
  std::vector<Burst> bursts;
  for (bool found = true; found && static_cast<int>(left.size()) >= options.min_cables;) {
    found = false;
    int attempts = 0;
    for (const Peak& peak : peaks_of(left, options)) {
      if (++attempts > 20) break;
      Burst burst = burst_at(peak, area, left, options);
      if (burst.cables.empty()) continue;
      if (Burst* whole = whole_of(burst, bursts, options.max_delay); whole != nullptr)
        whole->cables.insert(whole->cables.end(), burst.cables.begin(), burst.cables.end());
      else
        bursts.push_back(std::move(burst));
      found = true;
      break;
    }
  }
  refine(cables, bursts);
  for (Burst& burst : bursts) std::sort(burst.cables.begin(), burst.cables.end());
  std::stable_sort(bursts.begin(), bursts.end(), [](const Burst& a, const Burst& b) { return a.frame < b.frame; });
  return bursts;
}

namespace {

Spread spread_of(const std::vector<double>& values) {
  Spread out;
  if (values.empty()) return out;
  for (const double value : values) out.mean += value;
  out.mean /= static_cast<double>(values.size());
  for (const double value : values) out.deviation += (value - out.mean) * (value - out.mean);
  out.deviation = values.size() > 1 ? std::sqrt(out.deviation / static_cast<double>(values.size() - 1)) : 0;
  return out;
}

}  // namespace

BurstStatistics burst_statistics(std::span<const Burst> bursts, std::span<const Cable> cables,
                                 std::int64_t num_frames) {
  std::vector<double> counts, speeds, means, lives, delays, coverages;
  for (const Burst& burst : bursts) {
    std::array<bool, kSectors> filled{};
    std::vector<double> own;
    for (const int idx : burst.cables) {
      const Cable& cable = cables[static_cast<std::size_t>(idx)];
      const Beginning beginning = beginning_of(cable, idx);
      const double vx = beginning.path[0][1], vy = beginning.path[1][1];
      own.push_back(std::hypot(vx, vy));
      delays.push_back(beginning.frame - burst.frame);
      if (cable.end_frame() < num_frames) lives.push_back(static_cast<double>(cable.num_frames()));
      const double turn = std::atan2(vy, vx) / (2 * std::numbers::pi) + 0.5;
      filled[static_cast<std::size_t>(std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1))] = true;
    }
    counts.push_back(static_cast<double>(burst.cables.size()));
    speeds.insert(speeds.end(), own.begin(), own.end());
    means.push_back(spread_of(own).mean);
    coverages.push_back(static_cast<double>(std::count(filled.begin(), filled.end(), true)) / kSectors);
  }
  BurstStatistics out;
  out.num_cables = spread_of(counts);
  out.speed = spread_of(speeds);
  out.speed_between = spread_of(means).deviation;
  out.life = spread_of(lives);
  out.delay = spread_of(delays);
  out.angle_coverage = spread_of(coverages).mean;
  return out;
}

}  // namespace motex
