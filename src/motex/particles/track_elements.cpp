// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/track_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/particles/detect_shaped.h"
#include "motex/particles/fit_element_model.h"

namespace motex {
namespace {

constexpr std::size_t kBackgroundFrames = 31;  // that the background is re-estimated from
constexpr std::size_t kSureLength = 4;         // sights that a path needs before it says what to expect
constexpr int kReachOut = 2;                   // frames before and after a path where it is looked for
constexpr int kReachOutShaped = 6;             // the same for elements whose shapes are known
constexpr int kShapedRounds = 3;
constexpr int kLeastInside = 2;           // sights of an element with parts that are whole inside the picture
constexpr std::size_t kLongestPart = 16;  // sights of a path that may be a part's
constexpr double kBeside = 4.5;           // core scales
constexpr double kHasParts = 0.06;        // shape_misfit from which elements are no single spots
constexpr double kWellExplained = 0.8;    // share of their light that shapes must explain to be used
constexpr double kCrowd = 100;            // elements a frame from which those that stand alone are odd ones
constexpr double kWidening = 1.5;         // of the deviations expected: paths may be wrong

using BlobFrames = std::vector<std::vector<Blob>>;

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

/// One frame of a cable on the way to its base.
const Blob& blob_at(const BlobFrames& blobs, const SightChain& chain, std::size_t k) {
  return blobs[static_cast<std::size_t>(chain.sights[k].frame)][static_cast<std::size_t>(chain.idx[k])];
}

/// Looks and places that a path leads one to expect, into the frames it crosses.
class Expectations {
 public:
  Expectations(const BlobFrames& blobs, const ElementModel& model, int width, int height, bool is_oriented,
               int reach_out)
      : blobs_(blobs),
        model_(model),
        width_(width),
        height_(height),
        is_oriented_(is_oriented),
        reach_out_(reach_out),
        frames_(blobs.size()) {}

  void add(const SightChain& chain) {
    const bool is_sure = chain.sights.size() >= kSureLength;
    const int last_frame = static_cast<int>(frames_.size()) - 1;
    const int before = is_sure ? std::min(reach_out_, chain.sights.front().frame) : 0,
              after = is_sure ? std::min(reach_out_, last_frame - chain.sights.back().frame) : 0;
    const std::vector<SmoothedPlace> places = smooth_path(model_, chain.sights, before, after);
    const int first = chain.sights.front().frame - before;
    std::size_t k = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const int frame = first + static_cast<int>(i);
      while (k + 1 < chain.sights.size() && chain.sights[k + 1].frame <= frame) ++k;
      ExpectedBlob one;
      one.blob = blob_at(blobs_, chain, k);
      one.is_seen = chain.sights[k].frame == frame;
      if (is_sure) set_prior(chain, places[i], k, one);
      if (!one.is_seen && !is_inside(places[i].x, places[i].y, width_, height_)) continue;
      frames_[static_cast<std::size_t>(frame)].push_back(one);
    }
  }

  const std::vector<ExpectedBlob>& at(int frame) const { return frames_[static_cast<std::size_t>(frame)]; }

 private:
  /// Typical of the sights of the path near k, and how much single ones differ.
  double typical(const SightChain& chain, std::size_t k, double Blob::*field, double& deviation) const {
    std::vector<double> values;
    const std::size_t first = k > 7 ? k - 7 : 0, end = std::min(chain.idx.size(), k + 8);
    for (std::size_t i = first; i < end; ++i) values.push_back(blob_at(blobs_, chain, i).*field);
    const double middle = median(values);
    for (double& value : values) value = std::abs(value - middle);
    deviation = 1.4826 * median(values);
    return middle;
  }

  void set_prior(const SightChain& chain, const SmoothedPlace& place, std::size_t k, ExpectedBlob& one) const {
    double scale_spread = 0, amplitude_spread = 0;
    const double log_scale = typical(chain, k, &Blob::log_scale, scale_spread);
    const double amplitude = typical(chain, k, &Blob::amplitude, amplitude_spread);
    scale_spread = std::max(0.04, kWidening * scale_spread);
    amplitude_spread = std::max(0.05 * std::abs(amplitude), kWidening * amplitude_spread);
    const double wider = kWidening * kWidening;
    const double vx = 0.01 + wider * place.others_variance_x, vy = 0.01 + wider * place.others_variance_y;
    one.prior.mean = {place.others_x, place.others_y, log_scale, 0, 0, amplitude};
    one.prior.precision = {1 / vx, 1 / vy, 1 / (scale_spread * scale_spread),
                           0,      0,      1 / (amplitude_spread * amplitude_spread)};
    if (is_oriented_)
      for (const std::size_t p : {std::size_t{3}, std::size_t{4}}) {
        double spread = 0;
        one.prior.mean[p] = typical(chain, k, p == 3 ? &Blob::e1 : &Blob::e2, spread);
        one.prior.precision[p] = 1 / std::max(0.04, wider * spread * spread);
      }
    if (one.is_seen) return;
    one.blob.x = place.x;
    one.blob.y = place.y;
    one.blob.log_scale = log_scale;
    one.blob.amplitude = amplitude;
  }

  const BlobFrames& blobs_;
  const ElementModel& model_;
  int width_, height_;
  bool is_oriented_;
  int reach_out_;
  std::vector<std::vector<ExpectedBlob>> frames_;
};

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

/// Of elements with parts, paths that are none: of what reaches into the picture while the core stays outside, and
/// short ones that begin and end beside longer ones, inside the picture.
class PathsOfParts {
 public:
  PathsOfParts(const BlobFrames& blobs, const ElementModel& model, int width, int height)
      : blobs_(blobs), model_(model), edges_{static_cast<double>(width), static_cast<double>(height)} {}

  void drop(std::vector<SightChain>& chains) const {
    std::vector<SightChain> kept;
    for (const SightChain& chain : chains)
      if (num_inside(chain) >= kLeastInside && !goes_beside(chain, chains)) kept.push_back(chain);
    chains = std::move(kept);
  }

 private:
  int num_inside(const SightChain& chain) const {
    int num = 0;
    for (std::size_t k = 0; k < chain.sights.size(); ++k) {
      const Blob& blob = blob_at(blobs_, chain, k);
      const double rim = blob.scale();
      num +=
          blob.x > rim && blob.y > rim && blob.x < edges_.width - 1 - rim && blob.y < edges_.height - 1 - rim ? 1 : 0;
    }
    return num;
  }

  /// From a sight to where the path is in its frame, also where that is not seen.
  static double distance(const SightChain& path, const Sight& sight) {
    const auto after = std::lower_bound(path.sights.begin(), path.sights.end(), sight.frame,
                                        [](const Sight& one, int frame) { return one.frame < frame; });
    if (after == path.sights.end() || (after == path.sights.begin() && after->frame != sight.frame)) return 1e300;
    const auto before = after->frame == sight.frame ? after : after - 1;
    const double share =
        after == before ? 0 : static_cast<double>(sight.frame - before->frame) / (after->frame - before->frame);
    return std::hypot((1 - share) * before->x + share * after->x - sight.x,
                      (1 - share) * before->y + share * after->y - sight.y);
  }

  bool goes_beside(const SightChain& chain, const std::vector<SightChain>& chains) const {
    const std::size_t num = chain.sights.size();
    if (num > kLongestPart) return false;
    const Sight &first = chain.sights.front(), &last = chain.sights.back();
    const bool comes_in = edges_.is_entering(model_, first.x, first.y) || first.frame == 0;
    const bool goes_out =
        edges_.is_leaving(model_, last.x, last.y) || last.frame + 1 == static_cast<int>(blobs_.size());
    if (comes_in && goes_out) return false;
    std::size_t num_beside = 0;
    for (std::size_t k = 0; k < num; ++k) {
      const double reach = kBeside * blob_at(blobs_, chain, k).scale();
      const bool is_beside = std::any_of(chains.begin(), chains.end(), [&](const SightChain& other) {
        return other.sights.size() > 2 * num && distance(other, chain.sights[k]) < reach;
      });
      num_beside += is_beside ? 1 : 0;
    }
    return 2 * num_beside > num;
  }

  const BlobFrames& blobs_;
  const ElementModel& model_;
  PictureEdges edges_;
};

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
    if (kind == BaseKind::kGaborCos && !cable.core.empty()) base.angle = unwrapped(base.angle, before);
    before = base.angle;
    cable.core.push_back(base);
  }
  return cable;
}

/// What one way of following came to.
struct Followed {
  BlobFrames blobs;
  std::vector<SightChain> chains;
  LinkReport link;
  Plane background;
  double noise = 0;
};

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
  check(frames, background);
  TrackElementsReport own;
  TrackElementsReport& out = report != nullptr ? *report : own;
  out = {};
  out.background = background;
  const int num_frames = frames.num_frames();
  std::vector<Plane> residuals(frames.luma.size()), left(frames.luma.size());
  const auto subtract_background = [&] {
    parallel_for(job.jobs, num_frames, [&](int t) {
      residuals[static_cast<std::size_t>(t)] = minus(frames.luma[static_cast<std::size_t>(t)], out.background);
    });
  };
  subtract_background();
  out.noise = noise > 0 ? noise : noise_of(residuals);
  out.detect = decided(options.detect, residuals, out.noise);
  BlobFrames blobs(frames.luma.size());
  std::vector<SightChain> chains;
  ElementShapes shapes;
  Followed spots;  // before shapes were known
  int num_rounds = options.rounds;
  for (int round = 0; round < num_rounds; ++round) {
    job.check_cancelled();
    job.progress("tracking elements", static_cast<double>(round) / (options.rounds + kShapedRounds));
    if (round == options.rounds) chains.clear();  // paths of single spots say little of elements with parts
    Expectations expected(blobs, out.link.model, frames.width, frames.height, out.detect.shape == CoreShape::kOriented,
                          shapes.shapes.empty() ? kReachOut : kReachOutShaped);
    for (const SightChain& chain : chains) expected.add(chain);
    BlobFrames found(blobs.size());
    parallel_for(job.jobs, num_frames, [&](int t) {
      job.check_cancelled();
      const auto k = static_cast<std::size_t>(t);
      found[k] = shapes.shapes.empty()
                     ? detect_blobs(residuals[k], out.noise, out.detect, expected.at(t), &left[k])
                     : detect_shaped_blobs(residuals[k], shapes, out.detect, out.noise, expected.at(t), &left[k]);
    });
    blobs = std::move(found);
    const ElementModel before = out.link.model;
    chains = link_chains(sights_of(blobs), frames.width, frames.height, options.link, round > 0 ? &before : nullptr,
                         out.link);
    if (!shapes.shapes.empty()) PathsOfParts(blobs, out.link.model, frames.width, frames.height).drop(chains);
    if (round + 1 == options.rounds && out.detect.shape_misfit > kHasParts && sights_per_frame(blobs) < kCrowd) {
      shapes = learn_element_shapes(residuals, blobs, chains, out.noise);
      if (shapes.explained < kWellExplained) shapes.shapes.clear();
      if (!shapes.shapes.empty()) {
        num_rounds += kShapedRounds;
        spots = {blobs, chains, out.link, out.background, noise > 0 ? noise : noise_of(left)};
      }
    }
    if (round + 1 == num_rounds) break;
    improve_background(left, out.background);
    subtract_background();
    if (noise <= 0) out.noise = noise_of(left);
  }
  if (noise <= 0) out.noise = noise_of(left);
  if (!shapes.shapes.empty() && mean_length(chains) < mean_length(spots.chains)) {
    blobs = std::move(spots.blobs);
    chains = std::move(spots.chains);
    out.link = std::move(spots.link);
    out.background = std::move(spots.background);
    out.noise = spots.noise;
  }
  std::vector<Cable> cables;
  for (const SightChain& chain : chains) cables.push_back(cable_of(chain, blobs, out.link.model));
  out.detections_per_frame = sights_per_frame(blobs);
  job.progress("tracking elements", 1);
  return cables;
}

}  // namespace motex
