// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/particles/quantised_clip.h"

namespace motex {

/// A clip in bytes (docs/formats.md, "Compressed clip"): header, background (plane_codec.h), then frame by frame
///   for each living element: whether it goes on; if so its state minus the one expected — place + φ velocity +
///   (1 − φ) mean velocity of all, the rest unchanged — each number by an adaptive model (range_coder.h);
///   the elements born: block of 8 × 8 pixels, kind, scale, coefficient, angle, place in the block, coils;
/// and a checksum. Everything that decoding needs is in it. Cables come back in the order of sort_for_coding().
/// Throws InvalidInput when a number is out of range.
std::string write_clip_bytes(const QuantisedClip& clip, const Planes& background);

/// Safe for bytes from strangers: memory stays within a few hundred times their number and 200 MB of background.
/// Throws ParseError (with the byte) when cut off, altered or foreign, UnsupportedFile for a newer version.
QuantisedClip read_clip_bytes(const std::string& bytes, const std::string& name);

}  // namespace motex
