// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/template_coils.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/particles/coil_search.h"

namespace motex {
namespace {

constexpr std::size_t kMostMovetons = 500;
constexpr int kMostCandidates = 250;
constexpr double kReach = 1.5;  // distance of bases that are the same coil

struct Member {
  std::size_t moveton = 0;
  RelativeBase base;
  double luma = 0;
};

/// Half turns of an oriented base that bring it nearest to another angle; Gsin changes its sign with each.
void turn_towards(Member& member, double angle) {
  if (!is_oriented(member.base.kind)) return;
  const double halves = std::round((angle - member.base.angle) / std::numbers::pi);
  member.base.angle += halves * std::numbers::pi;
  if (member.base.kind != BaseKind::kGaborSin || std::fmod(std::abs(halves), 2) != 1) return;
  for (double& coefficient : member.base.coefficient) coefficient = -coefficient;
  member.luma = -member.luma;
}

/// How unlike two coil bases are; below kReach they may be the same coil. Both in the same half turn.
double unlikeness(const Member& a, const Member& b) {
  if (a.base.kind != b.base.kind || (a.luma > 0) != (b.luma > 0)) return 1e9;
  const double scale = std::exp(0.5 * (a.base.log_scale + b.base.log_scale));
  const double du = (a.base.u - b.base.u) / (0.9 * scale), dv = (a.base.v - b.base.v) / (0.9 * scale);
  const double ds = (a.base.log_scale - b.base.log_scale) / 0.5, dt = (a.base.angle - b.base.angle) / 0.5;
  const double dc = std::log(std::abs(a.luma / b.luma)) / 1.2;
  return std::sqrt(du * du + dv * dv + ds * ds + dt * dt + dc * dc);
}

/// The nearest base of each moveton to `centre`, within reach. Indices into members.
std::vector<std::size_t> like(const std::vector<Member>& members, const Member& centre, std::size_t num_movetons) {
  std::vector<double> nearest(num_movetons, kReach);
  std::vector<std::size_t> which(num_movetons, members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    Member turned = members[i];
    turn_towards(turned, centre.base.angle);
    const double distance = unlikeness(turned, centre);
    if (distance >= nearest[members[i].moveton]) continue;
    nearest[members[i].moveton] = distance;
    which[members[i].moveton] = i;
  }
  std::erase(which, members.size());
  return which;
}

Member middle_of(const std::vector<Member>& members, const std::vector<std::size_t>& chosen, const Member& centre,
                 int num_planes) {
  Member mean{0, {}, 0};
  mean.base.kind = centre.base.kind;
  for (const std::size_t i : chosen) {
    Member turned = members[i];
    turn_towards(turned, centre.base.angle);
    mean.base.u += turned.base.u;
    mean.base.v += turned.base.v;
    mean.base.log_scale += turned.base.log_scale;
    mean.base.angle += turned.base.angle;
    for (std::size_t k = 0; k < 3; ++k) mean.base.coefficient[k] += turned.base.coefficient[k];
  }
  const auto num = static_cast<double>(chosen.size());
  mean.base.u /= num;
  mean.base.v /= num;
  mean.base.log_scale /= num;
  mean.base.angle /= num;
  for (double& coefficient : mean.base.coefficient) coefficient /= num;
  mean.luma = luma_coefficient(mean.base, num_planes);
  return mean;
}

TemplateCoil coil_of(const std::vector<Member>& members, const std::vector<std::size_t>& chosen, const Member& centre,
                     std::size_t num_movetons) {
  TemplateCoil coil;
  coil.kind = centre.base.kind;
  coil.presence = static_cast<double>(chosen.size()) / static_cast<double>(num_movetons);
  std::vector<double> u, v, log_scale, angle;
  std::array<std::vector<double>, 3> coefficient;
  for (const std::size_t i : chosen) {
    Member turned = members[i];
    turn_towards(turned, centre.base.angle);
    u.push_back(turned.base.u);
    v.push_back(turned.base.v);
    log_scale.push_back(turned.base.log_scale);
    angle.push_back(turned.base.angle);
    for (std::size_t k = 0; k < 3; ++k) coefficient[k].push_back(turned.base.coefficient[k]);
  }
  coil.u = spread_of(u);
  coil.v = spread_of(v);
  coil.log_scale = spread_of(log_scale);
  coil.angle = spread_of(angle);
  for (std::size_t k = 0; k < 3; ++k) coil.coefficient[k] = spread_of(coefficient[k]);
  return coil;
}

}  // namespace

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  double sum = 0, square = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) square += (value - mean) * (value - mean);
  return {mean, std::sqrt(square / static_cast<double>(values.size()))};
}

std::vector<TemplateCoil> common_coils(const std::vector<std::vector<RelativeBase>>& movetons, int num_planes,
                                       double min_presence, int max_coils) {
  const std::size_t stride = std::max<std::size_t>(1, movetons.size() / kMostMovetons);
  std::vector<Member> members;
  std::size_t num_movetons = 0;
  for (std::size_t i = 0; i < movetons.size(); i += stride, ++num_movetons)
    for (const RelativeBase& base : movetons[i])
      if (const double luma = luma_coefficient(base, num_planes); std::abs(luma) > 0.02)
        members.push_back({num_movetons, base, luma});
  std::vector<TemplateCoil> coils;
  while (static_cast<int>(coils.size()) < max_coils && !members.empty()) {
    Member best;
    std::vector<std::size_t> chosen;
    const std::size_t step = std::max<std::size_t>(1, members.size() / kMostCandidates);
    for (std::size_t i = 0; i < members.size(); i += step) {
      std::vector<std::size_t> near = like(members, members[i], num_movetons);
      if (near.size() <= chosen.size()) continue;
      chosen = std::move(near);
      best = members[i];
    }
    for (int round = 0; round < 3 && !chosen.empty(); ++round) {
      const Member middle = middle_of(members, chosen, best, num_planes);
      std::vector<std::size_t> near = like(members, middle, num_movetons);
      if (near.size() < chosen.size()) break;
      chosen = std::move(near);
      best = middle;
    }
    if (static_cast<double>(chosen.size()) < std::max(2.0, min_presence * static_cast<double>(num_movetons))) break;
    coils.push_back(coil_of(members, chosen, best, num_movetons));
    std::sort(chosen.begin(), chosen.end());
    for (auto i = chosen.rbegin(); i != chosen.rend(); ++i)
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(*i));
  }
  const auto strength = [&](const TemplateCoil& coil) {
    double sum = 0;
    for (const Spread& spread : coil.coefficient) sum += std::abs(spread.mean);
    return sum * coil.presence;
  };
  std::stable_sort(coils.begin(), coils.end(),
                   [&](const TemplateCoil& a, const TemplateCoil& b) { return strength(a) > strength(b); });
  return coils;
}

}  // namespace motex
