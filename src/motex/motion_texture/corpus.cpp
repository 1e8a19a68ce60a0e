// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/corpus.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/motion/glitches.h"

namespace motex {
namespace {

std::vector<bool> good_frames(const Clip& clip, bool keep_glitches) {
  std::vector<bool> good(static_cast<std::size_t>(clip.num_frames()), true);
  if (!keep_glitches)
    for (const Index t : find_glitch_frames(clip, {})) good[static_cast<std::size_t>(t)] = false;
  return good;
}

}  // namespace

Corpus make_corpus(const FeatureSpace& space, std::span<const Clip> clips, Index min_frames, bool keep_glitches,
                   const JobContext& job) {
  if (clips.empty()) throw InvalidInput("no clip was given");
  Corpus corpus;
  std::vector<FrameMatrix> parts;
  Index row = 0, longest = 0;
  int clips_with_glitches = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    job.check_cancelled();
    const Clip& clip = clips[c];
    const std::vector<bool> good = good_frames(clip, keep_glitches);
    const auto glitches = std::count(good.begin(), good.end(), false);
    corpus.num_glitch_frames += glitches;
    clips_with_glitches += glitches > 0 ? 1 : 0;
    for (Index t = 0; t < clip.num_frames();) {
      Index end = t;
      while (end < clip.num_frames() && good[static_cast<std::size_t>(end)]) ++end;
      longest = std::max(longest, end - t);
      if (end - t >= min_frames + 2) {
        corpus.runs.push_back({static_cast<int>(c), t, row, end - t});
        parts.push_back(encode(space, slice(clip, t, end - t), job));
        row += end - t;
      }
      t = end + 1;
    }
  }
  if (corpus.num_glitch_frames > 0)
    job.warn("left out " + std::to_string(corpus.num_glitch_frames) + " frames of " +
             std::to_string(clips_with_glitches) + (clips_with_glitches == 1 ? " clip" : " clips") +
             " in which the body jumps; --keep-glitches keeps them");
  Index room = 0;  // for segments; one alone has nothing to be followed by
  for (const Run& run : corpus.runs) room += (run.length - 2) / min_frames;
  if (room < 2) {
    const auto secs = [&](Index frames) {
      return std::to_string(static_cast<double>(frames) * space.frame_time_secs).substr(0, 4) + " s";
    };
    throw InvalidInput(clips[0].name + (clips.size() > 1 ? " and the others are" : " is") +
                       " too short: the longest usable stretch is " + secs(longest) + ", two segments need " +
                       secs(2 * min_frames + 2) + "; give a longer clip or lower --min-duration");
  }
  corpus.features.resize(row, space.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    corpus.features.middleRows(corpus.runs[i].row, corpus.runs[i].length) = parts[i];
  return corpus;
}

double random_pose_distance(const Corpus& corpus, std::uint64_t seed) {
  constexpr int kPairs = 2001;
  Rng rng(seed);
  const auto n = static_cast<std::uint64_t>(corpus.features.rows());
  std::vector<double> distances(kPairs);
  for (double& d : distances) {
    const auto a = static_cast<Index>(rng.below(n)), b = static_cast<Index>(rng.below(n));
    d = (corpus.features.row(a) - corpus.features.row(b)).norm();
  }
  std::nth_element(distances.begin(), distances.begin() + kPairs / 2, distances.end());
  return distances[kPairs / 2];
}

}  // namespace motex
