// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/core/matrix.h"
#include "motex/people/motifs.h"
#include "motex/people/people_texture.h"
#include "motex/people/signals.h"

namespace motex {

/// The signals as rows = frames, columns = signals; those of weight 0 are left out.
FrameMatrix motif_series(const MotifSignals& signals);

/// The action alphabet of footage: what repeats in default_motif_signals(), inside takes, never across a cut. Starts
/// are frames of the people texture. options.frames_per_sec is the texture's. Where nothing moves at all everything is
/// idle. Throws InvalidInput: nobody is to be seen; and what find_motifs throws. [PT04] section 2.2
MotifReport find_footage_motifs(const PeopleTexture& texture, FindMotifsOptions options = {},
                                const JobContext& job = {});

}  // namespace motex
