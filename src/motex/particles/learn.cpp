// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/learn.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/coils.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/learn_water.h"
#include "motex/particles/mend_light.h"
#include "motex/particles/regroup.h"
#include "motex/particles/templates.h"
#include "motex/particles/track_elements.h"

namespace motex {
namespace {

void check_clip(const ClipFrames& clip) {
  if (clip.num_frames() < 3)
    throw InvalidInput("dynamics are learned from at least 3 frames; the clip has " +
                       std::to_string(clip.num_frames()));
  if (clip.width < 8 || clip.height < 8)
    throw InvalidInput("the frames must be at least 8 × 8 pixels; they are " + std::to_string(clip.width) + " × " +
                       std::to_string(clip.height));
}

/// The steps of [TM02] section 4 on one clip.
class Learning {
 public:
  Learning(const ClipFrames& clip, const LearnTexturedMotionOptions& options, const JobContext& job)
      : clip_(clip), options_(options), job_(job), background_(clip, options.background, job.part(0, 0.05)) {
    learned_.report.background_psnr = psnr_of(background_.residuals());
  }

  LearnedTexturedMotion run() {
    find_cables();
    for (int round = 0; round < options_.rounds && cores_explain_elements(); ++round) sample(round);
    if (!sampled_) mend();
    grow();
    describe_cables();
    describe_clip();
    return std::move(learned_);
  }

 private:
  /// Initial cables: detections linked.
  void find_cables() {
    TrackElementsReport report;
    model().cables = track_elements(clip_, background_, {}, job_.part(0.05, 0.4), &report);
    model().flow = report.link.flow.flow;
    seen_ = std::move(report.seen);
    learned_.report.expected_wrong_links = report.link.expected_wrong_share;
    if (model().cables.empty())
      throw InvalidInput("nothing moves in the clip that stands out from its background as an element");
    if (background_.kind() != BackgroundKind::kSmooth) {  // the elements biased it
      Plane change = std::move(report.background);
      const Plane before = luma(background_.still());
      for (std::size_t i = 0; i < change.values.size(); ++i) change.values[i] -= before.values[i];
      background_.shift(clip_, change, job_.jobs);
    }
    add_round(0);
  }

  /// Amplitudes of linked cables. The sampler finds them itself, and would cut paths off where they begin faint.
  void mend() {
    mend_light(background_.residuals(), model().cables, job_.jobs);
    learned_.report.rounds.clear();
    add_round(0);
  }

  /// Steps 1 and 2 of the paper's loop: cables drawn from their posterior, dynamics, rates and noise regressed on them.
  void sample(int round) {
    EstimatePriorOptions prior_options;
    prior_options.noise = model().noise;
    prior_options.num_frames = clip_.num_frames();
    const CablePrior prior = estimate_prior(model().cables, clip_.width, clip_.height, prior_options);
    SampleCablesOptions sample_options;
    sample_options.sweeps = options_.sweeps;
    sample_options.search_sweeps = options_.sweeps / 3;
    sample_options.learn_sweeps = options_.sweeps / 2;
    sample_options.static_background = background_.kind() != BackgroundKind::kSmooth;
    sample_options.seed = options_.seed + static_cast<std::uint64_t>(round);
    const double share = 0.3 / options_.rounds;
    SampleCablesReport sampled = sample_cables(background_.residuals(), model().cables, prior, sample_options,
                                               job_.part(0.4 + share * round, 0.4 + share * (round + 1)));
    if (sampled.cables.empty()) return;
    model().cables = std::move(sampled.cables);
    sampled_ = true;
    if (sample_options.static_background) background_.shift(clip_, sampled.background_change, job_.jobs);
    add_moves(sampled.moves);
    std::vector<double>& trace = learned_.report.log_posterior_trace;
    trace.insert(trace.end(), sampled.log_posterior_trace.begin(), sampled.log_posterior_trace.end());
    add_round(trace.empty() ? 0 : trace.back());
  }

  /// Whether background and cores leave little but noise. Where elements have parts (wings), the sampler, which knows
  /// cores alone, would explain the parts by elements of their own and move cores towards them: linked cables stay.
  bool cores_explain_elements() const {
    constexpr double kMostMisfit = 1.3;
    const LearnRound& last = learned_.report.rounds.back();
    return 255 * std::pow(10.0, -last.psnr / 20) < kMostMisfit * last.noise;
  }

  void add_moves(const std::vector<MoveCount>& moves) {
    std::vector<MoveCount>& sums = learned_.report.moves;
    if (sums.empty()) {
      sums = moves;
      return;
    }
    for (std::size_t k = 0; k < moves.size(); ++k) {
      sums[k].proposed += moves[k].proposed;
      sums[k].accepted += moves[k].accepted;
    }
  }

  /// Coils and colours along the cables.
  void grow() {
    GrowCoilsOptions grow_options;
    if (!options_.coils) grow_options.max_coils = 0;
    grow_coils(clip_, background_.still(), moving_residuals(), model().cables, grow_options, job_.part(0.7, 0.9));
    background_.refresh(clip_, model().cables, job_);
  }

  /// Where the background is not the same in all frames.
  std::vector<Plane> moving_residuals() const {
    return background_.kind() == BackgroundKind::kSmooth ? background_.residuals() : std::vector<Plane>();
  }

  /// Species, their poses and dynamics; sources and sinks.
  void describe_cables() {
    TexturedMotion& out = model();
    LearnTemplatesOptions template_options;
    template_options.seed = options_.seed;
    out.templates = learn_templates(out.cables, clip_.num_planes(), template_options, job_.part(0.9, 0.92));
    if (options_.coils) {  // each moveton again, by the bases of its own shape
      regroup_coils(clip_, background_.still(), moving_residuals(), out.cables, {}, job_.part(0.92, 0.94));
      out.templates = learn_templates(out.cables, clip_.num_planes(), template_options, job_.part(0.94, 0.95));
    }
    for (std::size_t k = 0; k < out.templates.size(); ++k) out.dynamics.push_back(dynamics_of(static_cast<int>(k)));
    out.maps = estimate_maps(out.cables, clip_.width, clip_.height, clip_.num_frames());
  }

  MovetonDynamics dynamics_of(int species) {
    std::vector<Cable> cores;
    for (std::size_t k = 0; k < model().cables.size(); ++k) {
      const Cable& cable = model().cables[k];
      if (cable.species != species) continue;
      Cable& one = cores.emplace_back();
      one.first_frame = cable.first_frame;
      one.core = cable.core;
      for (std::size_t t = 0; t < one.core.size(); ++t) {
        Base& base = one.core[t];
        base.coefficients[0] = static_cast<float>(luma_coefficient(base, clip_.num_planes()));
        if (sampled_) continue;
        base.x = seen_[k].core[t].x;
        base.y = seen_[k].core[t].y;
      }
    }
    FitDynamicsOptions fit_options;
    fit_options.estimate_errors = !sampled_;
    return fit_dynamics(cores, fit_options);
  }

  void describe_clip() {
    TexturedMotion& out = model();
    out.width = clip_.width;
    out.height = clip_.height;
    out.num_planes = clip_.num_planes();
    out.frames_per_sec = clip_.frames_per_sec;
    out.num_frames = clip_.num_frames();
    out.seed = options_.seed;
    out.background = background_.still();
    out.background_kind = background_.kind();
  }

  void add_round(double log_posterior) {
    std::vector<Plane> left = background_.residuals();
    subtract_cables(left, model().cables, job_.jobs);
    model().noise = noise_of(left);
    learned_.report.rounds.push_back(
        {psnr_of(left), model().noise, log_posterior, static_cast<int>(model().cables.size())});
  }

  TexturedMotion& model() { return learned_.model; }

  const ClipFrames& clip_;
  const LearnTexturedMotionOptions& options_;
  const JobContext& job_;
  ClipBackground background_;
  LearnedTexturedMotion learned_;
  std::vector<Cable> seen_;  ///< the linked cables where the picture shows them (TrackElementsReport::seen)
  bool sampled_ = false;     ///< cables are a sample of the chain, not linked detections
};

/// Water has no cores: its bases are carried.
LearnedTexturedMotion learned_from_water(const ClipFrames& clip, const LearnTexturedMotionOptions& options,
                                         const JobContext& job) {
  LearnedWater water = learn_water(clip, {}, job);
  LearnedTexturedMotion out;
  out.report.background_psnr = water.carry.background_psnr;
  out.report.bases_per_frame = water.carry.bases_per_frame;
  out.report.rounds.push_back({water.carry.psnr, water.light, 0, static_cast<int>(water.model.cables.size())});
  out.model = std::move(water.model);
  out.model.seed = options.seed;
  return out;
}

}  // namespace

LearnedTexturedMotion learn_textured_motion(const ClipFrames& clip, const LearnTexturedMotionOptions& options,
                                            const JobContext& job) {
  check_options(options);
  check_clip(clip);
  const bool is_water = options.tracking == TrackingKind::kCarry ||
                        (options.tracking == TrackingKind::kAuto && looks_like_water(clip, job));
  if (is_water) return learned_from_water(clip, options, job);
  return Learning(clip, options, job).run();
}

}  // namespace motex
