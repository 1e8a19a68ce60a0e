// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/beats.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/quantile.h"
#include "motex/motion_texture/jumps.h"

namespace motex {
namespace {

constexpr std::size_t kMostBeats = 20000;
constexpr double kOffBeatCost = 6;
constexpr double kFar = 1.0, kFill = 0.25;  // s: where beats are farther apart, there are moments between them
constexpr double kPatience = 0.9;
constexpr double kReach = 2.5;  // times the usual stretch that is looked at for a beat
constexpr Index kFewestFrames = 4;

/// Frames from the beginning of an example to that of the next, as in the source.
Index own_length(const MotionTexture& model, const Instance& instance) {
  return hand_over_row(model, instance) - instance.row;
}

}  // namespace

BeatGrid::BeatGrid(const MotionTexture& model, std::span<const double> beat_secs, double stretch,
                   std::vector<std::vector<int>> followers)
    : log_stretch_(std::log1p(std::max(stretch, 1e-3))),
      frame_time_secs_(model.frame_time_secs()),
      followers_(std::move(followers)) {
  for (const Instance& instance : model.instances) lengths_.push_back(own_length(model, instance));
  place_moments(beat_secs);
  to_go_.assign(moments_.size(), std::vector<double>(lengths_.size(), 0));
  std::vector<double> costs(lengths_.size());
  for (std::size_t i = moments_.size(); i-- > 0;) {
    for (std::size_t a = 0; a < lengths_.size(); ++a) costs[a] = choose(static_cast<int>(a), moments_[i]).cost;
    for (std::size_t a = 0; a < lengths_.size(); ++a) {
      double least = std::numeric_limits<double>::infinity();
      for (const int b : followers_[a]) least = std::min(least, costs[static_cast<std::size_t>(b)]);
      to_go_[i][a] = std::isfinite(least) ? kPatience * least : 0;
    }
  }
}

void BeatGrid::place_moments(std::span<const double> beat_secs) {
  if (beat_secs.empty()) throw InvalidInput("there is no beat");
  if (beat_secs.size() > kMostBeats)
    throw InvalidInput("there are " + std::to_string(beat_secs.size()) + " beats; at most 20000 are possible");
  double before = 0;
  for (std::size_t i = 0; i < beat_secs.size(); ++i) {
    const double beat = beat_secs[i];
    if (!std::isfinite(beat) || beat < 0 || (i > 0 && beat <= before) || beat > 1e6)
      throw InvalidInput("beat " + std::to_string(i) +
                         ": beats are rising times in seconds from 0 on, at most a million");
    const double gap = beat - before;
    if (gap > kFar) {
      const double fills = std::floor(gap / kFill);
      for (double k = 1; k < fills; ++k) {
        moments_.push_back(std::lround((before + gap * k / fills) / frame_time_secs_));
        penalties_.push_back(kOffBeatCost);
      }
    }
    const Index frame = std::lround(beat / frame_time_secs_);
    if (moments_.empty() || frame > moments_.back()) {
      moments_.push_back(frame);
      penalties_.push_back(0);
    }
    before = beat;
  }
}

BeatGrid::Choice BeatGrid::choose(int instance, Index start) const {
  const Index own = lengths_[static_cast<std::size_t>(instance)];
  const auto n = static_cast<double>(own);
  const double reach = std::exp(kReach * log_stretch_);
  if (static_cast<double>(start) + n > static_cast<double>(moments_.back())) {
    const double over = (static_cast<double>(moments_.back() - start) + 0.5) / n;
    if (over < 1 / reach) return {0, start + own};  // no beat is left to be met
  }
  Choice best{std::numeric_limits<double>::infinity(), start + own};
  const auto first = std::lower_bound(moments_.begin(), moments_.end(),
                                      start + std::max(kFewestFrames, static_cast<Index>(n / reach)));
  for (auto it = first; it != moments_.end(); ++it) {
    const double ratio = static_cast<double>(*it - start) / n;
    if (ratio > reach && it != first) break;
    const auto i = static_cast<std::size_t>(it - moments_.begin());
    const double strain = std::log(ratio) / log_stretch_;
    const double cost = strain * strain + penalties_[i] + to_go_[i][static_cast<std::size_t>(instance)];
    if (cost < best.cost) best = {cost, *it};
  }
  return std::isfinite(best.cost) ? best : Choice{0, start + own};
}

Index BeatGrid::end_of(int instance, Index start) const { return choose(instance, start).end; }
double BeatGrid::cost(int instance, Index start) const { return choose(instance, start).cost; }

BeatReport report_beats(const MotionTexture& model, std::span<const PlayedTexton> played,
                        std::span<const double> beat_secs) {
  BeatReport report;
  std::vector<double> offsets, strains;
  for (std::size_t k = 0; k < played.size() && !beat_secs.empty(); ++k) {
    const double secs = static_cast<double>(played[k].start) * model.frame_time_secs();
    if (k + 1 < played.size()) {
      const Index own = own_length(model, model.instances[static_cast<std::size_t>(played[k].instance)]);
      strains.push_back(
          std::abs(std::log(static_cast<double>(played[k].length) / static_cast<double>(std::max<Index>(1, own)))));
    }
    if (played[k].start == 0 || secs > beat_secs.back() + 0.5 * model.frame_time_secs()) continue;
    const auto after = std::lower_bound(beat_secs.begin(), beat_secs.end(), secs);
    double offset = std::numeric_limits<double>::infinity();
    if (after != beat_secs.end()) offset = *after - secs;
    if (after != beat_secs.begin()) offset = std::min(offset, secs - *(after - 1));
    offsets.push_back(offset / model.frame_time_secs());
  }
  if (!strains.empty()) report.median_stretch = std::exp(quantile(strains, 0.5));
  if (offsets.empty()) return report;
  report.num_boundaries = static_cast<int>(offsets.size());
  report.largest_offset = *std::max_element(offsets.begin(), offsets.end());
  report.share_on_beat =
      static_cast<double>(std::count_if(offsets.begin(), offsets.end(), [](double offset) { return offset <= 1; })) /
      static_cast<double>(offsets.size());
  report.median_offset = quantile(offsets, 0.5);
  return report;
}

}  // namespace motex
