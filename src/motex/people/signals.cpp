// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/quantile.h"

namespace motex {
namespace {

struct SignalKind {
  const char* name;
  const char* unit;
  double (*value)(const Silhouette&);
};

constexpr std::array<SignalKind, 13> kKinds{{
    {"aspect", "", [](const Silhouette& s) { return s.aspect(); }},
    {"area", "px²", [](const Silhouette& s) { return s.area; }},
    {"width", "px", [](const Silhouette& s) { return static_cast<double>(s.box.width()); }},
    {"height", "px", [](const Silhouette& s) { return static_cast<double>(s.box.height()); }},
    {"centroid_x", "px", [](const Silhouette& s) { return s.centroid_x; }},
    {"centroid_y", "px", [](const Silhouette& s) { return s.centroid_y; }},
    {"mu20", "", [](const Silhouette& s) { return s.mu20; }},
    {"mu11", "", [](const Silhouette& s) { return s.mu11; }},
    {"mu02", "", [](const Silhouette& s) { return s.mu02; }},
    {"mu30", "", [](const Silhouette& s) { return s.mu30; }},
    {"mu21", "", [](const Silhouette& s) { return s.mu21; }},
    {"mu12", "", [](const Silhouette& s) { return s.mu12; }},
    {"mu03", "", [](const Silhouette& s) { return s.mu03; }},
}};

void check_takes(const PeopleTexture& texture) {
  int end = 0;
  for (const Take& take : texture.takes) {
    if (take.frames.start != end || take.frames.length < 0) throw InvalidInput("takes do not follow one another");
    end = take.frames.end();
  }
  if (end != texture.num_frames())
    throw InvalidInput("takes have " + std::to_string(end) + " frames, but there are " +
                       std::to_string(texture.num_frames()) + " silhouettes");
}

/// Splits takes where nobody is for longer than `longest_gap` frames; ends without a person are cut off.
void find_stretches(const PeopleTexture& texture, int longest_gap, PeopleSignals& out) {
  for (const Take& take : texture.takes) {
    int seen = -1;
    for (int t = take.frames.start; t < take.frames.end(); ++t) {
      if (texture.silhouettes[static_cast<std::size_t>(t)].empty()) continue;
      const int gap = t - seen - 1;
      if (seen < 0 || gap > longest_gap) {
        out.stretches.push_back({t, 0});
      } else if (gap > 0) {
        out.bridged.push_back({seen + 1, gap});
      }
      seen = t;
      out.stretches.back().length = t + 1 - out.stretches.back().start;
    }
  }
}

void bridge(std::vector<double>& values, const std::vector<FrameSpan>& gaps) {
  for (const FrameSpan& gap : gaps) {
    const double before = values[static_cast<std::size_t>(gap.start - 1)];
    const double after = values[static_cast<std::size_t>(gap.end())];
    for (int k = 1; k <= gap.length; ++k)
      values[static_cast<std::size_t>(gap.start + k - 1)] = before + (after - before) * k / (gap.length + 1);
  }
}

/// Gaussian inside one stretch; weights of what lies beyond its ends are left out.
void smooth(std::vector<double>& values, const FrameSpan& span, double deviation) {
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> kernel(static_cast<std::size_t>(reach) + 1);
  for (int k = 0; k <= reach; ++k)
    kernel[static_cast<std::size_t>(k)] = std::exp(-0.5 * (k / deviation) * (k / deviation));
  const std::vector<double> old(values.begin() + span.start, values.begin() + span.end());
  for (int t = 0; t < span.length; ++t) {
    double sum = 0, total = 0;
    for (int s = std::max(0, t - reach); s <= std::min(span.length - 1, t + reach); ++s) {
      const double weight = kernel[static_cast<std::size_t>(std::abs(s - t))];
      sum += weight * old[static_cast<std::size_t>(s)];
      total += weight;
    }
    values[static_cast<std::size_t>(span.start + t)] = sum / total;
  }
}

constexpr std::array<std::string_view, 8> kMotifSignals{"aspect", "area", "centroid_x", "centroid_y",
                                                        "mu11",   "mu30", "mu21",       "mu03"};
constexpr double kMotifSmoothSecs = 0.04;
constexpr double kMovementSecs = 2;

/// Root mean square deviation from the means of windows of that length, half overlapping.
double movement_of(const std::vector<double>& values, const std::vector<FrameSpan>& stretches, int window) {
  double squares = 0, count = 0;
  for (const FrameSpan& span : stretches) {
    const int length = std::min(window, span.length), step = std::max(1, length / 2);
    for (int start = span.start; start + length <= span.end(); start += step) {
      double sum = 0, sum_squares = 0;
      for (int t = start; t < start + length; ++t) sum += values[static_cast<std::size_t>(t)];
      const double mean = sum / length;
      for (int t = start; t < start + length; ++t) {
        const double d = values[static_cast<std::size_t>(t)] - mean;
        sum_squares += d * d;
      }
      squares += sum_squares, count += length;
    }
  }
  return count == 0 ? 0 : std::sqrt(squares / count);
}

/// Of white noise: third differences have 20 times its variance, movement hardly any.
double noise_of(const std::vector<double>& values, const std::vector<FrameSpan>& stretches) {
  std::vector<double> differences;
  for (const FrameSpan& span : stretches)
    for (int t = span.start; t + 3 < span.end(); ++t) {
      const double* x = values.data() + t;
      differences.push_back(std::abs(x[3] - 3 * x[2] + 3 * x[1] - x[0]));
    }
  return differences.empty() ? 0 : quantile(std::move(differences), 0.5) / (0.6745 * std::sqrt(20.0));
}

/// Inverse movement times the share that is no noise; 0 for what is half noise.
double weight_of(const std::vector<double>& values, const std::vector<FrameSpan>& stretches, int window) {
  const double movement = movement_of(values, stretches, window), noise = noise_of(values, stretches);
  // Below this nothing moves but the last digits.
  if (movement < 1e-9 || noise * noise > 0.5 * movement * movement) return 0;
  return std::sqrt(1 - noise * noise / (movement * movement)) / movement;
}

/// √ of the median area of each take.
std::vector<double> body_sizes(const PeopleTexture& texture) {
  std::vector<double> sizes;
  for (const Take& take : texture.takes) {
    std::vector<double> areas;
    for (int t = take.frames.start; t < take.frames.end(); ++t)
      if (const Silhouette& one = texture.silhouettes[static_cast<std::size_t>(t)]; !one.empty())
        areas.push_back(one.area);
    sizes.push_back(areas.empty() ? 1 : std::sqrt(quantile(std::move(areas), 0.5)));
  }
  return sizes;
}

void take_out_units(Signal& signal, const PeopleTexture& texture, const std::vector<double>& sizes) {
  if (signal.name == "aspect" || signal.name == "area") {
    for (double& value : signal.values) value = std::log(value);
  } else if (signal.unit == "px") {
    for (std::size_t k = 0; k < texture.takes.size(); ++k)
      for (int t = texture.takes[k].frames.start; t < texture.takes[k].frames.end(); ++t)
        signal.values[static_cast<std::size_t>(t)] /= sizes[k];
  }
  signal.unit.clear();
}

int frames_of(double secs, double frames_per_sec) { return static_cast<int>(std::lround(secs * frames_per_sec)); }

}  // namespace

PeopleSignals measure_signals(const PeopleTexture& texture, const SignalOptions& options) {
  check_options(options);
  check_takes(texture);
  PeopleSignals out;
  find_stretches(texture, frames_of(options.bridge_secs, texture.frames_per_sec), out);
  if (out.stretches.empty()) throw InvalidInput("nobody is to be seen in any frame: the matte is empty");
  for (const SignalKind& kind : kKinds) {
    Signal signal{kind.name, kind.unit, {}};
    signal.values.reserve(texture.silhouettes.size());
    for (const Silhouette& silhouette : texture.silhouettes)
      signal.values.push_back(silhouette.empty() ? std::numeric_limits<double>::quiet_NaN() : kind.value(silhouette));
    bridge(signal.values, out.bridged);
    if (options.smooth_secs > 0)
      for (const FrameSpan& span : out.stretches)
        smooth(signal.values, span, options.smooth_secs * texture.frames_per_sec);
    out.signals.push_back(std::move(signal));
  }
  return out;
}

const Signal& signal_named(const PeopleSignals& signals, const std::string& name) {
  std::string known;
  for (const Signal& signal : signals.signals) {
    if (signal.name == name) return signal;
    known += (known.empty() ? "" : ", ") + signal.name;
  }
  throw InvalidInput("there is no signal '" + name + "'; there are " + known);
}

MotifSignals default_motif_signals(const PeopleTexture& texture) {
  PeopleSignals measured = measure_signals(texture);
  const std::vector<double> sizes = body_sizes(texture);
  const int window = std::max(4, frames_of(kMovementSecs, texture.frames_per_sec));
  MotifSignals out;
  out.stretches = measured.stretches;
  for (Signal& signal : measured.signals) {
    if (std::find(kMotifSignals.begin(), kMotifSignals.end(), signal.name) == kMotifSignals.end()) continue;
    take_out_units(signal, texture, sizes);
    const double weight = weight_of(signal.values, out.stretches, window);
    for (const FrameSpan& span : out.stretches) smooth(signal.values, span, kMotifSmoothSecs * texture.frames_per_sec);
    for (double& value : signal.values) value = std::isnan(value) ? 0 : weight * value;
    out.weights.push_back(weight);
    out.signals.push_back(std::move(signal));
  }
  return out;
}

MotifSignals paper_motif_signals(const PeopleTexture& texture) {
  PeopleSignals measured = measure_signals(texture);
  MotifSignals out{{std::move(measured.signals[0])}, {1}, std::move(measured.stretches)};
  for (double& value : out.signals[0].values)
    if (std::isnan(value)) value = 0;
  return out;
}

}  // namespace motex
