// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/coils.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/coil_search.h"
#include "motex/particles/moveton_light.h"

namespace motex {
namespace {

constexpr double kMostReach = 2.5;  // times the reach, where coils lead outwards
constexpr double kJump = 1.4;       // a new place must have so much more energy than the carried coil

class CoilGrower {
 public:
  CoilGrower(MovetonLight& light, std::vector<Cable>& cables, const GrowCoilsOptions& options, const JobContext& job)
      : light_(light), cables_(cables), options_(options), job_(job) {}

  /// Coils are added to those that the cables have.
  void run(double noise, std::vector<char> growing) {
    noise_ = noise;
    for (int round = 0; round < options_.max_coils; ++round) {
      job_.progress("coils", static_cast<double>(round) / options_.max_coils);
      if (!grow_one(growing)) break;
      light_.fit_luma();
    }
  }

 private:
  /// One more coil for each cable that still gains. Whether any did.
  bool grow_one(std::vector<char>& growing) {
    std::vector<std::vector<CoilFit>> found(cables_.size());
    parallel_for(job_.jobs, static_cast<int>(cables_.size()), [&](int c) {
      job_.check_cancelled();
      const auto idx = static_cast<std::size_t>(c);
      if (static_cast<int>(cables_[idx].coils.size()) >= options_.max_coils) growing[idx] = 0;
      if (growing[idx] != 0) found[idx] = coil_along(idx);
      if (found[idx].empty()) growing[idx] = 0;
    });
    bool any = false;
    for (std::size_t c = 0; c < cables_.size(); ++c) {
      if (found[c].empty()) continue;
      any = true;
      std::vector<Base> coil;
      for (const CoilFit& fit : found[c]) {
        coil.push_back(fit.base);
        coil.back().coefficients = {fit.coefficient, 0, 0};
      }
      unwrap(coil);
      cables_[c].coils.push_back(std::move(coil));
    }
    return any;
  }

  /// Core scales: the reach, or farther where the coils there are lead outwards (a large wing on a small core).
  double reach_of_cable(const Cable& cable) const {
    double sum = 0, weight = 0;
    for (const std::vector<Base>& coil : cable.coils)
      for (std::size_t at = 0; at < coil.size(); ++at) {
        const Base &base = coil[at], &core = cable.core[at];
        const double energy = std::pow(static_cast<double>(base.coefficients[0]), 2);
        sum += energy * (std::hypot(base.x - core.x, base.y - core.y) + 2 * base.scale) / core.scale;
        weight += energy;
      }
    const double extent = weight > 0 ? sum / weight : 0;
    return std::clamp(1.2 * extent, options_.reach, kMostReach * options_.reach);
  }

  /// The next coil of a cable in all its frames; none when it is not worth it.
  std::vector<CoilFit> coil_along(std::size_t idx) const {
    const Cable& cable = cables_[idx];
    const std::size_t num = cable.core.size();
    std::vector<CoilWindow> windows(num);
    std::vector<CoilFit> fresh(num);
    double enough = 0;
    const double weakest = options_.min_contrast * noise_, reach = reach_of_cable(cable);
    for (std::size_t at = 0; at < num; ++at) {
      const std::int64_t frame = cable.first_frame + static_cast<std::int64_t>(at);
      if (frame < 0 || frame >= light_.num_frames()) continue;
      const Base& core = cable.core[at];
      const double least =
          std::max(weakest, std::sqrt(options_.min_share) * std::abs(static_cast<double>(core.coefficients[0])));
      enough += least * least;
      windows[at] = cut_window(light_.left(static_cast<std::size_t>(frame)), core, light_.neighbours(idx, at), reach);
      fresh[at] = find_coil(windows[at], core, reach, least);
    }
    const auto strongest = static_cast<std::size_t>(
        std::max_element(fresh.begin(), fresh.end(),
                         [](const CoilFit& a, const CoilFit& b) { return a.energy() < b.energy(); }) -
        fresh.begin());
    if (num == 0 || fresh[strongest].energy() == 0) return {};
    std::vector<CoilFit> out = fresh;
    for (std::size_t at = strongest + 1; at < num; ++at)
      out[at] = carried(cable, windows[at], out, fresh, at, at - 1, reach);
    for (std::size_t at = strongest; at-- > 0;) out[at] = carried(cable, windows[at], out, fresh, at, at + 1, reach);
    double energy = 0;
    for (const CoilFit& fit : out) energy += fit.energy();
    return energy < enough ? std::vector<CoilFit>() : out;
  }

  CoilFit carried(const Cable& cable, const CoilWindow& window, const std::vector<CoilFit>& coil,
                  const std::vector<CoilFit>& fresh, std::size_t at, std::size_t from, double reach) const {
    CoilFit along = carry_coil(window, cable.core[at], coil[from], cable.core[from], reach);
    return fresh[at].energy() > kJump * along.energy() + 4 * noise_ * noise_ ? fresh[at] : along;
  }

  /// Angles go on without jumps of half a turn; half a turn changes the sign of Gsin.
  static void unwrap(std::vector<Base>& coil) {
    for (std::size_t at = 1; at < coil.size(); ++at) {
      if (!is_oriented(coil[at].kind)) continue;
      const double halves = std::round((coil[at - 1].angle - coil[at].angle) / std::numbers::pi);
      coil[at].angle += halves * std::numbers::pi;
      if (coil[at].kind == BaseKind::kGaborSin && std::fmod(std::abs(halves), 2) == 1)
        for (float& coefficient : coil[at].coefficients) coefficient = -coefficient;
    }
  }

  MovetonLight& light_;
  std::vector<Cable>& cables_;
  const GrowCoilsOptions& options_;
  const JobContext& job_;
  double noise_ = 1;
};

}  // namespace

void add_coils(MovetonLight& light, std::vector<Cable>& cables, const std::vector<char>& which,
               const GrowCoilsOptions& options, double noise, const JobContext& job) {
  CoilGrower(light, cables, options, job).run(noise, which);
}

void count_bases(const std::vector<Cable>& cables, double reach, GrowCoilsReport& report) {
  double num = 0, bases = 0, alone = 0;
  const std::vector<std::vector<char>> isolated = isolated_frames(cables, reach / 2);
  for (std::size_t c = 0; c < cables.size(); ++c) {
    const auto frames = static_cast<double>(cables[c].core.size());
    num += frames;
    bases += frames * static_cast<double>(1 + cables[c].coils.size());
    for (const char is : isolated[c]) alone += is;
  }
  report.bases_per_moveton = num > 0 ? bases / num : 0;
  report.isolated_share = num > 0 ? alone / num : 0;
}

std::vector<std::vector<char>> isolated_frames(const std::vector<Cable>& cables, double reach) {
  std::int64_t first = 0, end = 0;
  for (const Cable& cable : cables) {
    first = std::min(first, cable.first_frame);
    end = std::max(end, cable.end_frame());
  }
  std::vector<std::vector<std::size_t>> present(static_cast<std::size_t>(end - first));
  std::vector<std::vector<char>> out(cables.size());
  for (std::size_t c = 0; c < cables.size(); ++c) {
    out[c].assign(cables[c].core.size(), 1);
    for (std::int64_t frame = cables[c].first_frame; frame < cables[c].end_frame(); ++frame)
      present[static_cast<std::size_t>(frame - first)].push_back(c);
  }
  for (std::int64_t frame = first; frame < end; ++frame) {
    const std::vector<std::size_t>& here = present[static_cast<std::size_t>(frame - first)];
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t k = i + 1; k < here.size(); ++k) {
        const Base &a = cables[here[i]].at(frame), &b = cables[here[k]].at(frame);
        const double dx = a.x - b.x, dy = a.y - b.y, near = reach * (a.scale + b.scale);
        if (dx * dx + dy * dy > near * near) continue;
        out[here[i]][static_cast<std::size_t>(frame - cables[here[i]].first_frame)] = 0;
        out[here[k]][static_cast<std::size_t>(frame - cables[here[k]].first_frame)] = 0;
      }
  }
  return out;
}

GrowCoilsReport grow_coils(const ClipFrames& clip, const Planes& background, const std::vector<Plane>& residuals,
                           std::vector<Cable>& cables, const GrowCoilsOptions& options, const JobContext& job) {
  check_options(options);
  for (Cable& cable : cables) cable.coils.clear();
  MovetonLight light(clip, background, residuals, cables, kMostReach * options.reach, job);
  GrowCoilsReport report;
  report.background_psnr = light.background_psnr();
  light.fit_luma();
  report.cores_psnr = light.psnr();
  report.noise = light.noise();
  add_coils(light, cables, std::vector<char>(cables.size(), 1), options, report.noise, job);
  report.psnr = light.psnr();
  light.fit_colours();
  count_bases(cables, options.reach, report);
  return report;
}

GrowCoilsReport grow_coils(const ClipFrames& clip, const Planes& background, std::vector<Cable>& cables,
                           const GrowCoilsOptions& options, const JobContext& job) {
  return grow_coils(clip, background, {}, cables, options, job);
}

}  // namespace motex
