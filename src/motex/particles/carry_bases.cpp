// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/carry_bases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/refine.h"

namespace motex {
namespace {

constexpr double kMaxJump = 2.5;      // scales that a base may lie from where it was expected
constexpr double kMaxGrowth = 1.35;   // of its scale in one frame
constexpr double kOwnVelocity = 0.5;  // weight of the last step in a cable's velocity

constexpr float kMostCancelled = 5;  // |α| / |⟨b, image⟩| of a base that mostly makes up for others
constexpr double kAlike = 0.9;       // inner product of two bases beyond which they are one

struct CarriedBase {
  Base base;  ///< coefficients[0] is that of the luma, angle unwrapped
  BasePatch patch;
  double vx = 0, vy = 0;
  int cable = 0;
};

double squares_left(Plane image, const std::vector<BasePatch>& patches, const std::vector<float>& coefficients) {
  for (std::size_t j = 0; j < patches.size(); ++j) add_patch(image, patches[j], -coefficients[j]);
  double sum = 0;
  for (const float value : image.values) sum += static_cast<double>(value * value);
  return sum;
}

/// Least squares, or `start` where rounding makes of it something worse (bases nearly alike).
std::vector<float> fit_or_keep(const Plane& image, const std::vector<BasePatch>& patches,
                               const std::vector<float>& start) {
  std::vector<float> fitted = fit_coefficients(image, patches, start);
  return squares_left(image, patches, fitted) <= squares_left(image, patches, start) ? fitted : start;
}

/// Frames visited in one direction from the middle.
class Carrier {
 public:
  Carrier(const ClipFrames& clip, const Planes& background, const FlowField& flow, int direction,
          const CarryOptions& options, const JobContext& job)
      : clip_(clip), background_(background), flow_(flow), direction_(direction), options_(options), job_(job) {
    luma_background_ = luma(background);
  }

  /// All bases of the first frame by pursuit: the same for both directions.
  void start(int frame) {
    target_ = target_of(frame);
    residual_ = target_;
    pursue_rest();
    finish_frame(frame);
  }

  void step(int frame) {
    job_.check_cancelled();
    target_ = target_of(frame);
    residual_ = target_;
    move_along();
    refit();
    drop_doubles();
    give_up_weak();
    pursue_rest();
    finish_frame(frame);
  }

  /// [cable] → its bases in the order visited; first frames of each.
  struct Path {
    int start = 0;
    std::vector<Base> bases;
  };
  const std::vector<Path>& paths() const { return paths_; }

 private:
  Plane target_of(int frame) const {
    Plane target = clip_.luma[static_cast<std::size_t>(frame)];
    for (std::size_t i = 0; i < target.values.size(); ++i) target.values[i] -= luma_background_.values[i];
    return target;
  }

  FlowField::Velocity flow_at(const Base& base) const {
    const FlowField::Velocity v = flow_.at(base.x, base.y);
    return {direction_ * v.x, direction_ * v.y};
  }

  /// Moves every base to the best of three places and takes it off the residual.
  void move_along() {
    std::sort(carried_.begin(), carried_.end(), [](const CarriedBase& a, const CarriedBase& b) {
      const float x = std::abs(a.base.coefficients[0]), y = std::abs(b.base.coefficients[0]);
      return x != y ? x > y : a.cable < b.cable;
    });
    for (CarriedBase& one : carried_) {
      const FlowField::Velocity flow = flow_at(one.base);
      const std::array<FlowField::Velocity, 3> choices{{{one.vx, one.vy}, flow, {0, 0}}};
      const float sign = one.base.coefficients[0] < 0 ? -1.0F : 1.0F;
      Base best = one.base;
      float most = -1e30F;
      BasePatch best_patch;
      for (const FlowField::Velocity& v : choices) {
        Base moved = one.base;
        moved.x += v.x;
        moved.y += v.y;
        BasePatch patch = render_patch(moved, residual_.width, residual_.height);
        const float answer = patch.values.empty() ? -1e29F : sign * inner_product(patch, residual_);
        if (answer <= most) continue;
        most = answer;
        best = moved;
        best_patch = std::move(patch);
      }
      one.base = best;
      one.patch = std::move(best_patch);
      add_patch(residual_, one.patch, -one.base.coefficients[0]);
    }
  }

  /// Fits each base continuously to what the others leave of it.
  void refit() {
    std::vector<CarriedBase> kept;
    for (CarriedBase& one : carried_) {
      add_patch(residual_, one.patch, one.base.coefficients[0]);
      if (!fit_one(one)) continue;
      add_patch(residual_, one.patch, -one.base.coefficients[0]);
      kept.push_back(std::move(one));
    }
    carried_ = std::move(kept);
  }

  bool fit_one(CarriedBase& one) const {
    const Base before = one.base;
    const bool inside =
        before.x > -0.5 && before.y > -0.5 && before.x < residual_.width - 0.5 && before.y < residual_.height - 0.5;
    if (!inside) return false;
    FittedBase fitted = refine_base(residual_, before, options_.refine_steps);
    // the angle was folded into [0, π); half a turn changes the sign of Gsin
    const double half_turns = std::round((before.angle - fitted.base.angle) / std::numbers::pi);
    fitted.base.angle += half_turns * std::numbers::pi;
    if (before.kind == BaseKind::kGaborSin && std::fmod(half_turns, 2) != 0) fitted.coefficient = -fitted.coefficient;
    const double jump = std::hypot(fitted.base.x - before.x, fitted.base.y - before.y);
    const double growth = std::abs(std::log(fitted.base.scale / before.scale));
    if (jump > kMaxJump * before.scale || growth > std::log(kMaxGrowth)) return false;
    const float sign = before.coefficients[0] < 0 ? -1.0F : 1.0F;
    if (!(sign * fitted.coefficient > static_cast<float>(options_.keep_share) * std::abs(before.coefficients[0])))
      return false;
    one.base = fitted.base;
    one.base.coefficients[0] = fitted.coefficient;
    one.patch = render_patch(one.base, residual_.width, residual_.height);
    return true;
  }

  /// Of two bases that have become one, the weaker ends; its light is found again if it is needed.
  void drop_doubles() {
    std::vector<char> ended(carried_.size(), 0);
    for (std::size_t a = 0; a < carried_.size(); ++a)
      for (std::size_t b = a + 1; b < carried_.size(); ++b) {
        const Base &p = carried_[a].base, &q = carried_[b].base;
        if (ended[a] != 0 || ended[b] != 0) continue;
        const double near = 0.7 * std::min(p.scale, q.scale);
        if (std::abs(p.x - q.x) > near || std::abs(p.y - q.y) > near) continue;
        if (std::abs(inner_product(carried_[a].patch, carried_[b].patch)) < kAlike) continue;
        ended[std::abs(p.coefficients[0]) < std::abs(q.coefficients[0]) ? a : b] = 1;
      }
    std::vector<CarriedBase> kept;
    for (std::size_t k = 0; k < carried_.size(); ++k) {
      if (ended[k] == 0)
        kept.push_back(std::move(carried_[k]));
      else
        add_patch(residual_, carried_[k].patch, carried_[k].base.coefficients[0]);
    }
    carried_ = std::move(kept);
  }

  /// And those that cancel others: small moves of such pairs leave large errors.
  void give_up_weak() {
    solve_coefficients();
    const float least = std::max(static_cast<float>(options_.min_coefficient), 0.7F * weakest_new_);
    std::vector<CarriedBase> kept;
    for (CarriedBase& one : carried_) {
      const float strength = std::abs(one.base.coefficients[0]);
      const bool cancels = strength > kMostCancelled * std::abs(inner_product(one.patch, target_)) + least;
      if (strength >= least && !cancels)
        kept.push_back(std::move(one));
      else
        add_patch(residual_, one.patch, one.base.coefficients[0]);
    }
    carried_ = std::move(kept);
  }

  void pursue_rest() {
    const int missing = options_.num_bases - static_cast<int>(carried_.size());
    if (missing <= 0) return;
    PursueOptions pursue_options;
    pursue_options.num_bases = missing;
    pursue_options.dictionary = options_.dictionary;
    pursue_options.refine_rounds = 0;
    pursue_options.min_coefficient = options_.min_coefficient;
    const JobContext silent{nullptr, nullptr, job_.cancel, 1};
    const BaseMap found = pursue({residual_}, pursue_options, silent);
    weakest_new_ = found.bases.empty() ? 0 : 1e30F;
    for (const Base& base : found.bases) {
      weakest_new_ = std::min(weakest_new_, std::abs(base.coefficients[0]));
      const FlowField::Velocity v = flow_at(base);
      carried_.push_back({base, render_patch(base, residual_.width, residual_.height), v.x, v.y, -1});
    }
    solve_coefficients();
  }

  /// Joint least squares on the luma; the residual is what is left.
  void solve_coefficients() {
    std::vector<BasePatch> patches;
    std::vector<float> coefficients;
    for (CarriedBase& one : carried_) {
      patches.push_back(std::move(one.patch));
      coefficients.push_back(one.base.coefficients[0]);
    }
    coefficients = fit_or_keep(target_, patches, coefficients);
    residual_ = target_;
    for (std::size_t j = 0; j < carried_.size(); ++j) {
      add_patch(residual_, patches[j], -coefficients[j]);
      carried_[j].base.coefficients[0] = coefficients[j];
      carried_[j].patch = std::move(patches[j]);
    }
  }

  void finish_frame(int frame) {
    const std::vector<std::array<float, 3>> colours = colours_in(frame);
    for (std::size_t j = 0; j < carried_.size(); ++j) {
      CarriedBase& one = carried_[j];
      if (one.cable < 0) {
        one.cable = static_cast<int>(paths_.size());
        paths_.push_back({frame, {}});
      }
      Path& path = paths_[static_cast<std::size_t>(one.cable)];
      if (!path.bases.empty()) {
        one.vx += kOwnVelocity * (one.base.x - path.bases.back().x - one.vx);
        one.vy += kOwnVelocity * (one.base.y - path.bases.back().y - one.vy);
      }
      path.bases.push_back(one.base);
      path.bases.back().coefficients = colours[j];
    }
  }

  /// The coefficients of each plane.
  std::vector<std::array<float, 3>> colours_in(int frame) const {
    std::vector<std::array<float, 3>> out(carried_.size());
    std::vector<float> grey;
    for (const CarriedBase& one : carried_) grey.push_back(one.base.coefficients[0]);
    for (std::size_t j = 0; j < out.size(); ++j) out[j][0] = grey[j];
    if (background_.size() == 1) return out;
    std::vector<BasePatch> patches;
    for (const CarriedBase& one : carried_) patches.push_back(one.patch);
    const Planes planes = to_planes(clip_.colour[static_cast<std::size_t>(frame)], 3);
    for (std::size_t k = 0; k < 3; ++k) {
      Plane target = planes[k];
      for (std::size_t i = 0; i < target.values.size(); ++i) target.values[i] -= background_[k].values[i];
      const std::vector<float> fit = fit_or_keep(target, patches, grey);
      for (std::size_t j = 0; j < out.size(); ++j) out[j][k] = fit[j];
    }
    return out;
  }

  const ClipFrames& clip_;
  const Planes& background_;
  const FlowField& flow_;
  int direction_;
  const CarryOptions& options_;
  const JobContext& job_;
  Plane luma_background_, target_, residual_;
  std::vector<CarriedBase> carried_;
  std::vector<Path> paths_;
  float weakest_new_ = 0;
};

void check_clip(const ClipFrames& clip, const Planes& background) {
  if (clip.luma.empty()) throw InvalidInput("bases are carried through at least one frame");
  if (background.size() != 1 && background.size() != 3)
    throw InvalidInput("the background must have one or three planes");
  if (background.size() == 3 && clip.colour.size() != clip.luma.size())
    throw InvalidInput("a coloured background needs coloured frames");
  for (const Plane& plane : background)
    if (plane.width != clip.width || plane.height != clip.height)
      throw InvalidInput("background and frames must have one size");
}

/// Joins what was followed backwards and forwards from the middle frame; both number its bases alike.
std::vector<Cable> join(const std::vector<Carrier::Path>& back, const std::vector<Carrier::Path>& forth, int middle) {
  std::vector<Cable> cables;
  for (std::size_t k = 0; k < std::max(back.size(), forth.size()); ++k) {
    const bool has_back = k < back.size(), has_forth = k < forth.size();
    if (has_back && has_forth && back[k].start == middle && forth[k].start == middle) {
      Cable cable{middle - static_cast<std::int64_t>(back[k].bases.size()) + 1, {}, {}, -1, {}};
      cable.core.assign(back[k].bases.rbegin(), back[k].bases.rend());
      cable.core.insert(cable.core.end(), forth[k].bases.begin() + 1, forth[k].bases.end());
      cables.push_back(std::move(cable));
      continue;
    }
    if (has_back) {
      Cable cable{back[k].start - static_cast<std::int64_t>(back[k].bases.size()) + 1, {}, {}, -1, {}};
      cable.core.assign(back[k].bases.rbegin(), back[k].bases.rend());
      cables.push_back(std::move(cable));
    }
    if (has_forth) cables.push_back({forth[k].start, forth[k].bases, {}, -1, {}});
  }
  std::stable_sort(cables.begin(), cables.end(),
                   [](const Cable& a, const Cable& b) { return a.first_frame < b.first_frame; });
  return cables;
}

}  // namespace

std::vector<Cable> carry_bases(const ClipFrames& clip, const Planes& background, const CarryOptions& options,
                               const JobContext& job) {
  check_clip(clip, background);
  const FlowField flow =
      clip.luma.size() > 1 ? estimate_flow_field(luma_residuals(clip, background), {}, job.jobs) : FlowField{};
  return carry_bases(clip, background, flow, options, job);
}

std::vector<Cable> carry_bases(const ClipFrames& clip, const Planes& background, const FlowField& flow,
                               const CarryOptions& options, const JobContext& job) {
  check_options(options);
  check_clip(clip, background);
  const int last = clip.num_frames() - 1, middle = clip.num_frames() / 2;
  const JobContext silent{nullptr, nullptr, job.cancel, 1};
  Carrier back(clip, background, flow, -1, options, silent), forth(clip, background, flow, 1, options, silent);
  job.progress("carrying bases", 0);
  // a few frames at a time, so that progress can be told from this thread
  constexpr int kBatch = 4;
  parallel_for(job.jobs, 2, [&](int side) { (side == 0 ? back : forth).start(middle); });
  for (int done = 0; done < std::max(middle, last - middle); done += kBatch) {
    parallel_for(job.jobs, 2, [&](int side) {
      for (int k = done + 1; k <= done + kBatch; ++k) {
        if (side == 0 && middle - k >= 0) back.step(middle - k);
        if (side == 1 && middle + k <= last) forth.step(middle + k);
      }
    });
    job.progress("carrying bases", std::min(1.0, static_cast<double>(done + kBatch) / (middle + 1)));
  }
  job.progress("carrying bases", 1);
  return join(back.paths(), forth.paths(), middle);
}

BaseMap bases_in_frame(const std::vector<Cable>& cables, std::int64_t frame, int width, int height, int num_planes) {
  BaseMap map{width, height, num_planes, {}};
  for (const Cable& cable : cables) {
    if (!cable.covers(frame)) continue;
    map.bases.push_back(cable.at(frame));
    for (const std::vector<Base>& coil : cable.coils)
      map.bases.push_back(coil[static_cast<std::size_t>(frame - cable.first_frame)]);
  }
  return map;
}

CarryReport measure_cables(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
                           int jobs) {
  CarryReport report;
  const auto num = static_cast<std::size_t>(clip.num_frames());
  std::vector<double> with(num), without(num);
  const int num_planes = static_cast<int>(background.size());
  parallel_for(jobs, clip.num_frames(), [&](int t) {
    const auto k = static_cast<std::size_t>(t);
    const Planes shown = reconstruct(bases_in_frame(cables, t, clip.width, clip.height, num_planes), background);
    with[k] = psnr(luma(shown), clip.luma[k]);
    without[k] = psnr(luma(background), clip.luma[k]);
  });
  for (std::size_t k = 0; k < num; ++k) {
    report.psnr += with[k] / static_cast<double>(num);
    report.background_psnr += without[k] / static_cast<double>(num);
  }
  for (const Cable& cable : cables) report.mean_life += static_cast<double>(cable.num_frames());
  report.bases_per_frame = report.mean_life / static_cast<double>(std::max<std::size_t>(1, num));
  if (!cables.empty()) report.mean_life /= static_cast<double>(cables.size());
  return report;
}

}  // namespace motex
