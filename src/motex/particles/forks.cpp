// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/forks.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kReach = 3;         // scales within which the two begin
constexpr double kLeastShare = 0.2;  // of the light of the one, in each of the two
constexpr double kMostLeft = 0.5;    // of its energy
constexpr double kBetterByTwo = 0.75;
constexpr std::array<int, 4> kChanceShifts{7, -7, 11, -11};  // frames: light is another by then

/// Ends of cables seen in one direction of time: what goes out of one frame and what comes in in the next.
class Ends {
 public:
  Ends(const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height, bool forwards)
      : cables_(cables), num_frames_(num_frames), width_(width), height_(height), forwards_(forwards) {
    coming_.resize(static_cast<std::size_t>(num_frames));
    for (std::size_t k = 0; k < cables.size(); ++k)
      if (const std::int64_t t = coming_frame(cables[k]); t >= 0 && t < num_frames && cables[k].num_frames() > 1)
        coming_[static_cast<std::size_t>(t)].push_back(static_cast<int>(k));
  }

  /// Frame in which the cable is first seen in this direction.
  std::int64_t coming_frame(const Cable& cable) const { return forwards_ ? cable.first_frame : cable.end_frame() - 1; }
  std::int64_t next(std::int64_t frame) const { return forwards_ ? frame + 1 : frame - 1; }

  /// Whether the cable has a velocity in that frame and there is a next one.
  bool can_fork(const Cable& cable, std::int64_t frame) const {
    const std::int64_t to = next(frame);
    return cable.covers(forwards_ ? frame - 1 : frame + 1) && to >= 0 && to < num_frames_;
  }

  /// The pair that goes on with the light of cable `one`, with newcomers of `shift` frames later; false: none.
  bool find(int one, std::int64_t frame, int shift, Fork& fork) const {
    const Cable& cable = cables_[static_cast<std::size_t>(one)];
    const std::int64_t from = next(frame) + shift;
    if (from < 0 || from >= num_frames_) return false;
    const Base base = moved_on(cable, frame);
    const auto alpha = static_cast<double>(base.coefficients[0]);
    if (alpha == 0) return false;
    const std::vector<int> newcomers = near(base, from);
    if (newcomers.empty()) return false;
    const BasePatch patch = render_patch(base, width_, height_);
    if (patch.values.empty()) return false;
    const std::vector<Heir> heirs = heirs_of(one, patch, alpha, next(frame), newcomers);
    double least = 1e300, least_alone = 1;
    for (const Heir& heir : heirs) least_alone = std::min(least_alone, 1 - 2 * heir.share + heir.energy);
    for (std::size_t a = 0; a < heirs.size(); ++a)
      for (std::size_t b = a + 1; b < heirs.size(); ++b) {
        const double both = heirs[a].coefficient * heirs[b].coefficient * inner_product(heirs[a].patch, heirs[b].patch);
        const double left = 1 - 2 * (heirs[a].share + heirs[b].share) + heirs[a].energy + heirs[b].energy + 2 * both;
        if (left >= least) continue;
        least = left;
        fork = {frame, one, {heirs[a].cable, heirs[b].cable}, left, base.x, base.y};
      }
    return least <= kMostLeft && least <= kBetterByTwo * least_alone;
  }

 private:
  struct Heir {
    int cable;
    BasePatch patch;
    double coefficient, share, energy;  ///< all relative to α
  };

  Base moved_on(const Cable& cable, std::int64_t frame) const {
    Base base = cable.at(frame);
    const Base& before = cable.at(forwards_ ? frame - 1 : frame + 1);
    base.x += base.x - before.x;
    base.y += base.y - before.y;
    return base;
  }

  std::vector<int> near(const Base& base, std::int64_t frame) const {
    std::vector<int> out;
    for (const int k : coming_[static_cast<std::size_t>(frame)]) {
      const Cable& other = cables_[static_cast<std::size_t>(k)];
      const Base& first = forwards_ ? other.core.front() : other.core.back();
      const double reach = kReach * (base.scale + first.scale) / 2;
      if (std::abs(first.x - base.x) <= reach && std::abs(first.y - base.y) <= reach) out.push_back(k);
    }
    return out;
  }

  std::vector<Heir> heirs_of(int one, const BasePatch& patch, double alpha, std::int64_t frame,
                             const std::vector<int>& newcomers) const {
    std::vector<Heir> heirs;
    const auto add = [&](int k, const Base& base) {
      Heir heir{k, render_patch(base, width_, height_), static_cast<double>(base.coefficients[0]) / alpha, 0, 0};
      heir.share = heir.coefficient * inner_product(patch, heir.patch);
      heir.energy = heir.coefficient * heir.coefficient * inner_product(heir.patch, heir.patch);
      if (heir.share >= kLeastShare) heirs.push_back(std::move(heir));
    };
    if (const Cable& self = cables_[static_cast<std::size_t>(one)]; self.covers(frame)) add(one, self.at(frame));
    for (const int k : newcomers) {
      const Cable& other = cables_[static_cast<std::size_t>(k)];
      add(k, forwards_ ? other.core.front() : other.core.back());
    }
    return heirs;
  }

  const std::vector<Cable>& cables_;
  std::int64_t num_frames_;
  int width_, height_;
  bool forwards_;
  std::vector<std::vector<int>> coming_;
};

void search(const Ends& ends, const std::vector<Cable>& cables, std::vector<Fork>& found, double& num_steps,
            double& by_chance) {
  for (std::size_t k = 0; k < cables.size(); ++k)
    for (std::int64_t t = cables[k].first_frame; t < cables[k].end_frame(); ++t) {
      if (!ends.can_fork(cables[k], t)) continue;
      num_steps += 1;
      Fork fork;
      if (ends.find(static_cast<int>(k), t, 0, fork)) found.push_back(fork);
      for (const int shift : kChanceShifts)
        if (ends.find(static_cast<int>(k), t, shift, fork))
          by_chance += 1.0 / static_cast<double>(kChanceShifts.size());
    }
}

}  // namespace

ForksReport find_forks(const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height) {
  ForksReport report;
  search(Ends(cables, num_frames, width, height, true), cables, report.forks, report.num_steps, report.forks_by_chance);
  double backwards = 0;
  search(Ends(cables, num_frames, width, height, false), cables, report.merges, backwards, report.merges_by_chance);
  return report;
}

}  // namespace motex
