// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/base_sketch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "motex/plot/charts.h"

namespace motex {
namespace {

constexpr Rgba kPositive{20, 20, 20, 255}, kNegative{40, 90, 200, 255};

double strength(const Base& base, int num_planes) {
  double sum = 0;
  for (int k = 0; k < num_planes; ++k) sum += base.coefficients[static_cast<std::size_t>(k)];
  return sum / num_planes;
}

double usual_full_ink(const BaseMap& map) {
  std::vector<double> sizes;
  for (const Base& base : map.bases) sizes.push_back(std::abs(strength(base, map.num_planes)));
  std::sort(sizes.begin(), sizes.end());
  return sizes.empty() ? 1 : std::max(1e-9, sizes[sizes.size() * 9 / 10]);
}

/// The four corners of a bar along v, half as wide as the middle lobe.
Polyline bar(Point centre, const Base& base, double size, Rgba colour, double width) {
  const double c = std::cos(base.angle), s = std::sin(base.angle), across = 0.6 * size, along = 1.8 * size;
  Polyline line{{}, colour, width, 0};
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
    line.points.push_back({centre.x + u * across * c - v * along * s, centre.y + u * across * s + v * along * c});
  return line;
}

void add_edge(Drawing& drawing, Point centre, const Base& base, double size, double sign, Rgba colour, double width) {
  const double c = std::cos(base.angle), s = std::sin(base.angle), along = 1.8 * size;
  drawing.add(Polyline{
      {{centre.x + along * s, centre.y - along * c}, {centre.x - along * s, centre.y + along * c}}, colour, width, 0});
  drawing.add(Polyline{{centre, {centre.x + sign * size * c, centre.y + sign * size * s}}, colour, width, 0});
}

}  // namespace

Drawing base_sketch(const BaseMap& map, double magnification, double full_ink) {
  Drawing drawing;
  drawing.width = map.width * magnification;
  drawing.height = map.height * magnification;
  const double strong = full_ink > 0 ? full_ink : usual_full_ink(map);
  for (auto base = map.bases.rbegin(); base != map.bases.rend(); ++base) {  // the first found on top
    const double amount = strength(*base, map.num_planes), size = base->scale * magnification;
    const double opacity = 0.25 + 0.75 * std::min(1.0, std::abs(amount) / strong);
    const Rgba colour = with_alpha(amount < 0 ? kNegative : kPositive, opacity);
    const Point centre{(base->x + 0.5) * magnification, (base->y + 0.5) * magnification};
    const double width = 0.6 * std::sqrt(magnification);
    if (base->kind == BaseKind::kLog) drawing.add(ring(centre, 1.4 * size, colour, width));
    if (base->kind == BaseKind::kGaussian) drawing.add(Disc{centre, 0.8 * size, colour});
    if (base->kind == BaseKind::kGaborCos || base->kind == BaseKind::kStreak)
      drawing.add(bar(centre, *base, size, colour, width));
    if (base->kind == BaseKind::kGaborSin)
      add_edge(drawing, centre, *base, size, amount < 0 ? -1 : 1, with_alpha(kPositive, opacity), width);
  }
  return drawing;
}

Drawing decomposition_figure(const FrameDecomposition& frame) {
  const double width = frame.observed[0].width, height = frame.observed[0].height;
  const auto panel = [&](const std::string& caption) {
    Drawing drawing;
    drawing.width = width + 12;
    drawing.height = height + 30;
    drawing.add(Text{{6 + width / 2, height + 22}, caption, 12, {30, 30, 30, 255}, Align::kCentre, false, false});
    return drawing;
  };
  const auto picture = [&](const Planes& planes, const std::string& caption) {
    Drawing drawing = panel(caption);
    drawing.add(Picture{{6, 6}, width, height, to_image(planes)});
    return drawing;
  };
  const auto decibels = [](double psnr) {
    if (!std::isfinite(psnr)) return std::string("exact");
    char text[32];
    std::snprintf(text, sizeof text, "%.1f dB", psnr);
    return std::string(text);
  };
  std::vector<Drawing> panels{picture(frame.observed, "frame " + std::to_string(frame.frame))};
  for (std::size_t k = 0; k < frame.maps.size(); ++k)
    panels.push_back(
        picture(frame.pictures[k], std::to_string(frame.maps[k].bases.size()) + " bases, " + decibels(frame.psnr[k])));
  panels.push_back(picture(frame.background, "background, " + decibels(frame.background_psnr)));
  for (const BaseMap& map : frame.maps) {
    panels.push_back(panel(std::to_string(map.bases.size()) + " bases"));
    append(panels.back(), base_sketch(map, 1), {6, 6});
  }
  return grid(panels, static_cast<int>(frame.maps.size()) + 1, "");
}

}  // namespace motex
