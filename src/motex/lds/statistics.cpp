// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/statistics.h"

#include "motex/core/error.h"
#include "motex/core/gemm.h"

namespace motex {

void LdsStatistics::add(const FrameMatrix& states, Index first, Index length) {
  const Index d = state_size();
  if (states.cols() != d || first < 2 || length < 0 || first + length > states.rows())
    throw InvalidInput("LdsStatistics::add: frames or state size do not fit the series");
  FrameMatrix u(length, 3 * d + 1);
  for (Index lag = 0; lag < 3; ++lag) u.middleCols(lag * d, d) = states.middleRows(first - lag, length);
  u.col(3 * d).setOnes();
  const Index n = u.cols();
  gemm(true, false, n, n, length, 1.0, u.data(), n, u.data(), n, 1.0, moments.data(), n);
}

LdsStatistics& LdsStatistics::operator+=(const LdsStatistics& other) {
  if (moments.size() == 0)
    moments = other.moments;
  else
    moments += other.moments;
  return *this;
}

CentredMoments centred(const LdsStatistics& statistics) {
  const Index n = 3 * statistics.state_size();
  CentredMoments out;
  out.count = statistics.count();
  out.mean = out.count > 0 ? Vector(statistics.moments.col(n).head(n) / out.count) : Vector(Vector::Zero(n));
  out.scatter = statistics.moments.topLeftCorner(n, n) - out.count * out.mean * out.mean.transpose();
  return out;
}

}  // namespace motex
