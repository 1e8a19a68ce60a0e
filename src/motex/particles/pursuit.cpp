// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/pursuit.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/particles/refine.h"
#include "motex/particles/response_tiles.h"

namespace motex {
namespace {

class Pursuit {
 public:
  Pursuit(const Planes& target, const PursueOptions& options, const JobContext& job)
      : target_(target),
        options_(options),
        job_(job),
        residual_(luma(target)),
        tiles_(options.dictionary, residual_.width, residual_.height) {
    tiles_.set_residual(residual_);
  }

  /// Finds bases until there are `count`.
  void grow(int count, int last_count) {
    constexpr int kMostRejections = 500;
    int num_rejected = 0;
    while (!exhausted_ && static_cast<int>(fitted_.size()) < count) {
      job_.check_cancelled();
      if (fitted_.size() % 50 == 0) job_.progress("matching pursuit", static_cast<double>(fitted_.size()) / last_count);
      float response = 0;
      const Base found = tiles_.strongest(response);
      exhausted_ = !(std::abs(response) > options_.min_coefficient) || num_rejected > kMostRejections;
      if (exhausted_) break;
      FittedBase base = refine_base(residual_, found, options_.refine_steps);
      if (!(std::abs(base.coefficient) > std::max(options_.min_coefficient, 0.5 * std::abs(response)))) {
        tiles_.reject_strongest();
        ++num_rejected;
        continue;
      }
      num_rejected = 0;
      add_patch(residual_, base.patch, -base.coefficient);
      tiles_.changed(residual_, base.patch);
      fitted_.push_back(std::move(base));
    }
  }

  /// Fits all bases again and solves for their coefficients together.
  BaseMap settle() {
    for (int round = 0; round < options_.refine_rounds && options_.refine_steps > 0; ++round) {
      refit_coefficients();
      for (FittedBase& base : fitted_) {
        job_.check_cancelled();
        add_patch(residual_, base.patch, base.coefficient);
        FittedBase again = refine_base(residual_, base.base, options_.refine_steps);
        if (std::abs(again.coefficient) > 0) base = std::move(again);
        add_patch(residual_, base.patch, -base.coefficient);
      }
    }
    refit_coefficients();
    tiles_.set_residual(residual_);
    return map();
  }

 private:
  std::vector<BasePatch> patches() const {
    std::vector<BasePatch> out;
    for (const FittedBase& base : fitted_) out.push_back(base.patch);
    return out;
  }

  void refit_coefficients() {
    std::vector<float> coefficients;
    for (const FittedBase& base : fitted_) coefficients.push_back(base.coefficient);
    coefficients = fit_coefficients(luma(target_), patches(), coefficients);
    residual_ = luma(target_);
    for (std::size_t j = 0; j < fitted_.size(); ++j) {
      fitted_[j].coefficient = coefficients[j];
      add_patch(residual_, fitted_[j].patch, -coefficients[j]);
    }
  }

  BaseMap map() const {
    BaseMap out{residual_.width, residual_.height, static_cast<int>(target_.size()), {}};
    std::vector<float> grey;
    for (const FittedBase& base : fitted_) {
      out.bases.push_back(base.base);
      grey.push_back(base.coefficient);
    }
    const std::vector<BasePatch> all = target_.size() > 1 ? patches() : std::vector<BasePatch>();
    for (std::size_t k = 0; k < target_.size(); ++k) {
      const std::vector<float> fit = target_.size() > 1 ? fit_coefficients(target_[k], all, grey) : grey;
      for (std::size_t j = 0; j < fit.size(); ++j) out.bases[j].coefficients[k] = fit[j];
    }
    return out;
  }

  const Planes& target_;
  const PursueOptions& options_;
  const JobContext& job_;
  Plane residual_;
  ResponseTiles tiles_;
  std::vector<FittedBase> fitted_;
  bool exhausted_ = false;
};

void check_target(const Planes& target, const std::vector<int>& counts) {
  if (target.size() != 1 && target.size() != 3) throw InvalidInput("bases are found in images of one or three planes");
  for (const Plane& plane : target) {
    if (plane.width != target[0].width || plane.height != target[0].height || plane.values.empty())
      throw InvalidInput("the planes of the image must have one size and not be empty");
    for (const float value : plane.values)
      if (!std::isfinite(value)) throw NumericalFailure("the image has values that are no numbers");
  }
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k] < 1 || (k > 0 && counts[k] <= counts[k - 1]))
      throw InvalidInput("the numbers of bases must rise and be at least 1");
}

}  // namespace

std::vector<BaseMap> pursue_stages(const Planes& target, const std::vector<int>& counts, const PursueOptions& options,
                                   const JobContext& job) {
  check_options(options);
  check_target(target, counts);
  std::vector<BaseMap> maps;
  if (counts.empty()) return maps;
  Pursuit pursuit(target, options, job);
  for (const int count : counts) {
    pursuit.grow(count, counts.back());
    maps.push_back(pursuit.settle());
  }
  job.progress("matching pursuit", 1);
  return maps;
}

BaseMap pursue(const Planes& target, const PursueOptions& options, const JobContext& job) {
  return pursue_stages(target, {options.num_bases}, options, job).at(0);
}

}  // namespace motex
