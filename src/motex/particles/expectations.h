// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/particles/detect_cores.h"
#include "motex/particles/element_filter.h"
#include "motex/particles/link_sights.h"

namespace motex {

using BlobFrames = std::vector<std::vector<Blob>>;

/// What was found where the k-th sight of a path is.
inline const Blob& blob_at(const BlobFrames& blobs, const SightChain& chain, std::size_t k) {
  return blobs[static_cast<std::size_t>(chain.sights[k].frame)][static_cast<std::size_t>(chain.idx[k])];
}

struct ExpectationOptions {
  int width = 0, height = 0;  ///< of the picture
  bool is_oriented = false;
  int reach_out = 2;  ///< frames before and after a path where it is always looked for
  int farthest = 16;  ///< and where its place is known well
};

/// Looks and places that paths lead one to expect: in the frames they cross, in their gaps, and before and after them
/// as far as their places are known well.
class Expectations {
 public:
  /// num_found: blobs of each frame that were found in the picture; those behind them only say where a path begins.
  /// What is given must outlive this.
  Expectations(const BlobFrames& blobs, std::vector<std::size_t> num_found, const ElementModel& model,
               const ExpectationOptions& options);

  void add(const SightChain& chain);
  const std::vector<ExpectedBlob>& at(int frame) const { return frames_[static_cast<std::size_t>(frame)]; }

 private:
  double typical(const SightChain& chain, std::size_t k, double Blob::*field, double& deviation) const;
  void set_prior(const SightChain& chain, const SmoothedPlace& place, std::size_t k, ExpectedBlob& one) const;
  bool is_known(const SightChain& chain, const SmoothedPlace& place, int frame) const;

  const BlobFrames& blobs_;
  std::vector<std::size_t> num_found_;
  const ElementModel& model_;
  ExpectationOptions options_;
  std::vector<std::vector<ExpectedBlob>> frames_;
};

}  // namespace motex
