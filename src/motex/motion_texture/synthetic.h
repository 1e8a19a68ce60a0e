// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion_texture/corpus.h"
#include "motex/motion_texture/model.h"

/// Corpora and models with known truth, for tests and benchmarks.
namespace motex {

struct PlantedCorpusOptions {
  int num_systems = 3;
  Index state_size = 3;
  Index num_features = 8;  ///< D
  int num_runs = 2;
  int segments_per_run = 12;
  Index min_frames = 60, max_frames = 120;  ///< of a segment
  double outside = 1;                       ///< deviation of what lies outside the subspace, per dimension
  std::uint64_t seed = 1;
};

/// Several systems that take turns, seen through one orthonormal basis, with noise outside it.
struct PlantedCorpus {
  Corpus corpus;
  Segmentation segments;  ///< the truth; neighbours differ
  std::vector<Lds> systems;
  Subspace subspace;
};
PlantedCorpus planted_corpus(const PlantedCorpusOptions& options = {});

/// Share of frames that carry the right label, names of labels apart: each found label stands for the planted one with
/// which it shares most frames. Frames within margin of a planted boundary are not counted.
double label_agreement(const Segmentation& found, const Segmentation& planted, Index margin);

/// Clips of a walking stick figure: the speed and the turning change from clip to clip.
std::vector<Clip> walking_clips(int count, Index num_frames);

/// Four of them, walk_0.bvh … walk_3.bvh, of 500 frames, and what was learned from them; made once.
const std::vector<Clip>& sample_clips();
const MotionTexture& sample_model();

}  // namespace motex
