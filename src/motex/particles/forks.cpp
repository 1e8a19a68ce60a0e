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

double dot(const BasePatch& a, const BasePatch& b) {
  const int left = std::max(a.left, b.left), right = std::min(a.left + a.width, b.left + b.width);
  const int top = std::max(a.top, b.top), bottom = std::min(a.top + a.height, b.top + b.height);
  double sum = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      sum += static_cast<double>(a.row(y - a.top)[x - a.left]) * static_cast<double>(b.row(y - b.top)[x - b.left]);
  return sum;
}

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
  std::int64_t leaving_frame(const Cable& cable) const { return forwards_ ? cable.end_frame() - 1 : cable.first_frame; }
  std::int64_t next(std::int64_t frame) const { return forwards_ ? frame + 1 : frame - 1; }

  bool can_fork(const Cable& cable) const {
    const std::int64_t frame = next(leaving_frame(cable));
    return cable.num_frames() > 1 && frame >= 0 && frame < num_frames_;
  }

  /// The pair among the cables coming in `shift` frames from where the cable would go on; false when there is none.
  bool find(int one, int shift, Fork& fork) const {
    const Cable& cable = cables_[static_cast<std::size_t>(one)];
    const std::int64_t frame = next(leaving_frame(cable)) + shift;
    if (frame < 0 || frame >= num_frames_) return false;
    const Base base = moved_on(cable);
    const BasePatch patch = render_patch(base, width_, height_);
    const double alpha = static_cast<double>(base.coefficients[0]);
    if (patch.values.empty() || alpha == 0) return false;
    const std::vector<Heir> heirs = heirs_of(base, patch, alpha, frame);
    double least = 1e300, least_alone = 1;
    for (const Heir& heir : heirs) least_alone = std::min(least_alone, 1 - 2 * heir.share + heir.energy);
    for (std::size_t a = 0; a < heirs.size(); ++a)
      for (std::size_t b = a + 1; b < heirs.size(); ++b) {
        const double both = heirs[a].coefficient * heirs[b].coefficient * dot(heirs[a].patch, heirs[b].patch);
        const double left = 1 - 2 * (heirs[a].share + heirs[b].share) + heirs[a].energy + heirs[b].energy + 2 * both;
        if (left >= least) continue;
        least = left;
        fork = {leaving_frame(cable), one, {heirs[a].cable, heirs[b].cable}, left, base.x, base.y};
      }
    return least <= kMostLeft && least <= kBetterByTwo * least_alone;
  }

 private:
  struct Heir {
    int cable;
    BasePatch patch;
    double coefficient, share, energy;  ///< all relative to α
  };

  const Base& last_of(const Cable& cable, std::size_t back) const {
    return forwards_ ? cable.core[cable.core.size() - 1 - back] : cable.core[back];
  }

  Base moved_on(const Cable& cable) const {
    Base base = last_of(cable, 0);
    const Base& before = last_of(cable, 1);
    base.x += base.x - before.x;
    base.y += base.y - before.y;
    return base;
  }

  std::vector<Heir> heirs_of(const Base& base, const BasePatch& patch, double alpha, std::int64_t frame) const {
    std::vector<Heir> heirs;
    for (const int k : coming_[static_cast<std::size_t>(frame)]) {
      const Cable& other = cables_[static_cast<std::size_t>(k)];
      const Base& first = forwards_ ? other.core.front() : other.core.back();
      if (std::hypot(first.x - base.x, first.y - base.y) > kReach * (base.scale + first.scale) / 2) continue;
      Heir heir{k, render_patch(first, width_, height_), static_cast<double>(first.coefficients[0]) / alpha, 0, 0};
      heir.share = heir.coefficient * dot(patch, heir.patch);
      heir.energy = heir.coefficient * heir.coefficient * dot(heir.patch, heir.patch);
      if (heir.share >= kLeastShare) heirs.push_back(std::move(heir));
    }
    return heirs;
  }

  const std::vector<Cable>& cables_;
  std::int64_t num_frames_;
  int width_, height_;
  bool forwards_;
  std::vector<std::vector<int>> coming_;
};

void search(const Ends& ends, const std::vector<Cable>& cables, std::vector<Fork>& found, double& candidates,
            double& by_chance) {
  for (std::size_t k = 0; k < cables.size(); ++k) {
    if (!ends.can_fork(cables[k])) continue;
    candidates += 1;
    Fork fork;
    if (ends.find(static_cast<int>(k), 0, fork)) found.push_back(fork);
    for (const int shift : kChanceShifts)
      if (ends.find(static_cast<int>(k), shift, fork)) by_chance += 1.0 / static_cast<double>(kChanceShifts.size());
  }
}

}  // namespace

ForksReport find_forks(const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height) {
  ForksReport report;
  search(Ends(cables, num_frames, width, height, true), cables, report.forks, report.num_ends, report.forks_by_chance);
  search(Ends(cables, num_frames, width, height, false), cables, report.merges, report.num_begins,
         report.merges_by_chance);
  return report;
}

}  // namespace motex
