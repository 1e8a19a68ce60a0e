// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/length_unit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace motex {
namespace {

constexpr double kLargestDifference = 0.05;  // of a bone's length
constexpr double kShortBone = 0.01;          // of all bones together: the length that counts at least
constexpr double kLeastFactor = 1.5;         // what a change of unit is at least; bodies differ by less
constexpr double kSameUnit = 1e-6;

/// Least-squares ratio of the bones of two skeletons; 0 when they have none, or are not of one shape.
double ratio_of_bones(const Skeleton& from, const Skeleton& to) {
  double product = 0, square = 0, sum = 0;
  for (std::size_t j = 0; j < from.joints.size(); ++j) {
    if (from.joints[j].parent_idx < 0) continue;
    product += from.joints[j].offset.dot(to.joints[j].offset);
    square += from.joints[j].offset.squaredNorm();
    sum += to.joints[j].offset.norm();
  }
  if (!(square > 0 && product > 0)) return 0;
  const double ratio = product / square;
  for (std::size_t j = 0; j < from.joints.size(); ++j) {
    if (from.joints[j].parent_idx < 0) continue;
    const Vector3& wanted = to.joints[j].offset;
    const double most = kLargestDifference * std::max(wanted.norm(), kShortBone * sum);
    if ((ratio * from.joints[j].offset - wanted).norm() > most) return 0;
  }
  return ratio;
}

}  // namespace

double metres_per_unit(LengthUnit unit) {
  static constexpr double kMetres[] = {0, 1, 0.01, 0.001, 0.0254, 0.3048};
  return kMetres[static_cast<std::size_t>(unit)];
}

void scale_lengths(Clip& clip, double factor) {
  for (Joint& joint : clip.skeleton.joints) joint.offset *= factor;
  for (EndSite& site : clip.skeleton.end_sites) site.offset *= factor;
  clip.skeleton.metres_per_unit /= factor;
  clip.translations *= factor;
}

double units_per_unit(const Skeleton& from, const Skeleton& to) {
  if (from.metres_per_unit > 0 && to.metres_per_unit > 0) {
    const double factor = from.metres_per_unit / to.metres_per_unit;
    return std::abs(factor - 1) > kSameUnit ? factor : 1;
  }
  const double factor = ratio_of_bones(from, to);
  return factor > kLeastFactor || (factor > 0 && factor < 1 / kLeastFactor) ? factor : 1;
}

void match_unit(Clip& clip, const Skeleton& to, const JobContext& job) {
  const double factor = units_per_unit(clip.skeleton, to);
  if (factor == 1) return;
  scale_lengths(clip, factor);
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", factor);
  job.warn(clip.name + ": is in another unit of length; its lengths were multiplied by " + text);
}

}  // namespace motex
