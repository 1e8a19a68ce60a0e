// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/lds/lds.h"

/// Systems and series with known truth, for tests and benchmarks.
namespace motex {

/// n independent standard normals.
Vector normal_vector(Rng& rng, Index n);

/// A stable system whose states oscillate and decay: spectral radius about 0.97, noise of mixed size.
Lds random_lds(Rng& rng, Index state_size);

/// num_frames × d states of the system, after a warm-up, so that the start is typical.
FrameMatrix sample_states(const Lds& lds, Rng& rng, Index num_frames);

}  // namespace motex
