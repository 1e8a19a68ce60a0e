// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/synthesize.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "motex/core/options_check.h"
#include "motex/motion/floor.h"
#include "motex/motion_texture/beats.h"
#include "motex/motion_texture/instance_walk.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/segment_synthesis.h"

namespace motex {
namespace {

constexpr double kBeatTaste = 1.5;  // log p for each unit of BeatGrid::cost

}  // namespace

struct Synthesizer::State {
  State(const MotionTexture& m, const SynthesizeOptions& options, std::vector<int> path, bool endless)
      : model(m),
        walk(m, options, std::move(path), endless),
        segments(m, options),
        pose(make_held_clip(m.features, 1)),
        standing_pose(pose) {
    if (options.foot_fix && !m.feet.legs.empty()) fixer.emplace(m.feet, m.features.skeleton, m.frame_time_secs());
    if (options.floor_fix && !m.feet.legs.empty()) floor.emplace(m.feet, m.features.skeleton, m.frame_time_secs());
    if (!options.beats.empty()) grid.emplace(m, options.beats, options.stretch, walk.followers());
    coming = next_from(0);
    if (coming >= 0) place = m.instances[static_cast<std::size_t>(coming)].place;
    advance();
  }

  /// Synthesizes the next segment. Its two last frames are the two first of the one after, which plays them.
  bool advance() {
    if (coming < 0) return false;
    const int instance = coming;
    if (grid) {
      const Index next_start = grid->end_of(instance, num_made);
      coming = next_from(next_start);
      features = &(coming < 0 ? segments.play(instance, coming)
                              : segments.play(piece(instance, coming, next_start - num_made + 2)));
    } else {
      coming = walk.next();
      features = &segments.play(instance, coming);
    }
    end = features->rows() - (coming < 0 ? 0 : 2);
    row = 0;
    now = {model.instances[static_cast<std::size_t>(instance)].texton, instance, num_made, end};
    begun.push_back(now);
    return true;
  }

  /// The instance to begin at an output frame: with beats, rather one that can end on one.
  int next_from(Index start) {
    if (!grid) return walk.next();
    return walk.next(
        [&](int instance) { return std::exp(-kBeatTaste * std::min(400.0, grid->cost(instance, start))); });
  }

  Piece piece(int instance, int next, Index length) const {
    const Instance& a = model.instances[static_cast<std::size_t>(instance)];
    return {a.texton,
            a.row,
            hand_over_row(model, a) + 2 - a.row,
            a.row,
            model.instances[static_cast<std::size_t>(next)].row,
            length};
  }

  /// Decodes the next frame into `out`.
  bool make(Clip& out, Index frame) {
    if (features == nullptr || (row == end && !advance())) return false;
    decode_frame(model.features, &(*features)(row, 0), num_made == 0, place, out, frame);
    ++row;
    ++num_made;
    return true;
  }

  /// The next frame with planted feet held.
  bool stand(Clip& out, Index frame) {
    if (!fixer) return make(out, frame);
    while (!fixer->pop(out, frame)) {
      if (is_over) return false;
      if (make(pose, 0)) {
        fixer->push(pose, 0);
      } else {
        fixer->finish();
        is_over = true;
      }
    }
    return true;
  }

  const MotionTexture& model;
  InstanceWalk walk;
  SegmentSynthesis segments;
  std::optional<BeatGrid> grid;
  std::optional<FootFixer> fixer;
  std::optional<FloorFixer> floor;
  Clip pose, standing_pose;
  const FrameMatrix* features = nullptr;
  Index row = 0, end = 0, num_made = 0;
  int coming = -1;
  bool is_over = false, is_all_over = false;  ///< no more for fixer, for floor
  RootPlace place;
  PlayedTexton now;
  std::vector<PlayedTexton> begun;
};

Synthesizer::Synthesizer(const MotionTexture& model, const SynthesizeOptions& options, std::vector<int> path,
                         bool endless) {
  check_options(options);
  state_ = std::make_unique<State>(model, options, std::move(path), endless);
}
Synthesizer::~Synthesizer() = default;
Synthesizer::Synthesizer(Synthesizer&&) noexcept = default;

bool Synthesizer::next(Clip& out, Index frame) {
  State& s = *state_;
  if (!s.floor) return s.stand(out, frame);
  while (!s.floor->pop(out, frame)) {
    if (s.is_all_over) return false;
    if (s.stand(s.standing_pose, 0)) {
      s.floor->push(s.standing_pose, 0);
    } else {
      s.floor->finish();
      s.is_all_over = true;
    }
  }
  return true;
}

std::vector<PlayedTexton> Synthesizer::take_played() { return std::exchange(state_->begun, {}); }

Clip make_output_clip(const MotionTexture& model, Index num_frames) {
  Clip clip = make_held_clip(model.features, num_frames);
  clip.name = "dance";
  return clip;
}

namespace {

/// Longest run of frames whose examples follow one another in the source.
Index longest_copy(const MotionTexture& model, const std::vector<PlayedTexton>& played) {
  Index longest = 0, run = 0;
  for (std::size_t k = 0; k < played.size(); ++k) {
    const bool follows = k > 0 && played[k].instance == played[k - 1].instance + 1 &&
                         model.instances[static_cast<std::size_t>(played[k].instance)].run_idx ==
                             model.instances[static_cast<std::size_t>(played[k - 1].instance)].run_idx;
    run = (follows ? run : 0) + played[k].length;
    longest = std::max(longest, run);
  }
  return longest;
}

void check_not_too_many(Index num_frames) {
  constexpr Index kMostFrames = 20'000'000;
  if (num_frames > kMostFrames) throw InvalidInput("more than 20 million frames at once: use the stream");
}

void drop_beyond(std::vector<PlayedTexton>& played, Index num_frames) {
  while (!played.empty() && played.back().start >= num_frames) played.pop_back();
  if (!played.empty()) played.back().length = std::min(played.back().length, num_frames - played.back().start);
}

}  // namespace

Clip synthesize_motion(const MotionTexture& model, Index num_frames, const std::vector<int>& path,
                       const SynthesizeOptions& options, SynthesizeReport& report, const JobContext& job) {
  if (num_frames < 0 || (num_frames == 0 && path.empty()))
    throw InvalidInput("give a number of frames above 0, or a path");
  check_not_too_many(num_frames);
  Synthesizer synthesizer(model, options, path, num_frames > 0);
  Index capacity = num_frames > 0 ? num_frames : 1024;
  Clip out = make_output_clip(model, capacity);
  Index frame = 0;
  for (; num_frames == 0 || frame < num_frames; ++frame) {
    if (frame == capacity) {
      capacity *= 2;
      out.translations.conservativeResize(capacity, Eigen::NoChange);
      out.rotations.conservativeResize(capacity, Eigen::NoChange);
      for (Index t = frame; t < capacity; ++t) {
        out.translations.row(t) = out.translations.row(0);
        out.rotations.row(t) = out.rotations.row(0);
      }
    }
    if (!synthesizer.next(out, frame)) break;
    if (frame % 1024 == 0) {
      job.check_cancelled();
      if (num_frames > 0) job.progress("dancing", static_cast<double>(frame) / static_cast<double>(num_frames));
    }
  }
  if (frame < capacity) out = slice(out, 0, frame);
  report.played = synthesizer.take_played();
  drop_beyond(report.played, frame);
  report.longest_copy = longest_copy(model, report.played);
  return out;
}

Clip synthesize_unconstrained(const MotionTexture& model, int texton, Index num_frames,
                              const SynthesizeOptions& options, SynthesizeReport& report) {
  check_options(options);
  check_playable(model, texton);
  if (num_frames < 2) throw InvalidInput("an unconstrained texton needs at least 2 frames");
  check_not_too_many(num_frames);
  Rng rng(options.seed);
  const Texton& t = model.textons[static_cast<std::size_t>(texton)];
  const Subspace& space = model.subspace(texton);
  const int instance = t.instances[rng.below(t.instances.size())];
  const Index row = model.instances[static_cast<std::size_t>(instance)].row;
  FrameMatrix states(num_frames, space.basis.cols());
  states.topRows(2) = (model.corpus.middleRows(row, 2).cast<double>().rowwise() - space.mean.transpose()) * space.basis;
  simulate(t.dynamics, states, &rng, options.noise > 0 ? options.noise : 1);
  const FrameMatrix features = (states * space.basis.transpose()).rowwise() + space.mean.transpose();
  if (!features.allFinite())
    throw NumericalFailure("the texton is unstable: its motion leaves all bounds in " + std::to_string(num_frames) +
                           " frames");
  report.played = {{texton, instance, 0, num_frames}};
  report.longest_copy = 0;
  Clip clip = decode(model.features, features);
  clip.name = "texton";
  return clip;
}

}  // namespace motex
