// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/abnormality_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "motex/plot/charts.h"
#include "motex/plot/colour.h"

namespace motex {
namespace {

constexpr double kWidth = 640, kMargin = 12, kTitleHeight = 40;
constexpr std::size_t kNumMarked = 8;
constexpr double kMarkedFrom = 4;  // deviations
constexpr double kFullHeat = 20;   // summed deviations shown in the hottest colour, at least

/// The background in grey, half as bright, with the heat over it.
Image heated(const TexturedMotion& observed, const Plane& map) {
  const Plane still = observed.background.empty()       ? Plane(observed.width, observed.height, 60)
                      : observed.background.size() == 3 ? luma(observed.background)
                                                        : observed.background[0];
  float hottest = static_cast<float>(kFullHeat);
  for (const float value : map.values) hottest = std::max(hottest, value);
  Image image(observed.width, observed.height);
  for (int y = 0; y < observed.height; ++y)
    for (int x = 0; x < observed.width; ++x) {
      const auto grey = static_cast<std::uint8_t>(std::clamp(0.5 * static_cast<double>(still.at(x, y)), 0.0, 255.0));
      const double heat = std::sqrt(static_cast<double>(map.at(x, y) / hottest));
      image.at(x, y) = mix({grey, grey, grey, 255}, heat_colour(heat), std::min(1.0, 1.5 * heat));
    }
  return image;
}

struct Marked {
  std::size_t cable, idx;
  double surprise;
};

std::vector<Marked> most_surprising(const Explanation& explanation) {
  std::vector<Marked> all;
  for (std::size_t c = 0; c < explanation.surprise.size(); ++c) {
    const std::vector<double>& steps = explanation.surprise[c];
    const auto top = std::max_element(steps.begin(), steps.end());
    if (top != steps.end() && *top > kMarkedFrom)
      all.push_back({c, static_cast<std::size_t>(top - steps.begin()), *top});
  }
  std::stable_sort(all.begin(), all.end(), [](const Marked& a, const Marked& b) { return a.surprise > b.surprise; });
  all.resize(std::min(all.size(), kNumMarked));
  return all;
}

void add_path(Drawing& drawing, const Cable& cable, std::size_t idx, double zoom, Rgba colour) {
  const auto place = [zoom](const Base& base) { return Point{(base.x + 0.5) * zoom, (base.y + 0.5) * zoom}; };
  Polyline path{{}, colour, 1.5, 0}, ring{{}, colour, 1.5, 0};
  for (const Base& base : cable.core) path.points.push_back(place(base));
  const Point centre = place(cable.core[idx]);
  for (int k = 0; k <= 20; ++k) {
    const double angle = 2 * std::numbers::pi * k / 20;
    ring.points.push_back({centre.x + 7 * std::cos(angle), centre.y + 7 * std::sin(angle)});
  }
  if (path.points.size() > 1) drawing.add(std::move(path));
  drawing.add(std::move(ring));
}

}  // namespace

Drawing abnormality_figure(const TexturedMotion& observed, const Explanation& explanation, const std::string& title) {
  const double zoom = kWidth / observed.width;
  Drawing where;
  where.width = kWidth;
  where.height = zoom * observed.height;
  const Plane map = abnormality_map(observed, explanation, std::max(2.0, observed.width / 80.0));
  where.add(Picture{{0, 0}, where.width, where.height, heated(observed, map)});
  int number = 0;
  for (const Marked& marked : most_surprising(explanation))
    add_path(where, observed.cables[marked.cable], marked.idx, zoom, unit_colour(number++));

  LinePlot when;
  when.title = "surprise beyond two deviations, summed over the elements of a frame";
  when.x_axis.label = "frame";
  when.size = {kWidth, 200};
  Series series;
  const std::vector<double> time = abnormality_over_time(observed, explanation);
  for (std::size_t t = 0; t < time.size(); ++t) {
    series.x.push_back(static_cast<double>(t));
    series.y.push_back(time[t]);
  }
  when.series.push_back(std::move(series));
  const Drawing chart = draw(when);
  Drawing figure;
  figure.width = std::max(kWidth, chart.width) + 2 * kMargin;
  figure.height = kTitleHeight + where.height + kMargin + chart.height;
  figure.add(Text{{figure.width / 2, kTitleHeight - 14}, title, 14, {38, 42, 51, 255}, Align::kCentre, true, false});
  append(figure, where, {kMargin, kTitleHeight});
  append(figure, chart, {kMargin, kTitleHeight + where.height + kMargin});
  return figure;
}

}  // namespace motex
