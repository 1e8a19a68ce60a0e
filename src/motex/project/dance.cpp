// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/dance.h"

#include <cmath>
#include <string>

#include "motex/core/parallel.h"
#include "motex/motion/retime.h"

namespace motex {
namespace {

Dance make_loop(const MotionTexture& model, const DanceRequest& request, const SynthesizeOptions& options,
                const JobContext& job) {
  if (!request.path.empty()) throw InvalidInput("a loop finds its own way: it goes without a path");
  if (!options.beats.empty()) throw InvalidInput("a loop goes without beats");
  ChoreographyOptions choreography;
  static_cast<PlayOptions&>(choreography) = options;
  choreography.stretch = options.stretch;
  const auto own_frames = std::max<Index>(2, std::llround(static_cast<double>(request.num_frames) * request.speed));
  LoopReport report;
  Dance dance;
  const Clip loop = synthesize_loop(model, own_frames, request.step, choreography, report, job);
  dance.clip = request.speed == 1 ? loop : loop_at_speed(model.features, loop, request.step, request.speed);
  dance.seam_ratio = report.seam_ratio;
  for (const ChoreographedTexton& played : report.played)
    if (played.start < own_frames)
      dance.report.played.push_back(
          {played.texton, played.instance, played.start, std::min(played.length, own_frames - played.start)});
  return dance;
}

Dance make_walk(const MotionTexture& model, const DanceRequest& request, const SynthesizeOptions& options,
                const JobContext& job) {
  SynthesizeOptions own = options;  // in the time of the examples
  for (double& beat : own.beats) beat *= request.speed;
  const Index own_frames =
      request.num_frames == 0
          ? 0
          : static_cast<Index>(std::ceil(static_cast<double>(request.num_frames - 1) * request.speed - 1e-9)) + 1;
  Dance dance;
  dance.clip = synthesize_motion(model, own_frames, request.path, own, dance.report, job);
  if (!own.beats.empty()) {
    dance.beats = report_beats(model, dance.report.played, own.beats);
    dance.beats.median_offset /= request.speed;
    dance.beats.largest_offset /= request.speed;
  }
  if (request.speed != 1) {
    dance.clip = play_at_speed(dance.clip, request.speed);
    if (request.num_frames > 0 && dance.clip.num_frames() > request.num_frames)
      dance.clip = slice(dance.clip, 0, request.num_frames);
  }
  return dance;
}

/// Frames of the examples' pace to frames of the clip.
void count_in_output_frames(SynthesizeReport& report, double speed) {
  if (speed == 1) return;
  const auto frame = [&](Index own) { return static_cast<Index>(std::llround(static_cast<double>(own) / speed)); };
  for (PlayedTexton& played : report.played) {
    const Index start = frame(played.start);
    played.length = frame(played.start + played.length) - start;
    played.start = start;
  }
  report.longest_copy = frame(report.longest_copy);
}

}  // namespace

Dance make_dance(const MotionTexture& model, const DanceRequest& request, const SynthesizeOptions& options,
                 const JobContext& job) {
  if (!(request.speed >= kSlowestPlay && request.speed <= kFastestPlay))
    throw InvalidInput("the speed is 0.25 to 4 times that of the examples");
  Dance dance = request.is_loop ? make_loop(model, request, options, job) : make_walk(model, request, options, job);
  count_in_output_frames(dance.report, request.speed);
  dance.seed = options.seed;
  return dance;
}

std::vector<Dance> make_dances(const MotionTexture& model, const DanceRequest& request,
                               const SynthesizeOptions& options, int count, const JobContext& job) {
  if (count < 1) throw InvalidInput("there is at least one dancer");
  std::vector<Dance> dances(static_cast<std::size_t>(count));
  std::vector<std::vector<std::string>> warnings(dances.size());
  parallel_for(job.jobs, count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    SynthesizeOptions own = options;
    own.seed += i;
    JobContext quiet;
    quiet.cancel = job.cancel;
    quiet.on_warning = [&warnings, i](const std::string& text) { warnings[i].push_back(text); };
    dances[i] = make_dance(model, request, own, quiet);
  });
  for (const auto& list : warnings)
    for (const std::string& text : list) job.warn(text);
  return dances;
}

}  // namespace motex
