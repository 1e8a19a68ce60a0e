// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/link_cores.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/quantile.h"
#include "motex/particles/fit_element_model.h"

namespace motex {
namespace {

constexpr double kFirstNoise = 0.3;    // pixels, before anything is learned
constexpr double kSharedByMost = 0.5;  // share that moves with the flow: a start, however dense the scene
constexpr std::size_t kSampleSights = 2000;

using SightFrames = std::vector<std::vector<Sight>>;

Sight sight_of(double x, double y, double amplitude, double scale, std::size_t frame) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(amplitude) || !std::isfinite(scale))
    throw InvalidInput("a detection in frame " + std::to_string(frame) + " is not a finite number");
  return {x,
          y,
          std::log(std::max(std::abs(amplitude), 1e-6)),
          std::log(std::max(scale, 1e-6)),
          0,
          0,
          0,
          static_cast<int>(frame)};
}

/// Median distance from a sight to the nearest of the next frame, pixels.
double nearest_distance(const SightFrames& frames) {
  std::vector<double> nearest;
  std::size_t num = 0;
  for (const auto& frame : frames) num += frame.size();
  const std::size_t stride = std::max<std::size_t>(1, num / kSampleSights);
  std::size_t k = 0;
  for (std::size_t t = 1; t < frames.size(); ++t)
    for (const Sight& a : frames[t - 1]) {
      if (k++ % stride != 0 || frames[t].empty()) continue;
      double best = 1e300;
      for (const Sight& b : frames[t]) best = std::min(best, std::hypot(a.x - b.x, a.y - b.y));
      nearest.push_back(best);
    }
  return nearest.empty() ? 1 : median(std::move(nearest));
}

LevelModel level_of(const SightFrames& frames, double Sight::*value) {
  double sum = 0, squares = 0, num = 0;
  for (const auto& frame : frames)
    for (const Sight& sight : frame) {
      sum += sight.*value;
      squares += sight.*value * (sight.*value);
      ++num;
    }
  if (num < 2) return {};
  const double mean = sum / num, variance = squares / num - mean * mean;
  if (variance < 1e-6) return {};
  return {mean, variance, 0.02 * variance, 0.2 * variance};
}

std::pair<int, int> extent_of(const SightFrames& frames, int width, int height) {
  if (width > 0 && height > 0) return {width, height};
  double right = 0, bottom = 0;
  for (const auto& frame : frames)
    for (const Sight& sight : frame) {
      right = std::max(right, sight.x);
      bottom = std::max(bottom, sight.y);
    }
  return {static_cast<int>(right) + 1, static_cast<int>(bottom) + 1};
}

/// Between two sights: place from the smoother, the rest in proportion to time.
Base between(const Base& a, const Base& b, double share) {
  Base base = share < 0.5 ? a : b;
  base.scale = std::exp((1 - share) * std::log(a.scale) + share * std::log(b.scale));
  const double amplitude = (1 - share) * peak_amplitude(a) + share * peak_amplitude(b);
  base.coefficients = {};
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, amplitude));
  return base;
}

/// A first guess of how the elements of these frames move and look.
ElementModel first_element_model(const SightFrames& frames, const FlowEstimate& flow, int width, int height) {
  ElementModel model;
  if (flow.is_trusted || flow.share > kSharedByMost) {
    model.x.mean_velocity = flow.flow.vx;
    model.y.mean_velocity = flow.flow.vy;
    model.x.start_variance = std::max(0.25, flow.spread_x * flow.spread_x);
    model.y.start_variance = std::max(0.25, flow.spread_y * flow.spread_y);
  } else {
    const double nearest = std::clamp(nearest_distance(frames), 1.0, 0.1 * std::max(width, height) + 1);
    model.x.start_variance = model.y.start_variance = nearest * nearest;
  }
  for (AxisModel* axis : {&model.x, &model.y}) {
    axis->persistence = 0.9;
    axis->step_variance = std::max(0.05, 0.15 * axis->start_variance);
    axis->noise_variance = kFirstNoise * kFirstNoise;
  }
  model.log_amplitude = level_of(frames, &Sight::log_amplitude);
  model.log_scale = level_of(frames, &Sight::log_scale);
  double num = 0;
  for (const auto& frame : frames) num += static_cast<double>(frame.size());
  const double density = std::max(num, 1.0) / (std::max(1.0, static_cast<double>(width) * height) *
                                               std::max<double>(1, static_cast<double>(frames.size())));
  model.births = 0.02 * density;
  model.entries = 0.2 * density;
  model.clutter = 0.02 * density;
  return model;
}

/// Long enough, or short because it crosses the picture's edge or an end of the clip at both of its ends.
bool is_element(const SightChain& chain, const ElementModel& model, int width, int height, int num_frames,
                int min_frames) {
  if (static_cast<int>(chain.sights.size()) >= min_frames) return true;
  const PictureEdges edges{static_cast<double>(width), static_cast<double>(height)};
  const Sight &first = chain.sights.front(), &last = chain.sights.back();
  const auto is_seen = [&](const Sight& s) { return is_inside(s.x, s.y, width, height); };
  if (std::none_of(chain.sights.begin(), chain.sights.end(), is_seen)) return false;
  return (first.frame == 0 || edges.is_entering(model, first.x, first.y)) &&
         (last.frame == num_frames - 1 || edges.is_leaving(model, last.x, last.y));
}

}  // namespace

std::vector<SightChain> link_chains(const SightFrames& frames, int width, int height, const LinkOptions& options,
                                    const ElementModel* start, LinkReport& report, const JobContext& job) {
  report = {};
  std::vector<std::vector<Base>> places(frames.size());
  for (std::size_t t = 0; t < frames.size(); ++t)
    for (const Sight& sight : frames[t]) places[t].push_back({BaseKind::kGaussian, sight.x, sight.y, 1, 0, {}});
  report.flow = estimate_flow(places, options.max_speed);
  const auto [w, h] = extent_of(frames, width, height);
  const ElementModel first = start != nullptr ? *start : first_element_model(frames, report.flow, w, h);
  LinkedSights found = link_sights(frames, first, {w, h, options.max_gap, options.sweeps}, job);
  report.model = found.model;
  report.expected_wrong_share = found.expected_wrong_share;
  report.num_links = found.num_links;
  std::vector<SightChain> chains;
  for (SightChain& chain : found.chains) {
    const int num_seen = static_cast<int>(chain.idx.size());
    if (is_element(chain, found.model, w, h, static_cast<int>(frames.size()), options.min_frames)) {
      report.confidences.push_back(chain.confidence);
      report.num_filled += chain.sights.back().frame - chain.sights.front().frame + 1 - num_seen;
      chains.push_back(std::move(chain));
    } else {
      report.num_dropped += num_seen;
    }
  }
  return chains;
}

std::vector<Cable> link_cores(const std::vector<std::vector<Base>>& frames, int width, int height,
                              const LinkOptions& options, LinkReport* report, const JobContext& job) {
  SightFrames sights(frames.size());
  for (std::size_t t = 0; t < frames.size(); ++t)
    for (const Base& base : frames[t])
      sights[t].push_back(sight_of(base.x, base.y, peak_amplitude(base), base.scale, t));
  LinkReport own;
  LinkReport& out = report != nullptr ? *report : own;
  std::vector<Cable> cables;
  for (const SightChain& chain : link_chains(sights, width, height, options, nullptr, out, job)) {
    const std::vector<SmoothedPlace> places = smooth_path(out.model, chain.sights);
    Cable cable;
    cable.first_frame = chain.sights.front().frame;
    std::size_t k = 0;
    for (std::size_t t = 0; t < places.size(); ++t) {
      const auto frame = static_cast<std::size_t>(cable.first_frame) + t;
      if (k + 1 < chain.sights.size() && chain.sights[k + 1].frame <= static_cast<int>(frame)) ++k;
      const auto base_at = [&](std::size_t i) -> const Base& {
        return frames[static_cast<std::size_t>(chain.sights[i].frame)][static_cast<std::size_t>(chain.idx[i])];
      };
      Base base = base_at(k);
      if (chain.sights[k].frame < static_cast<int>(frame)) {
        const double span = chain.sights[k + 1].frame - chain.sights[k].frame;
        base = between(base_at(k), base_at(k + 1), (static_cast<double>(frame) - chain.sights[k].frame) / span);
      }
      base.x = places[t].x;
      base.y = places[t].y;
      cable.core.push_back(base);
    }
    cables.push_back(std::move(cable));
  }
  return cables;
}

std::vector<Track> link_points(const std::vector<std::vector<TrackPoint>>& frames, int width, int height,
                               const LinkOptions& options, LinkReport* report, const JobContext& job) {
  SightFrames sights(frames.size());
  for (std::size_t t = 0; t < frames.size(); ++t)
    for (const TrackPoint& point : frames[t])
      sights[t].push_back(sight_of(point.x, point.y, point.amplitude, point.scale, t));
  LinkReport own;
  LinkReport& out = report != nullptr ? *report : own;
  std::vector<Track> tracks;
  for (const SightChain& chain : link_chains(sights, width, height, options, nullptr, out, job)) {
    const std::vector<SmoothedPlace> places = smooth_path(out.model, chain.sights);
    Track track;
    track.id = static_cast<std::int64_t>(tracks.size());
    std::size_t k = 0;
    for (std::size_t t = 0; t < places.size(); ++t) {
      const int frame = chain.sights.front().frame + static_cast<int>(t);
      while (k + 1 < chain.sights.size() && chain.sights[k + 1].frame <= frame) ++k;
      TrackPoint point =
          frames[static_cast<std::size_t>(chain.sights[k].frame)][static_cast<std::size_t>(chain.idx[k])];
      point.frame = frame;
      point.x = places[t].x;
      point.y = places[t].y;
      track.points.push_back(point);
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace motex
