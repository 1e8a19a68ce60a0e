// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/quantile.h"
#include "motex/particles/blob_peaks.h"
#include "motex/particles/detect_cores.h"

namespace motex {
namespace {

constexpr std::size_t kSampleFrames = 7;
constexpr double kCrowded = 0.15;  // share of the picture within two scales of a peak
constexpr double kOneSignedCrowded = 0.6;
constexpr double kOneSigned = 0.8;        // share of the energy that makes a clip bright (or dark)
constexpr double kOrientedAspect = 1.25;  // median aspect of the strongest elements
constexpr double kCrowdedAspect = 1.6;    // lower quartile of it where they overlap
constexpr double kMinNoise = 0.5;

std::vector<Plane> sample_of(const std::vector<Plane>& residuals) {
  std::vector<Plane> sample;
  const std::size_t num = std::min(kSampleFrames, residuals.size());
  for (std::size_t k = 0; k < num; ++k) sample.push_back(residuals[(2 * k + 1) * residuals.size() / (2 * num)]);
  return sample;
}

CoreSign sign_of(const std::vector<BlobPeak>& peaks, double share) {
  double bright = 0, all = 0;
  for (const BlobPeak& peak : peaks) {
    const double energy = peak.response * peak.response;
    all += energy;
    if (peak.amplitude > 0) bright += energy;
  }
  if (bright >= share * all) return CoreSign::kBright;
  return bright <= (1 - share) * all ? CoreSign::kDark : CoreSign::kBoth;
}

/// The amplitude above which half of the energy lies.
double main_amplitude(std::vector<BlobPeak> peaks, CoreSign sign) {
  std::erase_if(peaks, [&](const BlobPeak& peak) {
    return (sign == CoreSign::kBright && peak.amplitude < 0) || (sign == CoreSign::kDark && peak.amplitude > 0);
  });
  std::sort(peaks.begin(), peaks.end(),
            [](const BlobPeak& a, const BlobPeak& b) { return std::abs(a.amplitude) > std::abs(b.amplitude); });
  double all = 0, sum = 0;
  for (const BlobPeak& peak : peaks) all += peak.response * peak.response;
  for (const BlobPeak& peak : peaks) {
    sum += peak.response * peak.response;
    if (2 * sum >= all) return std::abs(peak.amplitude);
  }
  return 0;
}

bool stands_alone(const std::vector<Blob>& blobs, std::size_t k) {
  for (std::size_t m = 0; m < blobs.size(); ++m)
    if (m != k &&
        std::hypot(blobs[k].x - blobs[m].x, blobs[k].y - blobs[m].y) < 4 * (blobs[k].scale() + blobs[m].scale()))
      return false;
  return true;
}

/// The stronger half of the spots that stand alone, fitted as ellipses.
std::vector<Blob> outstanding(const Plane& residual, double noise, const DetectOptions& options,
                              std::vector<double>& misfits) {
  const bool is_both = options.sign == CoreSign::kBoth;
  const Plane image = options.sign == CoreSign::kDark ? negated(residual) : residual;
  FitBlobsOptions fit{noise, true, 0.8 * options.min_scale, 1.25 * options.max_scale};
  BlobFitter fitter(image, fit);
  for (const BlobPeak& peak :
       find_blob_peaks(image, options.max_scale, 2 * options.min_significance * noise, is_both)) {
    bool is_near = false;
    for (const Blob& other : fitter.blobs())
      is_near = is_near || std::hypot(other.x - peak.x, other.y - peak.y) < 2 * std::max(other.scale(), peak.scale);
    if (!is_near && fitter.blobs().size() < 200)
      fitter.add({peak.x, peak.y, std::log(peak.scale), 0, 0, peak.amplitude});
  }
  fitter.fit(2);
  std::vector<double> energies;
  for (const Blob& blob : fitter.blobs()) energies.push_back(blob.energy_root());
  const double least = median(energies);
  std::vector<Blob> out;
  for (std::size_t k = 0; k < fitter.blobs().size(); ++k) {
    const Blob& blob = fitter.blobs()[k];
    if (blob.energy_root() < least || !stands_alone(fitter.blobs(), k)) continue;
    out.push_back(blob);
    misfits.push_back(std::sqrt(std::max(0.0, fitter.misfit(k) - noise * noise)) / std::abs(blob.amplitude));
  }
  return out;
}

}  // namespace

double noise_of(const std::vector<Plane>& residuals) {
  if (residuals.empty()) throw InvalidInput("the noise of no frames cannot be measured");
  std::vector<double> sizes;
  std::size_t num = 0;
  for (const Plane& plane : residuals) num += plane.values.size();
  const std::size_t stride = std::max<std::size_t>(1, num / 400000) | 1;  // odd: not the columns of a picture alone
  for (const Plane& plane : residuals)
    for (std::size_t i = 0; i < plane.values.size(); i += stride)
      sizes.push_back(std::abs(static_cast<double>(plane.values[i])));
  return std::max(kMinNoise, 1.4826 * median(std::move(sizes)));
}

DetectOptions decided(const DetectOptions& options, const std::vector<Plane>& residuals, double noise) {
  DetectOptions out = options;
  const std::vector<Plane> sample = sample_of(residuals);
  std::vector<BlobPeak> peaks;
  for (const Plane& residual : sample) {
    const std::vector<BlobPeak> here =
        find_blob_peaks(residual, options.max_scale, options.min_significance * noise, true);
    peaks.insert(peaks.end(), here.begin(), here.end());
  }
  // Where elements cover much of the picture the background is biased, and many that look elongated are two.
  double covered = 0, area = 1;
  for (const BlobPeak& peak : peaks) covered += std::numbers::pi * 4 * peak.scale * peak.scale;
  for (const Plane& residual : sample) area += static_cast<double>(residual.values.size());
  const bool is_crowded = covered > kCrowded * area;
  if (out.sign == CoreSign::kAuto) out.sign = sign_of(peaks, is_crowded ? kOneSignedCrowded : kOneSigned);
  out.min_amplitude = kFaintShare * main_amplitude(peaks, out.sign);
  std::vector<double> aspects, misfits;
  for (const Plane& residual : sample)
    for (const Blob& blob : outstanding(residual, noise, out, misfits)) aspects.push_back(blob.aspect());
  if (out.shape == CoreShape::kAuto) {
    const double aspect = aspects.empty() ? 1 : quantile(aspects, is_crowded ? 0.25 : 0.5);
    out.shape = aspect > (is_crowded ? kCrowdedAspect : kOrientedAspect) ? CoreShape::kOriented : CoreShape::kRound;
  }
  out.shape_misfit = std::min(0.3, median(misfits));
  return out;
}

}  // namespace motex
