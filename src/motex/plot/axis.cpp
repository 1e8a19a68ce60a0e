// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace motex {
namespace {

std::string format(const char* pattern, int precision, double value) {
  char text[48];
  std::snprintf(text, sizeof text, pattern, precision, value);
  return text;
}

/// As many decimals as multiples of `step` need, or the exponent's way for numbers far from 1.
std::string tick_text(double value, double step) {
  if (std::abs(value) < step * 1e-6) return "0";
  const double size = std::abs(value);
  if (size >= 1e6 || size < 1e-4) return format("%.*g", 3, value);
  return format("%.*f", std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))), value);
}

double nice_step(double rough) {
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power * 1.0001) return factor * power;
  return 10 * power;
}

Scale linear_scale(const Axis& axis, double low, double high, int about_ticks) {
  const double step = nice_step((high - low) / std::max(1, about_ticks));
  Scale scale;
  scale.min = axis.min ? *axis.min : std::floor(low / step + 1e-9) * step;
  scale.max = axis.max ? *axis.max : std::ceil(high / step - 1e-9) * step;
  for (double k = std::ceil(scale.min / step - 1e-9); k * step <= scale.max + step * 1e-9; ++k)
    scale.ticks.push_back({k * step, tick_text(k * step, step)});
  return scale;
}

Scale log_scale(const Axis& axis, double low, double high, int about_ticks) {
  Scale scale;
  scale.log = true;
  scale.min = axis.min && *axis.min > 0 ? *axis.min : low / std::pow(high / low, 0.03);
  scale.max = axis.max && *axis.max > 0 ? *axis.max : high * std::pow(high / low, 0.03);
  const double decades = std::log10(scale.max / scale.min);
  if (decades < 0.5) {
    scale.ticks = linear_scale({"", false, scale.min, scale.max}, scale.min, scale.max, about_ticks).ticks;
    return scale;
  }
  const int every = std::max(1, static_cast<int>(std::ceil(decades / about_ticks)));
  const auto first = static_cast<int>(std::floor(std::log10(scale.min)));
  for (int power = first; std::pow(10, power) <= scale.max; power += every)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10, power);
      if (factor > 1 && 2.5 * decades > about_ticks) continue;
      if (value >= scale.min * 0.9999 && value <= scale.max * 1.0001)
        scale.ticks.push_back({value, tick_text(value, std::pow(10, power))});
    }
  return scale;
}

}  // namespace

double Scale::place(double value) const {
  return log ? std::log(value / min) / std::log(max / min) : (value - min) / (max - min);
}

Scale make_scale(const Axis& axis, double low, double high, int about_ticks) {
  low = axis.min.value_or(low);
  high = axis.max.value_or(high);
  if (!(std::isfinite(low) && std::isfinite(high) && low <= high)) low = axis.log ? 1 : 0, high = axis.log ? 10 : 1;
  if (axis.log) {
    low = std::max(low, 1e-300);
    if (high <= low * (1 + 1e-9)) low /= 2, high = low * 4;
    return log_scale(axis, low, high, about_ticks);
  }
  if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const double pad = low == 0 ? 1 : std::abs(low) * 0.1;
    low -= pad, high += pad;
  }
  return linear_scale(axis, low, high, about_ticks);
}

}  // namespace motex
