// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/false_ends.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/particles/parzen.h"

namespace motex {
namespace {

constexpr int kLongestGap = 5;       // frames
constexpr double kImprobable = 0.2;  // expected ends nearby by chance
constexpr double kLargestAmplitudeRatio = 2.5;
constexpr int kFlash = 2;  // frames
constexpr double kBesideScales = 1.5;

/// How many births (or deaths) there are about a place in a frame, the one that asks left out.
class Rarity {
 public:
  Rarity(const std::vector<CableEnd>& ends, int width, int height, std::int64_t num_frames)
      : num_frames_(static_cast<double>(num_frames)) {
    PointCounts counts(width, height);
    for (const CableEnd& end : ends) counts.add(end.x, end.y);
    const double bandwidth = std::max(2.0, choose_bandwidth({&counts}));
    density_ = parzen_smooth(counts.counts(), bandwidth);
    own_ = 1 / (2 * std::numbers::pi * bandwidth * bandwidth);
  }
  /// Expected within so many pixels and frames.
  double expected(double x, double y, double radius, double frames) const {
    const auto pixel = [](double place, int size) {
      return static_cast<int>(std::clamp(std::floor(place + 0.5), 0.0, static_cast<double>(size - 1)));
    };
    const double here = static_cast<double>(density_.at(pixel(x, density_.width), pixel(y, density_.height)));
    return std::max(0.0, here - own_) / num_frames_ * std::numbers::pi * radius * radius * frames;
  }
  bool is_rare(const CableEnd& end) const { return expected(end.x, end.y, 5, kLongestGap) < kImprobable; }

 private:
  Plane density_;
  double num_frames_, own_ = 0;
};

struct Meeting {
  double distance = 0;
  std::size_t death = 0, birth = 0;
};

class FalseEnds {
 public:
  FalseEnds(std::span<const Cable> cables, std::int64_t num_frames, BirthDeathMaps& maps)
      : cables_(cables),
        num_frames_(num_frames),
        maps_(maps),
        births_(maps.births, maps.width, maps.height, num_frames),
        deaths_(maps.deaths, maps.width, maps.height, num_frames),
        false_births_(maps.births.size()),
        false_deaths_(maps.deaths.size()) {}

  void find() {
    mark_gaps();
    mark_flashes(maps_.births, births_, false_births_);
    mark_flashes(maps_.deaths, deaths_, false_deaths_);
    list_present();
    mark_crowds(maps_.births, births_, false_births_);
    mark_crowds(maps_.deaths, deaths_, false_deaths_);
  }

  void drop() const {
    const auto keep = [](std::vector<CableEnd>& ends, const std::vector<char>& is_false) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < ends.size(); ++i)
        if (is_false[i] == 0) ends[kept++] = ends[i];
      ends.resize(kept);
    };
    keep(maps_.births, false_births_);
    keep(maps_.deaths, false_deaths_);
  }

 private:
  const Cable& cable_of(const CableEnd& end) const { return cables_[static_cast<std::size_t>(end.cable)]; }

  /// Nearest meetings first, each end once; as many as are more than chance makes.
  void mark_gaps() {
    double by_chance = 0;
    std::vector<Meeting> found = meetings(by_chance);
    std::stable_sort(found.begin(), found.end(),
                     [](const Meeting& a, const Meeting& b) { return a.distance < b.distance; });
    std::vector<char> death_taken(maps_.deaths.size()), birth_taken(maps_.births.size());
    std::vector<Meeting> pairs;
    for (const Meeting& meeting : found) {
      if (death_taken[meeting.death] != 0 || birth_taken[meeting.birth] != 0) continue;
      death_taken[meeting.death] = birth_taken[meeting.birth] = 1;
      pairs.push_back(meeting);
    }
    const double excess = static_cast<double>(pairs.size()) - by_chance;
    for (std::size_t k = 0; k < pairs.size() && static_cast<double>(k) + 0.5 < excess; ++k)
      false_deaths_[pairs[k].death] = false_births_[pairs[k].birth] = 1;
  }

  /// by_chance: how many there would be if deaths and births knew nothing of one another.
  std::vector<Meeting> meetings(double& by_chance) const {
    std::vector<std::vector<std::size_t>> births_in(static_cast<std::size_t>(num_frames_));
    for (std::size_t b = 0; b < maps_.births.size(); ++b)
      births_in[static_cast<std::size_t>(maps_.births[b].frame)].push_back(b);
    std::vector<Meeting> found;
    for (std::size_t d = 0; d < maps_.deaths.size(); ++d) {
      const CableEnd& death = maps_.deaths[d];
      const double amplitude = peak_amplitude(cable_of(death).core.back());
      for (std::int64_t gap = 1; gap <= kLongestGap && death.frame + gap < num_frames_; ++gap) {
        const auto frames = static_cast<double>(gap);
        const double x = death.x + death.vx * frames, y = death.y + death.vy * frames, radius = 2 + frames;
        if (!is_inside(x, y, maps_.width, maps_.height)) break;
        if (births_.expected(x, y, radius, kLongestGap) > kImprobable) continue;
        by_chance += births_.expected(x, y, radius, 1);
        for (const std::size_t b : births_in[static_cast<std::size_t>(death.frame + gap)]) {
          const CableEnd& birth = maps_.births[b];
          const double distance = std::hypot(birth.x - x, birth.y - y);
          const double ratio = amplitude != 0 ? peak_amplitude(cable_of(birth).core.front()) / amplitude : 0;
          if (distance < radius && birth.cable != death.cable && ratio < kLargestAmplitudeRatio &&
              ratio > 1 / kLargestAmplitudeRatio)
            found.push_back({distance / radius, d, b});
        }
      }
    }
    return found;
  }

  void mark_flashes(const std::vector<CableEnd>& ends, const Rarity& rarity, std::vector<char>& is_false) const {
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const Cable& cable = cable_of(ends[i]);
      if (cable.num_frames() <= kFlash && cable.first_frame > 0 && cable.end_frame() < num_frames_ &&
          rarity.is_rare(ends[i]))
        is_false[i] = 1;
    }
  }

  void list_present() {
    present_.resize(static_cast<std::size_t>(num_frames_));
    for (std::size_t i = 0; i < cables_.size(); ++i)
      for (std::int64_t t = std::max<std::int64_t>(0, cables_[i].first_frame);
           t < std::min(cables_[i].end_frame(), num_frames_); ++t)
        present_[static_cast<std::size_t>(t)].push_back(static_cast<std::int32_t>(i));
  }

  /// Distance to the nearest other element, over the distance at which two cover one another.
  double crowding(const CableEnd& end) const {
    const double scale =
        end.frame == cable_of(end).first_frame ? cable_of(end).core.front().scale : cable_of(end).core.back().scale;
    double nearest = 1e300;
    for (const std::int32_t other : present_[static_cast<std::size_t>(end.frame)]) {
      if (other == end.cable) continue;
      const Base& base = cables_[static_cast<std::size_t>(other)].at(end.frame);
      const double reach = kBesideScales * (scale + base.scale) + 1;
      nearest = std::min(nearest, std::hypot(base.x - end.x, base.y - end.y) / reach);
    }
    return nearest;
  }

  void mark_crowds(const std::vector<CableEnd>& ends, const Rarity& rarity, std::vector<char>& is_false) const {
    std::vector<std::pair<double, std::size_t>> beside;
    double num_rare = 0, num_by_chance = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (is_false[i] != 0 || !is_inside(ends[i].x, ends[i].y, maps_.width, maps_.height) || !rarity.is_rare(ends[i]))
        continue;
      const auto there = static_cast<double>(present_[static_cast<std::size_t>(ends[i].frame)].size());
      const double reach = 2 * kBesideScales * cable_of(ends[i]).core.front().scale + 1;
      num_rare += 1;
      num_by_chance += 1 - std::exp(-there * std::numbers::pi * reach * reach / (1.0 * maps_.width * maps_.height));
      const double crowd = crowding(ends[i]);
      if (crowd < 1) beside.emplace_back(crowd, i);
    }
    if (num_rare == 0) return;
    // of the true ends a share of `chance` lies beside others: true = others / (1 − chance)
    const double chance = std::min(num_by_chance / num_rare, 0.9);
    const double num_alone = num_rare - static_cast<double>(beside.size());
    const double num_true_beside = num_alone * chance / (1 - chance);
    std::stable_sort(beside.begin(), beside.end());
    const double excess = static_cast<double>(beside.size()) - num_true_beside;
    for (std::size_t k = 0; k < beside.size() && static_cast<double>(k) + 0.5 < excess; ++k)
      is_false[beside[k].second] = 1;
  }

  std::span<const Cable> cables_;
  std::int64_t num_frames_;
  BirthDeathMaps& maps_;
  Rarity births_, deaths_;
  std::vector<char> false_births_, false_deaths_;
  std::vector<std::vector<std::int32_t>> present_;
};

}  // namespace

void drop_false_ends(std::span<const Cable> cables, std::int64_t num_frames, BirthDeathMaps& maps) {
  if (maps.births.empty() && maps.deaths.empty()) return;
  FalseEnds ends(cables, num_frames, maps);
  ends.find();
  ends.drop();
}

}  // namespace motex
