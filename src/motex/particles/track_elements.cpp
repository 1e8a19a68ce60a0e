// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/track_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/particles/burst_starts.h"
#include "motex/particles/detect_shaped.h"
#include "motex/particles/expectations.h"
#include "motex/particles/paths_of_parts.h"

namespace motex {
namespace {

constexpr std::size_t kBackgroundFrames = 31;  // that the background is re-estimated from
constexpr int kReachOut = 2;                   // frames before and after a path where it is looked for
constexpr int kFarthest = 16;                  // frames before and after it where its place is known well
constexpr int kReachOutShaped = 6;             // always, for elements whose shapes are known
constexpr int kLongerGap = 2;                  // times the frames that these may go unseen: they cover one another
constexpr int kShapedRounds = 3;
constexpr int kShapePasses = 2;
constexpr double kNearlyAsLong = 0.9;  // paths of whole elements stay unless they are in more pieces than before
constexpr double kCoarse = 0.97;  // share of light explained, below which shapes are learned again from what they found
constexpr double kHasParts = 0.06;      // shape_misfit from which elements are no single spots
constexpr double kWellExplained = 0.8;  // share of their light that shapes must explain to be used
constexpr double kWellSeen = 0.5;       // pixels
constexpr double kCrowd = 100;          // elements a frame from which those that stand alone are odd ones

void check(const ClipFrames& frames, const Plane& background) {
  if (frames.luma.empty()) throw InvalidInput("tracking needs at least one frame");
  for (const Plane& plane : frames.luma)
    if (plane.width != background.width || plane.height != background.height || plane.values.empty())
      throw InvalidInput("the frames and the background of a clip must have one size");
}

std::vector<std::vector<Sight>> sights_of(const BlobFrames& blobs) {
  std::vector<std::vector<Sight>> sights(blobs.size());
  for (std::size_t t = 0; t < blobs.size(); ++t)
    for (const Blob& blob : blobs[t]) sights[t].push_back(sight_of(blob, static_cast<int>(t)));
  return sights;
}

/// What all frames keep in common when the elements are taken off belongs to the background.
void improve_background(const std::vector<Plane>& left, Plane& background) {
  const std::size_t num = std::min(kBackgroundFrames, left.size());
  if (num < 5) return;
  std::vector<float> column(num);
  for (std::size_t i = 0; i < background.values.size(); ++i) {
    for (std::size_t k = 0; k < num; ++k) column[k] = left[(2 * k + 1) * left.size() / (2 * num)].values[i];
    const auto middle = column.begin() + static_cast<std::ptrdiff_t>(num / 2);
    std::nth_element(column.begin(), middle, column.end());
    background.values[i] += *middle;
  }
}

/// Between two sights: looks in proportion to time.
Blob between(const Blob& a, const Blob& b, double share) {
  Blob out = a;
  const auto mix = [&](double Blob::*field) { out.*field = (1 - share) * (a.*field) + share * (b.*field); };
  mix(&Blob::log_scale);
  mix(&Blob::e1);
  mix(&Blob::e2);
  mix(&Blob::amplitude);
  return out;
}

/// Of the angles that are the same modulo π the one nearest to `before`.
double unwrapped(double angle, double before) {
  return angle + std::numbers::pi * std::round((before - angle) / std::numbers::pi);
}

Cable cable_of(const SightChain& chain, const BlobFrames& blobs, const ElementModel& model) {
  const std::vector<SmoothedPlace> places = smooth_path(model, chain.sights);
  std::vector<Blob> path;
  std::vector<double> aspects;
  std::size_t k = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int frame = chain.sights.front().frame + static_cast<int>(i);
    while (k + 1 < chain.sights.size() && chain.sights[k + 1].frame <= frame) ++k;
    Blob blob = blob_at(blobs, chain, k);
    const int since = frame - chain.sights[k].frame;
    if (since > 0)
      blob = between(blob, blob_at(blobs, chain, k + 1),
                     static_cast<double>(since) / (chain.sights[k + 1].frame - chain.sights[k].frame));
    blob.x = places[i].x;
    blob.y = places[i].y;
    path.push_back(blob);
    aspects.push_back(blob.aspect());
  }
  // One kind for the whole life of an element.
  const BaseKind kind = core_kind(median(aspects));
  Cable cable;
  cable.first_frame = chain.sights.front().frame;
  double before = 0;
  for (const Blob& blob : path) {
    Base base = core_of(blob, kind);
    if (is_oriented(kind) && !cable.core.empty()) base.angle = unwrapped(base.angle, before);
    before = base.angle;
    cable.core.push_back(base);
  }
  return cable;
}

/// With the places that the picture alone shows, where it shows them.
Cable as_seen(Cable cable, const SightChain& chain, const BlobFrames& blobs) {
  for (std::size_t k = 0; k < chain.sights.size(); ++k) {
    const Blob& blob = blob_at(blobs, chain, k);
    Base& base = cable.core[static_cast<std::size_t>(chain.sights[k].frame - cable.first_frame)];
    if (blob.seen_spread > kWellSeen) continue;
    base.x = blob.seen_x;
    base.y = blob.seen_y;
  }
  return cable;
}

double sights_per_frame(const BlobFrames& blobs) {
  double sum = 0;
  for (const auto& frame : blobs) sum += static_cast<double>(frame.size());
  return sum / static_cast<double>(blobs.size());
}

/// Frames of the path that a sight is on, on average: paths in pieces are shorter.
double mean_length(const std::vector<SightChain>& chains) {
  double sum = 0, num = 0;
  for (const SightChain& chain : chains) {
    const double length = chain.sights.back().frame - chain.sights.front().frame + 1;
    sum += length * length;
    num += length;
  }
  return num > 0 ? sum / num : 0;
}

/// The rounds of track_elements().
class Tracker {
 public:
  /// residuals: frames minus the background of each; empty = `background` is that of all.
  Tracker(const ClipFrames& clip, const Plane& background, std::vector<Plane> residuals, double noise,
          const TrackElementsOptions& options, const JobContext& job)
      : clip_(clip),
        options_(options),
        job_(job),
        given_noise_(noise),
        is_still_(residuals.empty()),
        residuals_(std::move(residuals)) {
    now_.background = background;
    subtract_background();
    now_.noise = noise > 0 ? noise : noise_of(residuals_);
    detect_ = decided(options.detect, residuals_, now_.noise);
    now_.blobs.resize(clip.luma.size());
    now_.left.resize(clip.luma.size());
  }

  std::vector<Cable> run(TrackElementsReport& report) {
    follow(options_.rounds);
    for (int pass = 0; pass < kShapePasses && needs_shapes() && learn_shapes(); ++pass) {
      Followed spots = now_;
      now_.chains.clear();  // paths of single spots say little of elements with parts
      renew_background();
      follow(kShapedRounds);
      if (mean_length(now_.chains) < kNearlyAsLong * mean_length(spots.chains)) {
        now_ = std::move(spots);
        break;
      }
    }
    report.detections_per_frame = sights_per_frame(now_.blobs);
    std::vector<Cable> cables = finished(report);
    report.link = std::move(now_.link);
    report.link.confidences.clear();
    for (const SightChain& chain : now_.chains) report.link.confidences.push_back(chain.confidence);
    report.detect = detect_;
    report.background = std::move(now_.background);
    report.noise = now_.noise;
    return cables;
  }

 private:
  /// What following came to.
  struct Followed {
    BlobFrames blobs;
    std::vector<Plane> left;
    std::vector<SightChain> chains;
    LinkReport link;
    Plane background;
    double noise = 0;
  };

  void subtract_background() {
    if (!is_still_) return;
    residuals_.resize(clip_.luma.size());
    parallel_for(job_.jobs, clip_.num_frames(), [&](int t) {
      residuals_[static_cast<std::size_t>(t)] = minus(clip_.luma[static_cast<std::size_t>(t)], now_.background);
    });
  }

  void renew_background() {
    if (is_still_) improve_background(now_.left, now_.background);
    subtract_background();
    if (given_noise_ <= 0) now_.noise = noise_of(now_.left);
  }

  void follow(int num_rounds) {
    for (int round = 0; round < num_rounds; ++round) {
      job_.check_cancelled();
      job_.progress("tracking elements", static_cast<double>(num_looks_) / (options_.rounds + kShapedRounds));
      look();
      link();
      if (round + 1 < num_rounds) renew_background();
    }
    if (given_noise_ <= 0) now_.noise = noise_of(now_.left);
  }

  bool has_shapes() const { return !shapes_.shapes.empty(); }

  /// Elements of each frame, where paths lead first.
  void look() {
    std::vector<std::size_t> num_found;
    for (const auto& frame : now_.blobs) num_found.push_back(frame.size());
    start_in_bursts(now_.chains, now_.blobs, now_.link.model);
    Expectations expected(now_.blobs, std::move(num_found), now_.link.model,
                          {clip_.width, clip_.height, detect_.shape == CoreShape::kOriented,
                           has_shapes() ? kReachOutShaped : kReachOut, kFarthest});
    for (const SightChain& chain : now_.chains) expected.add(chain);
    BlobFrames found(now_.blobs.size());
    parallel_for(job_.jobs, clip_.num_frames(), [&](int t) {
      job_.check_cancelled();
      const auto k = static_cast<std::size_t>(t);
      found[k] = has_shapes()
                     ? detect_shaped_blobs(residuals_[k], shapes_, detect_, now_.noise, expected.at(t), &now_.left[k])
                     : detect_blobs(residuals_[k], now_.noise, detect_, expected.at(t), &now_.left[k]);
    });
    now_.blobs = std::move(found);
  }

  void link() {
    const ElementModel before = now_.link.model;
    LinkOptions options = options_.link;
    if (has_shapes()) options.max_gap *= kLongerGap;
    now_.chains = link_chains(sights_of(now_.blobs), clip_.width, clip_.height, options,
                              num_looks_++ > 0 ? &before : nullptr, now_.link, job_);
    if (has_shapes())
      drop_paths_of_parts(now_.chains, now_.blobs, now_.link.model, clip_.width, clip_.height, shapes_.are_turned());
  }

  /// Shapes learned from spots may be mixed with neighbours that the spots did not tell apart.
  bool needs_shapes() const { return !has_shapes() || shapes_.explained < kCoarse; }

  bool learn_shapes() {
    if (detect_.shape_misfit <= kHasParts || sights_per_frame(now_.blobs) >= kCrowd) return false;
    shapes_ = learn_element_shapes(residuals_, now_.blobs, now_.chains, now_.noise);
    if (shapes_.explained < kWellExplained) shapes_.shapes.clear();
    return has_shapes();
  }

  std::vector<Cable> finished(TrackElementsReport& report) {
    std::vector<BurstStart> starts = start_in_bursts(now_.chains, now_.blobs, now_.link.model);
    drop_pieces_of_bursts(now_.chains, now_.blobs, starts);
    std::vector<Cable> cables;
    for (const SightChain& chain : now_.chains) {
      cables.push_back(cable_of(chain, now_.blobs, now_.link.model));
      report.seen.push_back(as_seen(cables.back(), chain, now_.blobs));
    }
    share_light(starts, now_.left, cables);
    return cables;
  }

  const ClipFrames& clip_;
  const TrackElementsOptions& options_;
  const JobContext& job_;
  double given_noise_;
  bool is_still_;  ///< one background for all frames
  int num_looks_ = 0;
  DetectOptions detect_;
  std::vector<Plane> residuals_;
  ElementShapes shapes_;
  Followed now_;
};

std::vector<Cable> tracked(const ClipFrames& frames, const Plane& background, std::vector<Plane> residuals,
                           double noise, const TrackElementsOptions& options, const JobContext& job,
                           TrackElementsReport* report) {
  check(frames, background);
  TrackElementsReport own;
  TrackElementsReport& out = report != nullptr ? *report : own;
  out = {};
  std::vector<Cable> cables = Tracker(frames, background, std::move(residuals), noise, options, job).run(out);
  job.progress("tracking elements", 1);
  return cables;
}

}  // namespace

Sight sight_of(const Blob& blob, int frame) {
  const double amplitude = std::max(std::abs(blob.amplitude), 1e-6), relative = blob.amplitude_spread / amplitude;
  return {blob.x,
          blob.y,
          std::log(amplitude),
          blob.log_scale,
          blob.place_spread * blob.place_spread,
          relative * relative,
          blob.log_scale_spread * blob.log_scale_spread,
          frame};
}

std::vector<Cable> track_elements(const ClipFrames& frames, const Plane& background, double noise,
                                  const TrackElementsOptions& options, const JobContext& job,
                                  TrackElementsReport* report) {
  return tracked(frames, background, {}, noise, options, job, report);
}

std::vector<Cable> track_elements(const ClipFrames& frames, const ClipBackground& background,
                                  const TrackElementsOptions& options, const JobContext& job,
                                  TrackElementsReport* report) {
  const bool is_still = background.kind() != BackgroundKind::kSmooth;
  return tracked(frames, luma(background.still()), is_still ? std::vector<Plane>() : background.residuals(), 0, options,
                 job, report);
}

}  // namespace motex
