// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion/contacts.h"

namespace motex {

/// Bends the legs of `clip`, whose body was moved, so that ankles and feet are where they are in `base`, the same
/// frames before: a lowered body goes into its knees. Legs that do not reach are straightened as far as they go. Frames
/// in which a leg's ankle did not move stay as they are.
void keep_feet(const Clip& base, const FootModel& model, Clip& clip);

}  // namespace motex
