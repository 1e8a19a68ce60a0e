// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/regroup.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "motex/core/parallel.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/coil_search.h"
#include "motex/particles/joint_fit.h"
#include "motex/particles/moveton_light.h"
#include "motex/particles/refine.h"

namespace motex {
namespace {

constexpr double kCoreScale = 4;  // pixels, of the mean picture
constexpr int kMeanSide = 48;
constexpr double kMeanReach = 5;  // core scales
constexpr std::size_t kMostMovetons = 300;
constexpr int kFitSteps = 3;
constexpr double kLeash = 1;         // of the coil's scale
constexpr double kMostGrowth = 1.8;  // of the coil's scale
constexpr double kIsolation = 1.5;
constexpr double kMostReach = 2.5;  // times the reach, of coils that lead outwards

/// Fits bases in turn to what the others leave of `target`, then coefficients together.
void refit(const Plane& target, std::vector<Base>& bases) {
  Plane left = target;
  for (const Base& base : bases) add_patch(left, render_patch(base, left.width, left.height), -base.coefficients[0]);
  for (Base& base : bases) {
    add_patch(left, render_patch(base, left.width, left.height), base.coefficients[0]);
    const FittedBase fit = refine_base(left, base, kFitSteps);
    base = fit.base;
    base.coefficients[0] = fit.coefficient;
    add_patch(left, fit.patch, -fit.coefficient);
  }
  std::vector<float> alpha;
  for (const Base& base : bases) alpha.push_back(base.coefficients[0]);
  alpha = JointFit(bases, target.width, target.height, 1e-3).solve(target, alpha);
  for (std::size_t j = 0; j < bases.size(); ++j) bases[j].coefficients[0] = alpha[j];
}

Plane left_of(Plane target, const std::vector<Base>& bases) {
  for (const Base& base : bases)
    add_patch(target, render_patch(base, target.width, target.height), -base.coefficients[0]);
  return target;
}

/// Species and state.
using Shape = std::pair<int, int>;
using Shapes = std::map<Shape, std::vector<RelativeBase>>;

Shape shape_at(const Cable& cable, std::size_t at) {
  return {cable.species, cable.poses.empty() ? 0 : cable.poses[at]};
}

Shapes mean_shapes(const std::vector<Cable>& cables, int num_planes, const RegroupCoilsOptions& options) {
  const std::vector<std::vector<char>> isolated = isolated_frames(cables, kIsolation);
  struct Instance {
    const Cable* cable;
    std::size_t at;
  };
  std::map<Shape, std::vector<Instance>> seen;
  for (std::size_t c = 0; c < cables.size(); ++c)
    for (std::size_t at = 0; at < cables[c].core.size(); ++at)
      if (isolated[c][at] != 0) seen[shape_at(cables[c], at)].push_back({&cables[c], at});
  Shapes out;
  for (const auto& [shape, instances] : seen) {
    std::vector<std::vector<RelativeBase>> movetons;
    const std::size_t stride = std::max<std::size_t>(1, instances.size() / kMostMovetons);
    for (std::size_t i = 0; i < instances.size(); i += stride) {
      const Cable& cable = *instances[i].cable;
      const Base& core = cable.core[instances[i].at];
      std::vector<RelativeBase>& coils = movetons.emplace_back();
      for (const std::vector<Base>& coil : cable.coils)
        coils.push_back(relative_to(coil[instances[i].at], core, num_planes));
    }
    out[shape] = coils_of_mean(movetons, instances[0].cable->core[0].kind, num_planes, options);
  }
  return out;
}

bool has_common_coils(const Cable& cable, const Shapes& shapes) {
  for (std::size_t at = 0; at < cable.core.size(); ++at) {
    const auto found = shapes.find(shape_at(cable, at));
    if (found != shapes.end() && !found->second.empty()) return true;
  }
  return false;
}

/// Coils where the mean shapes have them.
void place_coils(Cable& cable, const Shapes& shapes, int num_planes) {
  const std::size_t num = cable.core.size();
  std::size_t most = 0;
  const auto coils_at = [&](std::size_t at) -> const std::vector<RelativeBase>* {
    const auto found = shapes.find(shape_at(cable, at));
    return found == shapes.end() ? nullptr : &found->second;
  };
  for (std::size_t at = 0; at < num; ++at)
    if (const std::vector<RelativeBase>* coils = coils_at(at)) most = std::max(most, coils->size());
  cable.coils.assign(most, std::vector<Base>(num));
  for (std::size_t at = 0; at < num; ++at) {
    Base grey = cable.core[at];
    grey.coefficients = {static_cast<float>(luma_coefficient(grey, num_planes)), 0, 0};
    const std::vector<RelativeBase>* coils = coils_at(at);
    for (std::size_t j = 0; j < most; ++j) {
      const bool is_there = coils != nullptr && j < coils->size();
      cable.coils[j][at] =
          is_there ? placed_at((*coils)[j], grey, 1) : Base{BaseKind::kGaussian, grey.x, grey.y, grey.scale, 0, {}};
    }
  }
}

/// Core scales to the rim of the outermost coil.
double extent_of(const Cable& cable) {
  double extent = 0;
  for (const std::vector<Base>& coil : cable.coils)
    for (std::size_t at = 0; at < coil.size(); ++at)
      extent = std::max(
          extent, std::hypot(coil[at].x - cable.core[at].x, coil[at].y - cable.core[at].y) / cable.core[at].scale);
  return extent;
}

/// A coil in what others leave, near where the shape has it.
void fit_on_leash(CoilWindow& window, const Base& start, Base& coil) {
  Base local = coil;
  local.x -= window.left;
  local.y -= window.top;
  Plane& left = window.residual;
  if (local.x < 0 || local.y < 0 || local.x > left.width - 1 || local.y > left.height - 1) return;
  add_patch(left, render_patch(local, left.width, left.height), local.coefficients[0]);
  FittedBase fit = refine_base(left, local, kFitSteps);
  const double away = std::hypot(fit.base.x + window.left - start.x, fit.base.y + window.top - start.y);
  const double growth = fit.base.scale / start.scale;
  const double turn = std::remainder(fit.base.angle - start.angle, std::numbers::pi);
  const bool is_near = away <= kLeash * start.scale && growth < kMostGrowth && growth > 1 / kMostGrowth &&
                       (!is_oriented(start.kind) || std::abs(turn) < 0.7);
  if (!is_near) fit = refine_base(left, local, 0);
  add_patch(left, fit.patch, -fit.coefficient);
  coil = fit.base;
  coil.x += window.left;
  coil.y += window.top;
  coil.coefficients = {fit.coefficient, 0, 0};
  if (!is_oriented(coil.kind)) return;
  const double halves = std::round((start.angle - coil.angle) / std::numbers::pi);
  coil.angle += halves * std::numbers::pi;
  if (coil.kind == BaseKind::kGaborSin && std::fmod(std::abs(halves), 2) == 1) coil.coefficients[0] *= -1;
}

}  // namespace

std::vector<RelativeBase> coils_of_mean(const std::vector<std::vector<RelativeBase>>& movetons, BaseKind core_kind,
                                        int num_planes, const RegroupCoilsOptions& options) {
  Base core{core_kind, (kMeanSide - 1) / 2.0, (kMeanSide - 1) / 2.0, kCoreScale, 0, {1, 0, 0}};
  Plane mean(kMeanSide, kMeanSide);
  for (const std::vector<RelativeBase>& coils : movetons)
    for (RelativeBase coil : coils) {
      coil.coefficient = {luma_coefficient(coil, num_planes), 0, 0};
      const Base base = placed_at(coil, core, 1);
      add_patch(mean, render_patch(base, kMeanSide, kMeanSide),
                base.coefficients[0] / static_cast<float>(std::max<std::size_t>(1, movetons.size())));
    }
  std::vector<Base> bases;
  while (static_cast<int>(bases.size()) < options.max_coils) {
    const CoilWindow window{0, 0, left_of(mean, bases)};
    const CoilFit found = find_coil(window, core, kMeanReach, std::sqrt(options.min_share));
    if (found.energy() < options.min_share) break;
    bases.push_back(found.base);
    bases.back().coefficients = {found.coefficient, 0, 0};
    refit(mean, bases);
    refit(mean, bases);
  }
  std::vector<RelativeBase> out;
  for (const Base& base : bases) out.push_back(relative_to(base, core, 1));
  return out;
}

GrowCoilsReport regroup_coils(const ClipFrames& clip, const Planes& background, const std::vector<Plane>& residuals,
                              std::vector<Cable>& cables, const RegroupCoilsOptions& options, const JobContext& job) {
  const Shapes shapes = mean_shapes(cables, clip.num_planes(), options);
  std::vector<char> regrouped(cables.size(), 0), growing(cables.size(), 0);
  std::vector<std::vector<std::vector<Base>>> starts(cables.size());
  for (std::size_t c = 0; c < cables.size(); ++c) {
    regrouped[c] = has_common_coils(cables[c], shapes) ? 1 : 0;
    if (regrouped[c] == 0) {  // keeps its own
      for (std::vector<Base>& coil : cables[c].coils)
        for (Base& base : coil)
          base.coefficients = {static_cast<float>(luma_coefficient(base, clip.num_planes())), 0, 0};
      continue;
    }
    const std::size_t num_before = cables[c].coils.size();
    place_coils(cables[c], shapes, clip.num_planes());
    growing[c] = cables[c].coils.size() < num_before ? 1 : 0;
    starts[c] = cables[c].coils;
  }
  MovetonLight light(clip, background, residuals, cables, kMostReach * options.reach, job);
  GrowCoilsReport report;
  report.background_psnr = light.background_psnr();
  light.fit_luma();
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    job.progress("coils of templates", static_cast<double>(sweep) / options.sweeps);
    parallel_for(job.jobs, static_cast<int>(cables.size()), [&](int c) {
      job.check_cancelled();
      const auto idx = static_cast<std::size_t>(c);
      Cable& cable = cables[idx];
      const double reach = std::clamp(1.2 * extent_of(cable), options.reach, kMostReach * options.reach);
      for (std::size_t at = 0; at < cable.core.size() && regrouped[idx] != 0; ++at) {
        const std::int64_t frame = cable.first_frame + static_cast<std::int64_t>(at);
        if (frame < 0 || frame >= clip.num_frames()) continue;
        CoilWindow window =
            cut_window(light.left(static_cast<std::size_t>(frame)), cable.core[at], light.neighbours(idx, at), reach);
        for (std::size_t j = 0; j < cable.coils.size(); ++j)
          if (cable.coils[j][at].coefficients[0] != 0) fit_on_leash(window, starts[idx][j][at], cable.coils[j][at]);
      }
    });
    light.fit_luma();
  }
  report.noise = light.noise();
  GrowCoilsOptions more;
  more.max_coils = options.max_coils;
  more.min_share = options.min_share;
  more.reach = options.reach;
  add_coils(light, cables, growing, more, report.noise, job);
  report.psnr = light.psnr();
  light.fit_colours();
  count_bases(cables, options.reach, report);
  return report;
}

}  // namespace motex
