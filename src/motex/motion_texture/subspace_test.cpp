// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/subspace.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

TEST(Subspace, NeedsTwoFrames) {
  EXPECT_THROW(principal_subspace(FrameMatrix::Zero(1, 4), 2, 0.99, 2, 30), InvalidInput);
  EXPECT_THROW(principal_subspace(FrameMatrix::Zero(0, 4), 2, 0.99, 2, 30), InvalidInput);
}

TEST(Subspace, FindsThePlantedOne) {
  PlantedCorpusOptions options;
  options.outside = 0.01;
  const PlantedCorpus planted = planted_corpus(options);
  const FrameMatrix& y = planted.corpus.features;
  const Subspace found = principal_subspace(y, 3, 0, 0, 0);
  const Matrix& basis = found.basis;
  EXPECT_LT((basis.transpose() * basis - Matrix::Identity(3, 3)).norm(), 1e-12);
  EXPECT_LT((planted.subspace.basis - basis * (basis.transpose() * planted.subspace.basis)).norm(), 0.01);
  EXPECT_LT((found.mean - y.colwise().mean().transpose()).norm(), 1e-10);
  const FrameMatrix x = project(found, y);
  EXPECT_LT((x - (y.rowwise() - found.mean.transpose()) * basis).cwiseAbs().maxCoeff(), 1e-10);
  const FrameMatrix part = y.middleRows(17, 5);
  EXPECT_LT((project(found, y.middleRows(17, 5)) - project(found, part)).norm(), 1e-10);
}

TEST(Subspace, SizeHoldsTheShareWithinItsLimits) {
  FrameMatrix rows = FrameMatrix::Zero(200, 4);
  const double deviations[] = {10, 5, 1, 0.1};
  for (Index t = 0; t < 200; ++t) rows(t, t % 4) = deviations[t % 4] * ((t / 4) % 2 == 0 ? 1 : -1);
  EXPECT_EQ(principal_subspace(rows, 0, 0.79, 1, 4).basis.cols(), 1);  // 100 : 25 : 1 : 0.01
  EXPECT_EQ(principal_subspace(rows, 0, 0.98, 1, 4).basis.cols(), 2);
  EXPECT_EQ(principal_subspace(rows, 0, 0.995, 1, 4).basis.cols(), 3);
  EXPECT_EQ(principal_subspace(rows, 0, 0.995, 1, 2).basis.cols(), 2);
  EXPECT_EQ(principal_subspace(rows, 0, 0.5, 3, 4).basis.cols(), 3);
  EXPECT_EQ(principal_subspace(rows, 9, 0.5, 3, 4).basis.cols(), 4) << "never more than D";
  EXPECT_EQ(principal_subspace(rows.topRows(3), 4, 0.5, 3, 4).basis.cols(), 2) << "nor than frames − 1";
}

TEST(Subspace, OfFramesThatAreAllAlike) {
  const Subspace space = principal_subspace(FrameMatrix::Constant(50, 5, 3.0), 0, 0.995, 2, 30);
  EXPECT_EQ(space.basis.cols(), 2);
  EXPECT_TRUE(space.basis.allFinite());
  EXPECT_LT((space.mean - Vector::Constant(5, 3.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace motex
