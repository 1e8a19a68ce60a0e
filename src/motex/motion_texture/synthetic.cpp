// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/synthetic.h"

#include <algorithm>
#include <map>
#include <string>

#include "motex/core/rng.h"
#include "motex/lds/synthetic.h"
#include "motex/motion/stick_figure.h"
#include "motex/motion_texture/learn.h"

namespace motex {
namespace {

/// Orthonormal columns by Gram and Schmidt.
Matrix random_basis(Rng& rng, Index dims, Index size) {
  Matrix basis(dims, size);
  for (Index c = 0; c < size; ++c) {
    Vector v = normal_vector(rng, dims);
    for (int twice = 0; twice < 2; ++twice) v -= basis.leftCols(c) * (basis.leftCols(c).transpose() * v).eval();
    basis.col(c) = v.normalized();
  }
  return basis;
}

std::vector<int> labels_of(const Segmentation& segments) {
  std::vector<int> labels;
  for (const LabelledSegment& s : segments) {
    labels.resize(std::max(labels.size(), static_cast<std::size_t>(s.row + s.length)), -1);
    std::fill_n(labels.begin() + s.row, s.length, s.texton);
  }
  return labels;
}

}  // namespace

PlantedCorpus planted_corpus(const PlantedCorpusOptions& options) {
  Rng rng(options.seed);
  PlantedCorpus out;
  for (int i = 0; i < options.num_systems; ++i) out.systems.push_back(random_lds(rng, options.state_size));
  out.subspace = {10 * normal_vector(rng, options.num_features),
                  random_basis(rng, options.num_features, options.state_size)};
  Index row = 0;
  int texton = 0;
  for (int r = 0; r < options.num_runs; ++r) {
    const Index start = row;
    for (int s = 0; s < options.segments_per_run; ++s) {
      const auto span = static_cast<std::uint64_t>(options.max_frames - options.min_frames + 1);
      const Index length = options.min_frames + static_cast<Index>(rng.below(span));
      out.segments.push_back({texton, r, row, length});
      row += length;
      const auto others = static_cast<std::uint64_t>(std::max(1, options.num_systems - 1));
      texton = (texton + 1 + static_cast<int>(rng.below(others))) % options.num_systems;
    }
    out.corpus.runs.push_back({r, 0, start, row - start});
  }
  FrameMatrix states = FrameMatrix::Zero(row, options.state_size);
  for (const LabelledSegment& s : out.segments) {
    const Lds& system = out.systems[static_cast<std::size_t>(s.texton)];
    const bool first = out.corpus.runs[static_cast<std::size_t>(s.run_idx)].row == s.row;
    if (first)
      states.middleRows(s.row, s.length) = sample_states(system, rng, s.length);
    else
      simulate(system, states.middleRows(s.row - 2, s.length + 2), &rng);
  }
  out.corpus.features = (states * out.subspace.basis.transpose()).rowwise() + out.subspace.mean.transpose();
  for (Index t = 0; t < row; ++t) {
    const Vector noise = options.outside * normal_vector(rng, options.num_features);
    out.corpus.features.row(t) += (noise - out.subspace.basis * (out.subspace.basis.transpose() * noise)).transpose();
  }
  return out;
}

double label_agreement(const Segmentation& found, const Segmentation& planted, Index margin) {
  const std::vector<int> names = labels_of(found);
  std::map<int, std::map<int, Index>> shared;
  Index counted = 0, right = 0;
  for (const LabelledSegment& s : planted)
    for (Index t = s.row + margin; t < s.row + s.length - margin; ++t) {
      ++counted;
      ++shared[names.at(static_cast<std::size_t>(t))][s.texton];
    }
  for (const auto& [name, truths] : shared) {
    Index most = 0;
    for (const auto& [truth, frames] : truths) most = std::max(most, frames);
    right += most;
  }
  return static_cast<double>(right) / static_cast<double>(std::max<Index>(counted, 1));
}

std::vector<Clip> walking_clips(int count, Index num_frames) {
  std::vector<Clip> clips;
  for (int i = 0; i < count; ++i) {
    StickFigureOptions options;
    options.num_frames = num_frames;
    options.speed = 80 + 30 * (i % 3);
    options.turn_rate = 0.2 * (i % 4);
    options.noise = 0.1;
    options.seed = static_cast<std::uint64_t>(i + 1);
    clips.push_back(walk_stick_figure(options).clip);
    clips.back().name = "walk_" + std::to_string(i) + ".bvh";
  }
  return clips;
}

const std::vector<Clip>& sample_clips() {
  static const std::vector<Clip> clips = walking_clips(4, 500);
  return clips;
}

const MotionTexture& sample_model() {
  static const MotionTexture model = [] {
    LearnOptions options;
    options.state_size = 8;
    options.init = Init::kGreedy;
    LearnReport report;
    return learn_motion_texture(sample_clips(), options, report);
  }();
  return model;
}

}  // namespace motex
