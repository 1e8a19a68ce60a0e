// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/cut_smoothness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "motex/core/error.h"
#include "motex/core/quantile.h"

namespace motex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double second_difference(double before, double now, double after) { return std::abs(before - 2 * now + after); }

/// Change of velocity of the centroid: from a → b to c → d.
double velocity_change(const Silhouette& a, const Silhouette& b, const Silhouette& c, const Silhouette& d) {
  return std::hypot((d.centroid_x - c.centroid_x) - (b.centroid_x - a.centroid_x),
                    (d.centroid_y - c.centroid_y) - (b.centroid_y - a.centroid_y));
}

bool is_inside_a_take(const PeopleTexture& texture, int first, int last) {
  return std::any_of(texture.takes.begin(), texture.takes.end(), [&](const Take& take) {
    return first >= take.frames.start && last < take.frames.end() && last < texture.num_frames();
  });
}

/// What is mixed of a silhouette.
struct Signals {
  double area = 0, x = 0, y = 0, aspect = 0;

  Signals() = default;
  explicit Signals(const Silhouette& s) : area(s.area), x(s.centroid_x), y(s.centroid_y), aspect(s.aspect()) {}
};

Signals mixed(const Signals& a, const Signals& b, double weight) {
  Signals mix;
  mix.area = a.area + (b.area - a.area) * weight;
  mix.x = a.x + (b.x - a.x) * weight, mix.y = a.y + (b.y - a.y) * weight;
  mix.aspect = a.aspect + (b.aspect - a.aspect) * weight;
  return mix;
}

CutSmoothness largest_second_differences(const std::vector<Signals>& film, const SecondDifferenceScales& scales) {
  CutSmoothness worst;
  for (std::size_t t = 1; t + 1 < film.size(); ++t) {
    const Signals &a = film[t - 1], &b = film[t], &c = film[t + 1];
    worst.area = std::max(worst.area, second_difference(a.area, b.area, c.area) / scales.area);
    worst.aspect = std::max(worst.aspect, second_difference(a.aspect, b.aspect, c.aspect) / scales.aspect);
    worst.centroid =
        std::max(worst.centroid,
                 std::hypot(second_difference(a.x, b.x, c.x), second_difference(a.y, b.y, c.y)) / scales.centroid);
  }
  return worst;
}

double percentile_95(std::vector<double> values, double least) {
  return values.empty() ? least : std::max(quantile(std::move(values), 0.95), least);
}

}  // namespace

double CutSmoothness::largest() const { return std::max({area, centroid, aspect}); }

SecondDifferenceScales second_difference_scales(const PeopleTexture& texture) {
  std::vector<double> area, centroid, aspect;
  for (const Take& take : texture.takes)
    for (int t = take.frames.start + 1; t + 1 < take.frames.end(); ++t) {
      const Silhouette* s = &texture.silhouettes[static_cast<std::size_t>(t)];
      if (s[-1].empty() || s[0].empty() || s[1].empty()) continue;
      area.push_back(second_difference(s[-1].area, s[0].area, s[1].area));
      aspect.push_back(second_difference(s[-1].aspect(), s[0].aspect(), s[1].aspect()));
      centroid.push_back(velocity_change(s[-1], s[0], s[0], s[1]));
    }
  return {percentile_95(std::move(area), 1), percentile_95(std::move(centroid), 0.05),
          percentile_95(std::move(aspect), 1e-4)};
}

CutSmoothness film_smoothness(const std::vector<Silhouette>& silhouettes, const SecondDifferenceScales& scales) {
  std::vector<Signals> film;
  for (const Silhouette& silhouette : silhouettes) film.emplace_back(silhouette);
  return largest_second_differences(film, scales);
}

CutSmoothness cut_smoothness(const PeopleTexture& texture, const SecondDifferenceScales& scales, int from, int to) {
  if (!is_inside_a_take(texture, from - 1, from) || !is_inside_a_take(texture, to, to + 1))
    return {kInfinity, kInfinity, kInfinity};
  const Silhouette* a = &texture.silhouettes[static_cast<std::size_t>(from)];
  const Silhouette* b = &texture.silhouettes[static_cast<std::size_t>(to)];
  for (const Silhouette* s : {a - 1, a, b, b + 1})
    if (s->empty()) return {kInfinity, kInfinity, kInfinity};
  CutSmoothness smoothness;
  smoothness.area = std::max(second_difference(a[-1].area, a[0].area, b[0].area),
                             second_difference(a[0].area, b[0].area, b[1].area)) /
                    scales.area;
  smoothness.aspect = std::max(second_difference(a[-1].aspect(), a[0].aspect(), b[0].aspect()),
                               second_difference(a[0].aspect(), b[0].aspect(), b[1].aspect())) /
                      scales.aspect;
  smoothness.centroid = velocity_change(a[-1], a[0], b[0], b[1]) / scales.centroid;
  return smoothness;
}

CutSmoothness transition_smoothness(const PeopleTexture& texture, const SecondDifferenceScales& scales, int from,
                                    int to, int transition_frames) {
  CutSmoothness smoothness = cut_smoothness(texture, scales, from, to);
  if (transition_frames <= 0) return smoothness;
  const Take &left = take_of(texture, from), &entered = take_of(texture, to);
  const auto before_cut = [&] { return (transition_frames + 1) / 2; };
  while (transition_frames > 0 &&
         (to - before_cut() < entered.frames.start || from - before_cut() + transition_frames >= left.frames.end()))
    --transition_frames;
  const int before = before_cut();
  const auto of = [&](const Take& take, int frame) {
    const int inside = std::clamp(frame, take.frames.start, take.frames.end() - 1);
    return Signals(texture.silhouettes[static_cast<std::size_t>(inside)]);
  };
  const Signals last = of(left, from), first = of(entered, to - 1);
  std::vector<Signals> film;  // two frames of footage at each end
  for (int k = -2; k < transition_frames + 2; ++k) {
    const double weight = std::clamp((k + 1) / (transition_frames + 1.0), 0.0, 1.0);
    Signals b = of(entered, to - before + k);
    b.x += last.x - first.x, b.y += last.y - first.y;
    film.push_back(mixed(of(left, from - before + 1 + k), b, weight));
  }
  return largest_second_differences(film, scales);
}

const Take& take_of(const PeopleTexture& texture, int frame) {
  for (const Take& take : texture.takes)
    if (frame >= take.frames.start && frame < take.frames.end()) return take;
  throw InvalidInput("frame " + std::to_string(frame) + " lies in no take of the people texture, which has " +
                     std::to_string(texture.num_frames()) + " frames");
}

std::vector<int> take_of_frames(const PeopleTexture& texture) {
  std::vector<int> take_of;
  for (std::size_t k = 0; k < texture.takes.size(); ++k) {
    const FrameSpan& frames = texture.takes[k].frames;
    if (frames.start != static_cast<int>(take_of.size()) || frames.length < 0)
      throw InvalidInput("take " + std::to_string(k) + " does not begin where the one before it ends");
    take_of.insert(take_of.end(), static_cast<std::size_t>(frames.length), static_cast<int>(k));
  }
  if (static_cast<int>(take_of.size()) != texture.num_frames())
    throw InvalidInput("the takes hold " + std::to_string(take_of.size()) + " frames, but there are " +
                       std::to_string(texture.num_frames()) + " silhouettes");
  return take_of;
}

}  // namespace motex
