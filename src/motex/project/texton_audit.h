// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion_texture/model.h"
#include "motex/plot/drawing.h"

namespace motex {

/// Do textons recur? A row a texton, its segments side by side, each as stick figures over its first T_min: a row
/// should show one move. Textons by falling number of segments, kAuditRows a page, pages from 0; segments in the order
/// of the corpus, kAuditColumns a line, at most kAuditSegments. Throws InvalidInput for a page beyond the last.
Drawing texton_audit(const MotionTexture& model, int page = 0);
int num_audit_pages(const MotionTexture& model);

constexpr int kAuditRows = 10;
constexpr int kAuditColumns = 8;
constexpr std::size_t kAuditSegments = 160;

}  // namespace motex
