// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

/// On a function with loops that the compiler turns into vector code: compiled for any x86-64 and for AVX2, chosen when
/// the program starts. Both give the same bytes: contraction is off, and sums that would have to be reordered stay in
/// order. What it calls must be inline.
#if defined(__x86_64__) && defined(__linux__)
#define MOTEX_WIDE __attribute__((target_clones("default", "avx2")))
#else
#define MOTEX_WIDE
#endif
