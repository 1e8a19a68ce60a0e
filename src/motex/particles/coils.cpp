// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/coils.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/coil_search.h"
#include "motex/particles/joint_fit.h"

namespace motex {
namespace {

constexpr double kRidge = 0.02;
constexpr double kLeastNoise = 1;  // grey levels: rounding and compression
constexpr double kJump = 1.4;      // a new place must have so much more energy than the carried coil

/// Where a cable's bases stand in a frame.
struct Occupant {
  int cable = 0;
  std::size_t at = 0;  // frame − first_frame
};

class CoilGrower {
 public:
  CoilGrower(const ClipFrames& clip, const Planes& background, std::vector<Cable>& cables,
             const GrowCoilsOptions& options, const JobContext& job)
      : clip_(clip),
        background_(background),
        grey_background_(luma(background)),
        cables_(cables),
        options_(options),
        job_(job) {
    frames_.resize(clip.luma.size());
    for (std::size_t c = 0; c < cables.size(); ++c)
      for (std::size_t at = 0; at < cables[c].core.size(); ++at) {
        const std::int64_t frame = cables[c].first_frame + static_cast<std::int64_t>(at);
        if (frame >= 0 && frame < clip.num_frames())
          frames_[static_cast<std::size_t>(frame)].push_back({static_cast<int>(c), at});
      }
    residuals_.resize(clip.luma.size());
    squares_.resize(clip.luma.size());
    find_neighbours();
  }

  GrowCoilsReport run() {
    GrowCoilsReport report;
    for (Cable& cable : cables_) {
      cable.coils.clear();
      for (Base& core : cable.core)
        core.coefficients = {static_cast<float>(luma_coefficient(core, clip_.num_planes())), 0, 0};
    }
    report.background_psnr = psnr_of_background();
    fit_all();
    report.cores_psnr = mean_psnr();
    report.noise = noise_ = noise_of_residual();
    std::vector<char> growing(cables_.size(), 1);
    for (int round = 0; round < options_.max_coils; ++round) {
      job_.progress("coils", static_cast<double>(round) / options_.max_coils);
      if (!grow_one(growing)) break;
      fit_all();
    }
    report.psnr = mean_psnr();
    fit_colours();
    count(report);
    return report;
  }

 private:
  /// Cores near enough to own pixels in the window of each.
  void find_neighbours() {
    neighbours_.resize(cables_.size());
    for (std::size_t c = 0; c < cables_.size(); ++c) neighbours_[c].resize(cables_[c].core.size());
    parallel_for(job_.jobs, clip_.num_frames(), [&](int frame) {
      const std::vector<Occupant>& here = frames_[static_cast<std::size_t>(frame)];
      for (const Occupant& a : here)
        for (const Occupant& b : here) {
          if (a.cable == b.cable) continue;
          const Base &core = core_of(a), &other = core_of(b);
          // farther than that from the window's edge it owns nothing there
          const double limit = ((options_.reach + 2) * core.scale + 1) * (1 + other.scale / core.scale);
          if (std::abs(core.x - other.x) > limit || std::abs(core.y - other.y) > limit) continue;
          if (std::hypot(core.x - other.x, core.y - other.y) < limit)
            neighbours_[static_cast<std::size_t>(a.cable)][a.at].push_back(other);
        }
    });
  }

  const Base& core_of(const Occupant& who) const { return cables_[static_cast<std::size_t>(who.cable)].core[who.at]; }

  /// a − b.
  static Plane minus(Plane a, const Plane& b) {
    for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
    return a;
  }

  std::vector<Base*> bases_of(int frame) {
    std::vector<Base*> out;
    for (const Occupant& who : frames_[static_cast<std::size_t>(frame)]) {
      Cable& cable = cables_[static_cast<std::size_t>(who.cable)];
      out.push_back(&cable.core[who.at]);
      for (std::vector<Base>& coil : cable.coils) out.push_back(&coil[who.at]);
    }
    return out;
  }

  /// Luma coefficients (in coefficients[0]) of all frames, and what they leave.
  void fit_all() {
    parallel_for(job_.jobs, clip_.num_frames(), [&](int frame) {
      job_.check_cancelled();
      const auto idx = static_cast<std::size_t>(frame);
      const std::vector<Base*> places = bases_of(frame);
      const JointFit fit(copies_of(places), clip_.width, clip_.height, kRidge);
      Plane& left = residuals_[idx] = minus(clip_.luma[idx], grey_background_);
      solve_plane(fit, left, places, 0, 1);
      for (std::size_t j = 0; j < places.size(); ++j) add_patch(left, fit.patches()[j], -places[j]->coefficients[0]);
      squares_[idx] = 0;
      for (const float value : left.values) squares_[idx] += static_cast<double>(value) * static_cast<double>(value);
    });
  }

  /// Geometry is settled: the same for every colour. The second time from what the first gave, so that the ridge
  /// does not draw colours towards grey.
  void fit_colours() {
    if (clip_.colour.empty()) return;
    parallel_for(job_.jobs, clip_.num_frames(), [&](int frame) {
      job_.check_cancelled();
      const std::vector<Base*> places = bases_of(frame);
      const JointFit fit(copies_of(places), clip_.width, clip_.height, kRidge);
      const Planes colours = to_planes(clip_.colour[static_cast<std::size_t>(frame)], 3);
      for (Base* base : places) base->coefficients.fill(base->coefficients[0]);
      for (std::size_t k = 0; k < 3; ++k) solve_plane(fit, minus(colours[k], background_[k]), places, k, 2);
    });
  }

  static std::vector<Base> copies_of(const std::vector<Base*>& places) {
    std::vector<Base> out;
    out.reserve(places.size());
    for (const Base* base : places) out.push_back(*base);
    return out;
  }

  static void solve_plane(const JointFit& fit, const Plane& target, const std::vector<Base*>& places, std::size_t plane,
                          int times) {
    std::vector<float> alpha(places.size());
    for (std::size_t j = 0; j < alpha.size(); ++j) alpha[j] = places[j]->coefficients[plane];
    for (int k = 0; k < times; ++k) alpha = fit.solve(target, alpha);
    for (std::size_t j = 0; j < alpha.size(); ++j) places[j]->coefficients[plane] = alpha[j];
  }

  /// One more coil for each cable that still gains. Whether any did.
  bool grow_one(std::vector<char>& growing) {
    std::vector<std::vector<CoilFit>> found(cables_.size());
    parallel_for(job_.jobs, static_cast<int>(cables_.size()), [&](int c) {
      job_.check_cancelled();
      const auto idx = static_cast<std::size_t>(c);
      if (growing[idx] != 0) found[idx] = coil_along(cables_[idx], neighbours_[idx]);
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

  /// The next coil of a cable in all its frames; none when it is not worth it.
  std::vector<CoilFit> coil_along(const Cable& cable, const std::vector<std::vector<Base>>& neighbours) const {
    const std::size_t num = cable.core.size();
    std::vector<CoilWindow> windows(num);
    std::vector<CoilFit> fresh(num);
    double enough = 0;
    const double weakest = options_.min_contrast * noise_;
    for (std::size_t at = 0; at < num; ++at) {
      const std::int64_t frame = cable.first_frame + static_cast<std::int64_t>(at);
      if (frame < 0 || frame >= clip_.num_frames()) continue;
      const Base& core = cable.core[at];
      const double least =
          std::max(weakest, std::sqrt(options_.min_share) * std::abs(static_cast<double>(core.coefficients[0])));
      enough += least * least;
      windows[at] = cut_window(residuals_[static_cast<std::size_t>(frame)], core, neighbours[at], options_.reach);
      fresh[at] = find_coil(windows[at], core, options_.reach, least);
    }
    const auto strongest = static_cast<std::size_t>(
        std::max_element(fresh.begin(), fresh.end(),
                         [](const CoilFit& a, const CoilFit& b) { return a.energy() < b.energy(); }) -
        fresh.begin());
    if (num == 0 || fresh[strongest].energy() == 0) return {};
    std::vector<CoilFit> out = fresh;
    for (std::size_t at = strongest + 1; at < num; ++at) out[at] = carried(cable, windows[at], out, fresh, at, at - 1);
    for (std::size_t at = strongest; at-- > 0;) out[at] = carried(cable, windows[at], out, fresh, at, at + 1);
    double energy = 0;
    for (const CoilFit& fit : out) energy += fit.energy();
    return energy < enough ? std::vector<CoilFit>() : out;
  }

  CoilFit carried(const Cable& cable, const CoilWindow& window, const std::vector<CoilFit>& coil,
                  const std::vector<CoilFit>& fresh, std::size_t at, std::size_t from) const {
    CoilFit along = carry_coil(window, cable.core[at], coil[from], cable.core[from], options_.reach);
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

  double mean_psnr() const {
    double sum = 0;
    for (const double square : squares_) sum += square;
    return psnr_of(sum);
  }
  double psnr_of_background() const {
    double sum = 0;
    for (const Plane& plane : clip_.luma)
      for (std::size_t i = 0; i < plane.values.size(); ++i)
        sum += std::pow(static_cast<double>(plane.values[i] - grey_background_.values[i]), 2);
    return psnr_of(sum);
  }
  double psnr_of(double sum) const {
    const double num = static_cast<double>(clip_.num_frames()) * clip_.width * clip_.height;
    return 10 * std::log10(255.0 * 255.0 * num / sum);
  }

  /// 1.4826 · median |residual| over every 7th pixel.
  double noise_of_residual() const {
    std::vector<float> values;
    for (const Plane& plane : residuals_)
      for (std::size_t i = 0; i < plane.values.size(); i += 7) values.push_back(std::abs(plane.values[i]));
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return std::max(kLeastNoise, 1.4826 * static_cast<double>(*middle));
  }

  void count(GrowCoilsReport& report) const {
    double num = 0, bases = 0, alone = 0;
    const std::vector<std::vector<char>> isolated = isolated_frames(cables_, options_.reach / 2);
    for (std::size_t c = 0; c < cables_.size(); ++c) {
      const auto frames = static_cast<double>(cables_[c].core.size());
      num += frames;
      bases += frames * static_cast<double>(1 + cables_[c].coils.size());
      for (const char is : isolated[c]) alone += is;
    }
    report.bases_per_moveton = num > 0 ? bases / num : 0;
    report.isolated_share = num > 0 ? alone / num : 0;
  }

  const ClipFrames& clip_;
  const Planes& background_;
  Plane grey_background_;
  std::vector<Cable>& cables_;
  const GrowCoilsOptions& options_;
  const JobContext& job_;
  std::vector<std::vector<Occupant>> frames_;
  std::vector<std::vector<std::vector<Base>>> neighbours_;  // of each cable and frame
  std::vector<Plane> residuals_;                            // luma
  std::vector<double> squares_;                             // of what is left, a frame
  double noise_ = 1;
};

}  // namespace

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
        if (std::hypot(a.x - b.x, a.y - b.y) > reach * (a.scale + b.scale)) continue;
        out[here[i]][static_cast<std::size_t>(frame - cables[here[i]].first_frame)] = 0;
        out[here[k]][static_cast<std::size_t>(frame - cables[here[k]].first_frame)] = 0;
      }
  }
  return out;
}

GrowCoilsReport grow_coils(const ClipFrames& clip, const Planes& background, std::vector<Cable>& cables,
                           const GrowCoilsOptions& options, const JobContext& job) {
  check_options(options);
  if (static_cast<int>(background.size()) != clip.num_planes())
    throw InvalidInput("the background must have as many planes as the clip");
  for (const Plane& plane : background)
    if (plane.width != clip.width || plane.height != clip.height)
      throw InvalidInput("the background must have the size of the clip");
  return CoilGrower(clip, background, cables, options, job).run();
}

}  // namespace motex
