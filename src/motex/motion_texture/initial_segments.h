// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/job.h"
#include "motex/motion_texture/move_path.h"
#include "motex/motion_texture/texton_fitter.h"

namespace motex {

/// [MT02 4]: a system is fitted to min_frames frames and labels what follows while the mean error of its open-loop
/// prediction from the segment's first two frames stays under threshold (cm); then the system that predicts the next
/// min_frames frames best goes on, or a new one where none is good enough. Labels count from 0.
Segmentation greedy_segments(const Corpus& corpus, const TextonFitter& fitter, double threshold, Index min_frames,
                             Index max_frames, const JobContext& job);

/// Pieces of min_frames, merged while the log Bayes factor of one system against two exceeds threshold (nats). Each
/// piece is compared with the pieces whose residuals under the global system are sized most alike.
Segmentation merged_segments(const Corpus& corpus, const TextonFitter& fitter, double threshold, Index min_frames,
                             const JobContext& job);

/// Pieces of min_frames, the two most alike merged again and again by the log Bayes factor of their paths: while it
/// gains, and on until there are pieces_per_texton pieces a texton.
Segmentation merged_moves(const Corpus& corpus, const MovePaths& paths, double pieces_per_texton, Index min_frames,
                          const JobContext& job);

/// Pieces of min_frames; the last of a run takes what is left. All labelled 0.
Segmentation chop(const Corpus& corpus, Index min_frames);
/// Labels each piece with its group, numbered in order of first appearance.
void name_in_order(const std::vector<int>& groups, Segmentation& pieces);

}  // namespace motex
