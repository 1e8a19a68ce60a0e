// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/birth_death.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/particles/bursts.h"
#include "motex/particles/false_ends.h"
#include "motex/particles/parzen.h"

namespace motex {
namespace {

constexpr int kVelocitySteps = 3;

CableEnd end_of(const Cable& cable, std::int32_t idx, bool at_birth) {
  const auto last = static_cast<int>(cable.core.size()) - 1;
  const int steps = std::min(last, kVelocitySteps);
  const auto base = [&](int k) -> const Base& { return cable.core[static_cast<std::size_t>(k)]; };
  const Base& from = base(at_birth ? 0 : last - steps);
  const Base& to = base(at_birth ? steps : last);
  const Base& here = at_birth ? from : to;
  CableEnd end;
  end.x = here.x;
  end.y = here.y;
  if (steps > 0) {
    end.vx = (to.x - from.x) / steps;
    end.vy = (to.y - from.y) / steps;
  }
  end.frame = at_birth ? cable.first_frame : cable.end_frame() - 1;
  end.cable = idx;
  return end;
}

PointCounts counts_of(const std::vector<CableEnd>& ends, int width, int height) {
  PointCounts counts(width, height);
  for (const CableEnd& end : ends) counts.add(end.x, end.y);
  return counts;
}

Plane scaled(Plane plane, double factor) {
  for (float& value : plane.values) value = static_cast<float>(static_cast<double>(value) * factor);
  return plane;
}

void leave_bursts_out(BirthDeathMaps& maps, std::size_t num_cables) {
  std::vector<char> in_burst(num_cables);
  for (const Burst& burst : maps.bursts)
    for (const int cable : burst.cables) in_burst[static_cast<std::size_t>(cable)] = 1;
  std::erase_if(maps.births, [&](const CableEnd& end) { return in_burst[static_cast<std::size_t>(end.cable)] != 0; });
}

PointCounts occupied(std::span<const Cable> cables, const BirthDeathMaps& maps, std::int64_t num_frames) {
  PointCounts counts(maps.width, maps.height);
  for (const Cable& cable : cables) {
    for (std::int64_t t = std::max<std::int64_t>(cable.first_frame, 0); t < std::min(cable.end_frame(), num_frames);
         ++t)
      if (is_inside(cable.at(t).x, cable.at(t).y, maps.width, maps.height)) counts.add(cable.at(t).x, cable.at(t).y);
  }
  return counts;
}

/// (D + κ h′) / (O + κ) with both taken over the window's area and h′ from a window four times as wide.
Plane hazard_of(const PointCounts& deaths, const PointCounts& elements, double bandwidth, double prior_elements) {
  const int width = deaths.counts().width, height = deaths.counts().height;
  const double mean = elements.total() > 0 ? std::min(1.0, deaths.total() / elements.total()) : 0;
  Plane hazard(width, height, static_cast<float>(mean));
  if (mean == 0) return hazard;
  std::vector<double> widths{std::max(bandwidth, 0.5)};
  while (4 * widths.back() < std::max(width, height) / 4.0) widths.push_back(4 * widths.back());
  for (std::size_t level = widths.size(); level-- > 0;) {
    const double area = 4 * std::numbers::pi * widths[level] * widths[level];
    const Plane d = parzen_smooth(deaths.counts(), widths[level]), n = parzen_smooth(elements.counts(), widths[level]);
    for (std::size_t i = 0; i < hazard.values.size(); ++i) {
      const double wider = hazard.values[i], dead = area * static_cast<double>(d.values[i]);
      const double there = std::max(dead, area * static_cast<double>(n.values[i]));
      hazard.values[i] = static_cast<float>((dead + prior_elements * wider) / (there + prior_elements));
    }
  }
  return hazard;
}

}  // namespace

BirthDeathMaps estimate_maps(std::span<const Cable> cables, int width, int height, std::int64_t num_frames,
                             const MapOptions& options) {
  check_options(options);
  if (width < 1 || height < 1 || num_frames < 1)
    throw InvalidInput("birth and death maps need a picture of at least one pixel and one frame");
  BirthDeathMaps maps;
  maps.width = width;
  maps.height = height;
  for (std::size_t i = 0; i < cables.size(); ++i) {
    const Cable& cable = cables[i];
    if (cable.core.empty()) continue;
    const auto idx = static_cast<std::int32_t>(i);
    if (cable.first_frame > 0 && cable.first_frame < num_frames) maps.births.push_back(end_of(cable, idx, true));
    if (cable.end_frame() < num_frames && cable.end_frame() > 0) maps.deaths.push_back(end_of(cable, idx, false));
  }
  if (options.find_bursts) maps.bursts = find_bursts(cables);
  leave_bursts_out(maps, cables.size());
  if (options.bridge_gaps) drop_false_ends(cables, num_frames, maps);

  const auto later_frames = static_cast<double>(std::max<std::int64_t>(1, num_frames - 1));
  maps.births_per_frame = static_cast<double>(maps.births.size()) / later_frames;
  maps.bursts_per_frame = static_cast<double>(maps.bursts.size()) / later_frames;
  const PointCounts births = counts_of(maps.births, width, height), deaths = counts_of(maps.deaths, width, height);
  const PointCounts elements = occupied(cables, maps, num_frames);
  maps.bandwidth = options.bandwidth > 0 ? options.bandwidth : choose_bandwidth({&births, &deaths});
  maps.source = scaled(parzen_smooth(births.counts(), maps.bandwidth), births.total() > 0 ? 1 / births.total() : 0);
  maps.sink = scaled(parzen_smooth(deaths.counts(), maps.bandwidth), deaths.total() > 0 ? 1 / deaths.total() : 0);
  maps.occupancy = scaled(parzen_smooth(elements.counts(), maps.bandwidth), 1 / static_cast<double>(num_frames));
  maps.hazard = hazard_of(deaths, occupied(cables, maps, num_frames - 1), maps.bandwidth, options.prior_elements);
  return maps;
}

Plane vanishing_hazard(const BirthDeathMaps& maps, std::span<const Cable> cables, std::int64_t num_frames,
                       double prior_elements) {
  PointCounts vanished(maps.width, maps.height);
  for (const CableEnd& death : maps.deaths)
    if (is_inside(death.x + death.vx, death.y + death.vy, maps.width, maps.height)) vanished.add(death.x, death.y);
  return hazard_of(vanished, occupied(cables, maps, num_frames - 1), maps.bandwidth, prior_elements);
}

}  // namespace motex
