// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/measures.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/quantile.h"
#include "motex/motion/glitches.h"
#include "motex/motion/window_match.h"

namespace motex {
namespace {

constexpr double kWindowRate = 30;
constexpr Index kDroppedFrames = 10;
constexpr double kContactHeight = 0.03;

/// World positions of a stretch of frames without a gap: frames × 3·joints.
struct Track {
  FrameMatrix positions;
  double rate;
};

/// What both sides are measured by.
struct Body {
  Index root = 0;
  double height = 0;
  std::vector<Index> feet;
};

FrameMatrix joint_positions(const Clip& clip, bool tips) {
  FrameMatrix positions = world_positions(clip);
  if (!tips) positions.conservativeResize(Eigen::NoChange, 3 * clip.skeleton.num_joints());
  return positions;
}

/// The parts of the reference that count: ranges without glitches.
std::vector<ClipRange> clean_ranges(std::span<const Clip> clips, std::span<const ClipRange> ranges, bool keep_glitches,
                                    Index& num_glitch_frames) {
  std::vector<std::vector<Index>> left_out(clips.size());
  for (std::size_t c = 0; c < clips.size() && !keep_glitches; ++c) {
    std::vector<Index>& out = left_out[c];
    out = find_glitch_frames(clips[c]);
    num_glitch_frames += std::ssize(out);
    if (out.empty() || out.front() >= kDroppedFrames) continue;
    std::erase_if(out, [](Index t) { return t < kDroppedFrames; });
    for (Index t = std::min(kDroppedFrames, clips[c].num_frames()); t-- > 0;) out.insert(out.begin(), t);
  }
  std::vector<ClipRange> clean;
  for (const ClipRange& range : ranges) {
    if (range.clip_idx < 0 || range.clip_idx >= std::ssize(clips))
      throw InvalidInput("the reference has no clip " + std::to_string(range.clip_idx));
    const auto c = static_cast<std::size_t>(range.clip_idx);
    if (range.first < 0 || range.count < 0 || range.first + range.count > clips[c].num_frames())
      throw InvalidInput("the range of " + clips[c].name + " goes beyond its " + std::to_string(clips[c].num_frames()) +
                         " frames");
    std::vector<Index> out;
    for (const Index t : left_out[c])
      if (t >= range.first && t < range.first + range.count) out.push_back(t - range.first);
    for (const FrameRange& part : ranges_without(range.count, out))
      clean.push_back({range.clip_idx, range.first + part.first, part.count});
  }
  return clean;
}

std::vector<double> heights(std::span<const Track> tracks, Index joint) {
  std::vector<double> all;
  for (const Track& track : tracks)
    for (Index t = 0; t < track.positions.rows(); ++t) all.push_back(track.positions(t, 3 * joint + 1));
  return all;
}

Body find_body(std::span<const Track> tracks, Index root) {
  Body body;
  body.root = root;
  const Index joints = tracks.front().positions.cols() / 3;
  for (const Track& track : tracks)
    for (Index t = 0; t < track.positions.rows(); ++t) {
      const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<3>> y(&track.positions(t, 1), joints);
      body.height = std::max(body.height, y.maxCoeff() - y.minCoeff());
    }
  std::vector<std::pair<double, Index>> low;
  for (Index j = 0; j < joints; ++j) low.emplace_back(quantile(heights(tracks, j), 0.05), j);
  std::sort(low.begin(), low.end());
  for (std::size_t i = 0; i < std::min<std::size_t>(4, low.size()); ++i) body.feet.push_back(low[i].second);
  return body;
}

void measure_feet(std::span<const Track> tracks, const Body& body, MotionMeasures& m) {
  double sum = 0;
  Index contacts = 0, steps = 0;
  for (const Index foot : body.feet) {
    const double limit = quantile(heights(tracks, foot), 0.02) + kContactHeight * body.height;
    for (const Track& track : tracks) {
      const FrameMatrix& p = track.positions;
      for (Index t = 1; t < p.rows(); ++t) {
        ++steps;
        if (p(t, 3 * foot + 1) >= limit || p(t - 1, 3 * foot + 1) >= limit) continue;
        ++contacts;
        sum +=
            std::hypot(p(t, 3 * foot) - p(t - 1, 3 * foot), p(t, 3 * foot + 2) - p(t - 1, 3 * foot + 2)) * track.rate;
      }
    }
  }
  m.contact_speed = contacts > 0 ? sum / static_cast<double>(contacts) : 0;
  m.contact_share = steps > 0 ? static_cast<double>(contacts) / static_cast<double>(steps) : 0;
}

MotionMeasures measure(std::span<const Track> tracks, const Body& body) {
  MotionMeasures m;
  double jerk = 0, speed = 0;
  Index num_jerks = 0, num_steps = 0;
  m.height_min = HUGE_VAL, m.height_max = -HUGE_VAL;
  for (const Track& track : tracks) {
    const FrameMatrix& p = track.positions;
    const Index frames = p.rows(), joints = p.cols() / 3;
    const FrameMatrix relative = p - p.middleCols<3>(3 * body.root).replicate(1, joints);
    m.num_frames += frames;
    m.height_min = std::min(m.height_min, p.col(3 * body.root + 1).minCoeff());
    m.height_max = std::max(m.height_max, p.col(3 * body.root + 1).maxCoeff());
    Eigen::RowVectorXd third(p.cols());
    for (Index t = 1; t < frames; ++t) {
      if (t >= 3) third = relative.row(t) - 3 * relative.row(t - 1) + 3 * relative.row(t - 2) - relative.row(t - 3);
      for (Index j = 0; j < joints; ++j) {
        speed += (p.block<1, 3>(t, 3 * j) - p.block<1, 3>(t - 1, 3 * j)).norm() * track.rate;
        const double step = (relative.block<1, 3>(t, 3 * j) - relative.block<1, 3>(t - 1, 3 * j)).norm();
        m.pose_jump = std::max(m.pose_jump, step * track.rate);
        if (t >= 3) jerk += third.segment<3>(3 * j).norm() * std::pow(track.rate, 3);
      }
      num_steps += joints;
      num_jerks += t >= 3 ? joints : 0;
    }
  }
  if (num_steps > 0) m.speed = speed / static_cast<double>(num_steps);
  if (num_jerks > 0 && body.height > 0) m.jerk = jerk / (static_cast<double>(num_jerks) * body.height);
  measure_feet(tracks, body, m);
  return m;
}

/// Frames × 6·joints: the first two columns of every joint's rotation matrix.
FrameMatrixF rotation_features(const Clip& clip) {
  const int joints = clip.skeleton.num_joints();
  FrameMatrixF features(clip.num_frames(), 6 * joints);
  for (Index t = 0; t < clip.num_frames(); ++t)
    for (int j = 0; j < joints; ++j) {
      const Eigen::Matrix3f r = clip.rotation(t, j).toRotationMatrix().cast<float>();
      features.block<1, 3>(t, 6 * j) = r.col(0).transpose();
      features.block<1, 3>(t, 6 * j + 3) = r.col(1).transpose();
    }
  return features;
}

WindowMatchReport compare_windows(std::span<const Clip> clips, std::span<const ClipRange> ranges, const Clip& generated,
                                  double threshold, const JobContext& job) {
  std::vector<FrameMatrixF> parts;
  std::vector<Index> lengths;
  Index rows = 0;
  for (const ClipRange& range : ranges) {
    const Clip part = slice(clips[static_cast<std::size_t>(range.clip_idx)], range.first, range.count);
    parts.push_back(rotation_features(resample(part, 1 / kWindowRate)));
    lengths.push_back(parts.back().rows());
    rows += lengths.back();
  }
  FrameMatrixF reference(rows, 6 * generated.skeleton.num_joints());
  rows = 0;
  for (FrameMatrixF& part : parts) {
    reference.middleRows(rows, part.rows()) = part;
    rows += part.rows();
    part.resize(0, 0);
  }
  WindowMatchOptions options;
  options.threshold = threshold;
  return match_windows(reference, lengths, rotation_features(resample(generated, 1 / kWindowRate)), options, job);
}

double ratio(double generated, double reference) {
  return generated == 0 && reference == 0 ? 1 : generated / reference;
}

std::string joint_name(const Skeleton& skeleton, Index joint) {
  const auto name = [&](Index j) { return skeleton.joints[static_cast<std::size_t>(j)].name; };
  const Index tip = joint - skeleton.num_joints();
  return tip < 0 ? name(joint) : "tip of " + name(skeleton.end_sites[static_cast<std::size_t>(tip)].parent_idx);
}

void check_sides(std::span<const Clip> reference, const Clip& generated) {
  if (reference.empty()) throw InvalidInput("there is no reference clip to compare with");
  check_clip(generated);
  for (const Clip& clip : reference) {
    check_clip(clip);
    const std::string difference = skeleton_difference(clip.skeleton, generated.skeleton);
    if (!difference.empty())
      throw InvalidInput("'" + clip.name + "' and '" + generated.name + "' have different skeletons: " + difference);
    if (clip.skeleton.end_sites.size() != generated.skeleton.end_sites.size())
      throw InvalidInput("'" + clip.name + "' and '" + generated.name + "' have different end sites");
  }
}

}  // namespace

CompareReport compare_motion(std::span<const Clip> reference, std::span<const ClipRange> ranges, const Clip& generated,
                             const CompareOptions& options, const JobContext& job) {
  check_options(options);
  check_sides(reference, generated);
  CompareReport report;
  const std::vector<ClipRange> clean = clean_ranges(reference, ranges, options.keep_glitches, report.num_glitch_frames);
  const WindowMatchReport windows = compare_windows(reference, clean, generated, options.threshold, job);
  report.coverage = windows.coverage;
  report.global_diversity = windows.global_diversity;
  report.local_diversity = windows.local_diversity;
  report.num_reference_windows = windows.num_reference_windows;

  std::vector<Track> tracks;
  for (const ClipRange& range : clean) {
    const Clip part = slice(reference[static_cast<std::size_t>(range.clip_idx)], range.first, range.count);
    tracks.push_back({joint_positions(part, options.tips), part.frame_rate()});
  }
  const Track own{joint_positions(generated, options.tips), generated.frame_rate()};
  const Body body = find_body(tracks, travelling_joint(reference));
  report.body_height = body.height;
  for (const Index foot : body.feet) report.feet.push_back(joint_name(generated.skeleton, foot));
  const MotionMeasures& r = report.reference = measure(tracks, body);
  const MotionMeasures& g = report.generated = measure({&own, 1}, body);
  report.jerk_ratio = ratio(g.jerk, r.jerk);
  report.contact_speed_ratio = ratio(g.contact_speed, r.contact_speed);
  report.pose_jump_ratio = ratio(g.pose_jump, r.pose_jump);
  report.speed_ratio = ratio(g.speed, r.speed);
  return report;
}

CompareReport compare_motion(std::span<const Clip> reference, const Clip& generated, const CompareOptions& options,
                             const JobContext& job) {
  std::vector<ClipRange> ranges;
  for (std::size_t c = 0; c < reference.size(); ++c)
    ranges.push_back({static_cast<int>(c), 0, reference[c].num_frames()});
  return compare_motion(reference, ranges, generated, options, job);
}

}  // namespace motex
