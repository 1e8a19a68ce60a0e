// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_stretch.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "motex/core/options_check.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/segment_synthesis.h"
#include "motex/motion_texture/texton_revisits.h"

namespace motex {
namespace {

constexpr double kMostFactor = 50;
constexpr double kTempo = 1.05, kMostTempo = 1.25, kSpeedTolerance = 0.03, kWarnSpeed = 0.05, kWideCut = 3;
constexpr double kTrendSecs = 0.5, kLeastGain = 0.7, kMostGain = 1.4, kGoodSpeed = 0.03;
constexpr Index kMostRows = 400;
constexpr int kMostGains = 5;
constexpr int kMostTrials = 12;
constexpr double kFavours[] = {0, 0.05, -0.05, 0.15, -0.15, 0.4, -0.4};
constexpr Index kStepChannels[] = {0, 1, 3};  // v_x, v_z, Δψ
using Way = RevisitPlanner::Way;

/// Mean distance that joints and end sites move from each frame to the next.
Vector joint_steps(const Clip& clip) {
  const FrameMatrix p = world_positions(clip);
  const double points = static_cast<double>(p.cols()) / 3;
  Vector steps = Vector::Zero(std::max<Index>(0, p.rows() - 1));
  for (Index t = 0; t + 1 < p.rows(); ++t)
    for (Index j = 0; j < p.cols(); j += 3) steps[t] += (p.block<1, 3>(t + 1, j) - p.block<1, 3>(t, j)).norm() / points;
  return steps;
}

/// What moves about the mean of half a second around, in the channels of the pose; 0 at both ends.
FrameMatrix swing_of(const FrameMatrix& y, double frame_time_secs) {
  const Index n = y.rows(), reach = std::max<Index>(1, std::lround(0.5 * kTrendSecs / frame_time_secs));
  FrameMatrix sums = FrameMatrix::Zero(n + 1, y.cols()), swing = FrameMatrix::Zero(n, y.cols());
  for (Index t = 0; t < n; ++t) sums.row(t + 1) = sums.row(t) + y.row(t);
  for (Index t = 2; t < n - 2; ++t) {
    const Index near = std::min({reach, t, n - 1 - t});
    const double u = std::min(1.0, static_cast<double>(std::min(t - 1, n - 2 - t)) / static_cast<double>(reach));
    swing.row(t) = y.row(t) - (sums.row(t + near + 1) - sums.row(t - near)) / static_cast<double>(2 * near + 1);
    swing.row(t) *= u * u * (3 - 2 * u);
    for (const Index c : kStepChannels) swing(t, c) = 0;
  }
  return swing;
}

class Stretcher {
 public:
  Stretcher(const MotionTexture& model, int instance_idx, Index num_frames, const StretchOptions& options)
      : model_(model),
        instance_(model.instances[static_cast<std::size_t>(instance_idx)]),
        options_(options),
        num_frames_(num_frames),
        rows_(model.corpus.middleRows(instance_.row, instance_.length).cast<double>()),
        speed_(mean_joint_speed(example_clip(model, instance_idx))),
        tau_(usual_jump_distance(model)) {
    gather(instance_idx);
  }

  Clip warp(StretchReport& report) const;
  Clip white(StretchReport& report) const;
  Clip revisit(StretchReport& report, const JobContext& job) const;

 private:
  void gather(int instance_idx);
  std::vector<Way> ways() const;
  double badness(const Way& way, double speed) const;
  FrameMatrix play(const Way& way, StretchReport& report) const;
  Clip calibrated(const FrameMatrix& features, StretchReport& report) const;
  Clip finish(const FrameMatrix& features, StretchReport& report) const;
  SegmentSynthesis segments(NoiseSource source) const;

  const MotionTexture& model_;
  const Instance& instance_;
  const StretchOptions& options_;
  Index num_frames_;
  FrameMatrix rows_;
  double speed_, tau_;
  RevisitSource source_;
  std::vector<int> examples_;  ///< in source_
};

/// The example, and those others of its texton that come nearest to it somewhere.
void Stretcher::gather(int instance_idx) {
  std::vector<std::pair<double, int>> others;
  const auto& corpus = model_.corpus;
  for (const int i : model_.textons[static_cast<std::size_t>(instance_.texton)].instances) {
    const Instance& other = model_.instances[static_cast<std::size_t>(i)];
    double nearest = HUGE_VAL;
    for (Index a = 0; a < instance_.length; a += 4)
      nearest = std::min<double>(nearest,
                                 (corpus.middleRows(other.row, other.length).rowwise() - corpus.row(instance_.row + a))
                                     .rowwise()
                                     .squaredNorm()
                                     .minCoeff());
    if (i != instance_idx) others.emplace_back(nearest, i);
  }
  std::sort(others.begin(), others.end());
  others.insert(others.begin(), {0, instance_idx});
  Index rows = 0;
  for (const auto& [distance, i] : others) {
    const Instance& example = model_.instances[static_cast<std::size_t>(i)];
    if (!examples_.empty() && rows + example.length > kMostRows) break;
    examples_.push_back(i);
    source_.starts.push_back(rows);
    rows += example.length;
    source_.rows.conservativeResize(rows, rows_.cols());
    source_.rows.bottomRows(example.length) = corpus.middleRows(example.row, example.length).cast<double>();
    source_.speeds.conservativeResize(rows);
    source_.speeds.tail(example.length) << joint_steps(example_clip(model_, i)), 0;
  }
}

SegmentSynthesis Stretcher::segments(NoiseSource source) const {
  PlayOptions synthesis;
  synthesis.noise = options_.noise;
  synthesis.noise_source = source;
  synthesis.seed = options_.seed;
  return {model_, synthesis};
}

Clip Stretcher::finish(const FrameMatrix& features, StretchReport& report) const {
  Clip clip = decode(model_.features, features, instance_.place);
  clip.name = "texton";
  const Index ends[] = {0, 1, num_frames_ - 2, num_frames_ - 1};
  if (options_.foot_fix && !model_.feet.legs.empty()) fix_feet(clip, model_.feet, {}, ends);
  report.source_length = instance_.length;
  report.speed_ratio = speed_ > 0 ? mean_joint_speed(clip) / speed_ : 1;
  return clip;
}

Clip Stretcher::warp(StretchReport& report) const {
  const double pace = static_cast<double>(instance_.length - 1) / static_cast<double>(num_frames_ - 1);
  FrameMatrix out(num_frames_, rows_.cols());
  for (Index t = 0; t < num_frames_; ++t) {
    const double time = std::min(static_cast<double>(t) * pace, static_cast<double>(instance_.length - 1));
    const Index k = std::min(static_cast<Index>(time), instance_.length - 2);
    const double u = time - static_cast<double>(k);
    out.row(t) = (1 - u) * rows_.row(k) + u * rows_.row(k + 1);
    for (const Index c : kStepChannels) out(t, c) *= pace;
  }
  report.visits = {{0, num_frames_, examples_[0], 0, instance_.length}};
  return finish(out, report);
}

Clip Stretcher::white(StretchReport& report) const {
  const Index end = instance_.row + instance_.length - 2;
  report.visits = {{0, num_frames_, examples_[0], 0, instance_.length}};
  return finish(segments(NoiseSource::kWhite)
                    .play({instance_.texton, instance_.row, instance_.length, instance_.row, end, num_frames_}),
                report);
}

std::vector<Way> Stretcher::ways() const {
  const Index steps = num_frames_ - 2;
  const RevisitPlanner planner(source_, tau_, model_.frame_time_secs(), steps);
  std::vector<Way> all;
  for (const double favour : kFavours)
    for (Way& way : planner.ways(static_cast<Index>(static_cast<double>(steps) / kMostTempo),
                                 static_cast<Index>(static_cast<double>(steps) * kMostTempo) + 1, favour))
      all.push_back(std::move(way));
  all.push_back({{{0, instance_.length - 2}}, instance_.length - 2, 0, 1, 0});
  return all;
}

/// Of a way that is `speed` times as fast as the example.
double Stretcher::badness(const Way& way, double speed) const {
  const double tempo =
      std::log(static_cast<double>(way.num_steps) / static_cast<double>(num_frames_ - 2)) / std::log(kTempo);
  const double off = (speed - 1) / kSpeedTolerance;
  return way.cost + tempo * tempo + off * off;
}

/// The visits one after another; where they are cut they meet half-way.
FrameMatrix Stretcher::play(const Way& way, StretchReport& report) const {
  SegmentSynthesis synthesis = segments(NoiseSource::kReplay);
  FrameMatrix features(num_frames_, rows_.cols());
  report.visits.clear();
  report.largest_cut = way.largest_cut;
  FrameMatrix first = rows_.topRows(2);
  Index steps_done = 0, start = 0;
  for (std::size_t k = 0; k < way.visits.size(); ++k) {
    const Visit& visit = way.visits[k];
    steps_done += visit.last - visit.first;
    const Index end = steps_done * (num_frames_ - 2) / way.num_steps;
    FrameMatrix last = source_.rows.middleRows(visit.last, 2);
    if (k + 1 < way.visits.size()) last = 0.5 * (last + source_.rows.middleRows(way.visits[k + 1].first, 2));
    const auto after = std::upper_bound(source_.starts.begin(), source_.starts.end(), visit.first);
    const auto which = static_cast<std::size_t>(after - source_.starts.begin() - 1);
    const int example = examples_[which];
    const Index begin = visit.first - source_.starts[which];
    const Piece piece{instance_.texton,
                      model_.instances[static_cast<std::size_t>(example)].row + begin,
                      visit.last + 2 - visit.first,
                      0,
                      0,
                      end + 2 - start};
    features.middleRows(start, piece.length) = synthesis.play(piece, first, last);
    report.visits.push_back({start, piece.length, example, begin, piece.source_length});
    first = last;
    start = end;
  }
  return features;
}

/// Movement about its half-second mean made larger or smaller until the speed is the example's; the ends stay.
Clip Stretcher::calibrated(const FrameMatrix& features, StretchReport& report) const {
  const FrameMatrix swing = swing_of(features, model_.frame_time_secs());
  double gain = report.gain, before = 1, speed_before = 0, target = 1;
  Clip best;
  double least = HUGE_VAL;
  for (int trial = 0; trial < kMostGains; ++trial) {
    StretchReport now = report;
    Clip clip = finish(features + (gain - 1) * swing, now);
    now.gain = gain;
    const double speed = now.speed_ratio, off = std::abs(speed - 1);
    if (trial == 0) target = std::clamp(speed, 1 - kGoodSpeed, 1 + kGoodSpeed);
    if (off < least) least = off, best = std::move(clip), report = now;
    const double slope = trial == 0 ? speed : (speed - speed_before) / (gain - before);
    before = gain, speed_before = speed;
    if (std::abs(speed - target) < 0.005 || !(slope > 0)) break;
    gain = std::clamp(gain + (target - speed) / slope, kLeastGain, kMostGain);
    if (gain == before) break;
  }
  return best;
}

/// Plays the most promising ways and keeps the best by the speed that they turn out to have.
Clip Stretcher::revisit(StretchReport& report, const JobContext& job) const {
  const std::vector<Way> all = ways();
  std::vector<bool> tried(all.size(), false);
  FrameMatrix best;
  double least = HUGE_VAL, bias = 1;
  const auto pace = [&](const Way& way) {
    return static_cast<double>(way.num_steps) / static_cast<double>(num_frames_ - 2);
  };
  for (int trial = 0; trial < kMostTrials; ++trial) {
    job.check_cancelled();
    std::size_t next = all.size();
    double promised = least;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double expected = badness(all[k], bias * all[k].speed * pace(all[k]));
      if (!tried[k] && expected < promised) promised = expected, next = k;
    }
    if (next == all.size()) break;
    tried[next] = true;
    StretchReport now;
    FrameMatrix features = play(all[next], now);
    finish(features, now);
    bias = now.speed_ratio / (all[next].speed * pace(all[next]));
    const double bad = badness(all[next], now.speed_ratio);
    if (bad < least) least = bad, best = std::move(features), report = std::move(now);
  }
  return calibrated(best, report);
}

}  // namespace

void check_instance(const MotionTexture& model, int instance) {
  if (instance < 0 || instance >= static_cast<int>(model.instances.size()))
    throw InvalidInput("there is no example " + std::to_string(instance) + "; the model has 0 … " +
                       std::to_string(model.instances.size() - 1));
}

Clip example_clip(const MotionTexture& model, int instance) {
  check_instance(model, instance);
  const Instance& a = model.instances[static_cast<std::size_t>(instance)];
  Clip clip = decode(model.features, model.corpus.middleRows(a.row, a.length).cast<double>(), a.place);
  clip.name = "example";
  return clip;
}

double mean_joint_speed(const Clip& clip) {
  return clip.num_frames() < 2 ? 0 : joint_steps(clip).mean() / clip.frame_time_secs;
}

Clip stretch_texton(const MotionTexture& model, int instance, Index num_frames, const StretchOptions& options,
                    StretchReport& report, const JobContext& job) {
  check_options(options);
  check_instance(model, instance);
  const Index length = model.instances[static_cast<std::size_t>(instance)].length;
  if (num_frames < 4) throw InvalidInput("a texton needs at least 4 frames: its two first and its two last poses");
  if (static_cast<double>(num_frames) > kMostFactor * static_cast<double>(length))
    throw InvalidInput("an example of " + std::to_string(length) + " frames cannot be stretched to " +
                       std::to_string(num_frames) + "; at most to 50 times its length");
  const Stretcher stretcher(model, instance, num_frames, options);
  report = {};
  if (options.method == StretchMethod::kWarp) return stretcher.warp(report);
  if (options.method == StretchMethod::kWhite) return stretcher.white(report);
  Clip clip = stretcher.revisit(report, job);
  if (std::abs(report.speed_ratio - 1) > kWarnSpeed)
    job.warn("the texton moves at " + std::to_string(std::lround(100 * report.speed_ratio)) +
             " % of its example's speed: no other way of " + std::to_string(num_frames) + " frames is nearer");
  if (report.largest_cut > kWideCut * usual_jump_distance(model))
    job.warn("the movement goes on from a pose " + std::to_string(std::lround(report.largest_cut)) +
             " cm away; it was bent to it");
  return clip;
}

}  // namespace motex
