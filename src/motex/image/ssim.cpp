// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/ssim.h"

#include "motex/core/error.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr double kSigma = 1.5;
constexpr float kC1 = 2.55F * 2.55F, kC2 = 7.65F * 7.65F;

Plane product(const Plane& a, const Plane& b) {
  Plane out = a;
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] *= b.values[i];
  return gaussian_blur(out, kSigma);
}

}  // namespace

Plane ssim_map(const Plane& a, const Plane& b) {
  if (a.width != b.width || a.height != b.height)
    throw InvalidInput("structural similarity needs pictures of one size");
  if (a.values.empty()) return {};
  const Plane mean_a = gaussian_blur(a, kSigma), mean_b = gaussian_blur(b, kSigma);
  const Plane aa = product(a, a), bb = product(b, b), ab = product(a, b);
  Plane out(a.width, a.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const float ma = mean_a.values[i], mb = mean_b.values[i];
    const float va = aa.values[i] - ma * ma, vb = bb.values[i] - mb * mb, covariance = ab.values[i] - ma * mb;
    out.values[i] = (2 * ma * mb + kC1) * (2 * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (va + vb + kC2));
  }
  return out;
}

}  // namespace motex
