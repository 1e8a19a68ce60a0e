// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion_texture/model.h"

namespace motex {

/// Principal subspace of rows (frames × D) [MT02 eq. 12, centred]: state_size directions, or (0) the fewest that hold
/// `share` of the variance, within least … most. Never more than D or the number of rows − 1.
Subspace principal_subspace(const FrameMatrix& rows, Index state_size, double share, Index least, Index most);

/// x = basisᵀ (y − mean) of every row.
FrameMatrix project(const Subspace& subspace, const Eigen::Ref<const FrameMatrix>& rows);

}  // namespace motex
