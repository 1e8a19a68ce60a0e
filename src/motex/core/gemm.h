// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/matrix.h"

namespace motex {

/// C = alpha · op(A) · op(B) + beta · C, row-major, single or double precision, one thread.
/// op(A) is m × k, op(B) k × n, C m × n; ld* = elements from one row to the next.
/// The BLAS behind it chooses AVX2 or AVX-512 code when the program starts. Cost 2·m·n·k.
void gemm(bool transpose_a, bool transpose_b, Index m, Index n, Index k, float alpha, const float* a, Index lda,
          const float* b, Index ldb, float beta, float* c, Index ldc);
void gemm(bool transpose_a, bool transpose_b, Index m, Index n, Index k, double alpha, const double* a, Index lda,
          const double* b, Index ldb, double beta, double* c, Index ldc);

/// Name and chosen kernel of the BLAS, for `motex doctor`.
const char* gemm_backend();

}  // namespace motex
