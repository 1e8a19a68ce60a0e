// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/lds/lds.h"
#include "motex/lds/statistics.h"
#include "motex/markov/transition_matrix.h"
#include "motex/motion/contacts.h"
#include "motex/motion_texture/features.h"
#include "motex/motion_texture/learn_options.h"

namespace motex {

/// Where the states of a texton live: y = mean + basis · x + what lies outside.
struct Subspace {
  Vector mean;   ///< D
  Matrix basis;  ///< D × d, orthonormal columns
};

/// Consecutive frames of one clip that were learned from.
struct Run {
  int clip_idx = 0;
  Index clip_start = 0;  ///< first frame in the clip
  Index row = 0;         ///< first row in MotionTexture::corpus
  Index length = 0;
};

/// One occurrence of a texton in the examples (the paper's segment): frames start … start + length − 1.
struct Instance {
  int texton = 0;
  int run_idx = 0;
  Index row = 0;  ///< first row in MotionTexture::corpus
  Index length = 0;
  RootPlace place;  ///< of its first frame in the source, so that a dance begins where the dancer stood
};

/// A texton [MT02 3.2]: second-order linear dynamics in a subspace, and the key poses of its instances.
struct Texton {
  Lds dynamics;              ///< fitted with the learner's prior
  LdsStatistics statistics;  ///< of its own frames, so that other priors can be tried
  std::vector<int> instances;
  std::string name = {};  ///< given by a person; empty: none
  bool is_dropped = false;
  int merged_into = -1;  ///< the texton that took its instances

  /// Dropped and merged textons keep their number, but have no instance.
  bool is_playable() const { return !instances.empty(); }
};

/// A person's change to the distribution of a learned model (model_edits.h). Textons go by their numbers, which stay.
struct ModelEdit {
  enum class Kind { kName, kDrop, kKeep, kMerge, kWeight };
  Kind kind = Kind::kName;
  /// kName: the texton. kDrop, kKeep: those. kMerge: the first takes the instances of the others. kWeight: from (−1:
  /// any texton), to.
  std::vector<int> textons = {};
  double factor = 1;      ///< kWeight: of the transition's count; 0 forbids it
  std::string name = {};  ///< kName; empty takes the name away

  bool operator==(const ModelEdit&) const = default;
};

/// The learned model: read-only for synthesis, playback and the studio.
struct MotionTexture {
  FeatureSpace features;
  std::vector<std::string> clip_names;
  std::vector<Index> clip_lengths;  ///< frames as read
  FrameMatrixF corpus;              ///< frames × D: weighted features of all runs, one after another
  Vector heights;                   ///< frames: channel 2 unrounded, so that ends are met; empty: as in corpus
  std::vector<Run> runs;
  std::vector<Subspace> subspaces;  ///< one (shared basis), or one a texton (own basis)
  std::vector<Texton> textons;
  std::vector<Instance> instances;  ///< in the order of corpus rows
  TransitionMatrix transitions;     ///< between textons, the jumps that close dead ends included
  double outside_deviation = 1;     ///< s, cm: deviation of what lies outside the subspace, per dimension
  Subspace global_subspace;         ///< of the one global LDS, kept for score
  LdsStatistics global_statistics;  ///< its moments: also the prior of every texton with a shared basis
  FootModel feet;
  LearnOptions options;
  std::vector<ModelEdit> edits;      ///< in the order in which they were made
  bool edits_applied = false;        ///< false: all else is as it was learned, which is what files hold
  TransitionMatrix unweighted;       ///< transitions before edits weighed them; without states when none did
  std::vector<double> visit_ratios;  ///< a texton: how much oftener its visits are than by unweighted; empty: all 1

  const Subspace& subspace(int texton) const {
    return subspaces[subspaces.size() == 1 ? 0 : static_cast<std::size_t>(texton)];
  }
  double frame_time_secs() const { return features.frame_time_secs; }
};

}  // namespace motex
