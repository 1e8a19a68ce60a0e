// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "motex/particles/blob_fit.h"

namespace motex {

/// Levenberg–Marquardt of the blobs of one cluster in all their parameters. Buffers are kept from one cluster to the
/// next.
class BlobCluster {
 public:
  /// image: what the other blobs leave, read when solve() is called; it and the options must outlive this.
  BlobCluster(const Plane& image, const FitBlobsOptions& options);
  ~BlobCluster();
  BlobCluster(const BlobCluster&) = delete;
  BlobCluster& operator=(const BlobCluster&) = delete;

  void clear();
  void take(const Blob& blob, const BlobPrior& prior);
  /// Whether some blob has moved so far that its neighbours are touched.
  bool solve();
  const Blob& blob(std::size_t k) const;  ///< in the order they were taken

 private:
  struct Solvers;
  std::unique_ptr<Solvers> solvers_;
  bool is_oriented_;
};

}  // namespace motex
