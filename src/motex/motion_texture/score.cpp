// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <string>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/recognition.h"

namespace motex {

std::vector<RecognisedSegment> segment_clip(const MotionTexture& model, const Clip& clip) {
  if (clip.num_frames() < 3)
    throw InvalidInput(clip.name + ": has " + std::to_string(clip.num_frames()) +
                       " frames; a texton can be recognised from 3 on");
  Corpus corpus;
  corpus.features = encode(model.features, clip);
  corpus.runs = {{0, 0, 0, clip.num_frames()}};
  const Recognition recognition(model, corpus);
  std::vector<RecognisedSegment> out;
  for (const Segment& s : recognition.by_moves(corpus.runs[0])) {
    const double sum = recognition.emissions().col(s.state).segment(s.start, s.length).cast<double>().sum();
    out.push_back({s.state, s.start, s.length, sum / static_cast<double>(s.length)});
  }
  return out;
}

ScoreReport score_clips(const MotionTexture& model, std::span<const Clip> clips, const JobContext& job) {
  const Corpus corpus = make_corpus(model.features, clips, shortest_segment(model), model.options.keep_glitches, job);
  const Recognition recognition(model, corpus, job);
  ScoreReport report;
  double textons = 0;
  for (const Run& run : corpus.runs) {
    job.check_cancelled();
    textons += recognition.by_dynamics(run).score;
    report.num_frames += run.length - 2;
  }
  const double global = global_log_densities(model, corpus, job).sum();
  report.log_likelihood_per_frame = textons / static_cast<double>(report.num_frames);
  report.global_lds_log_likelihood_per_frame = global / static_cast<double>(report.num_frames);
  return report;
}

}  // namespace motex
