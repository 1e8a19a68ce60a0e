// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/particle_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"
#include "motex/image/planes.h"
#include "motex/plot/charts.h"
#include "motex/plot/frame.h"
#include "motex/project/base_sketch.h"

namespace motex {
namespace {

constexpr Rgba kWhite{255, 255, 255, 255};

constexpr Rgba kBirth{178, 34, 34, 255};

Drawing sheet(double width, double height) { return {width, height, kWhite, {}}; }

void add_border(Drawing& drawing) {
  std::vector<Point> corners = rectangle({0.5, 0.5}, drawing.width - 1, drawing.height - 1);
  corners.push_back(corners.front());
  drawing.add(Polyline{std::move(corners), kFaintInk, 1, 0});
}

/// The base alone, grey = 0, its crest white or its trough black.
Image light_of(BaseKind kind, int side) {
  Plane plane(side, side);
  const Base base{kind, 0.5 * (side - 1), 0.5 * (side - 1), side / 9.0, 0.5, {1, 0, 0}};
  evaluate(base, 0, 0, side, side, plane.values.data());
  float peak = 1e-9F;
  for (const float value : plane.values) peak = std::max(peak, std::abs(value));
  for (float& value : plane.values) value = 127.5F + 127.5F * value / peak;
  return to_image(plane);
}

}  // namespace

Drawing base_functions_picture(double cell) {
  struct Function {
    BaseKind kind;
    const char *name, *what;
  };
  constexpr std::array<Function, 3> kFunctions{
      {{BaseKind::kLog, "LoG", "blob"}, {BaseKind::kGaborCos, "Gcos", "bar"}, {BaseKind::kGaborSin, "Gsin", "edge"}}};
  constexpr double kGap = 10, kLeft = 84;
  Drawing drawing = sheet(kLeft + 2 * (cell + kGap), 3 * (cell + kGap) - kGap);
  for (std::size_t k = 0; k < kFunctions.size(); ++k) {
    const double top = static_cast<double>(k) * (cell + kGap);
    drawing.add(Text{{0, top + cell / 2}, kFunctions[k].name, 15, kInk, Align::kLeft, true, false});
    drawing.add(Text{{0, top + cell / 2 + 17}, kFunctions[k].what, 13, kFaintInk, Align::kLeft, false, false});
    drawing.add(Picture{{kLeft, top}, cell, cell, light_of(kFunctions[k].kind, 128)});
    BaseMap map;
    map.width = map.height = 30;
    map.bases = {Base{kFunctions[k].kind, 14.5, 14.5, 4.5, 0.5, {1, 0, 0}}};
    Drawing symbol = base_sketch(map, cell / 30);
    add_border(symbol);
    append(drawing, symbol, {kLeft + cell + kGap, top});
  }
  return drawing;
}

Drawing paths_picture(const std::vector<Cable>& cables, int width, int height, double magnification, int min_frames) {
  Drawing drawing = sheet(width * magnification, height * magnification);
  const auto inside = [&](const Base& core) { return is_inside(core.x, core.y, width, height); };
  const double radius = cables.size() > 300 ? 0.9 : 1.6;
  for (const Cable& cable : cables) {
    if (cable.num_frames() < min_frames) continue;
    Polyline line{{}, with_alpha(kInk, 0.75), 0.9, 0};
    for (const Base& core : cable.core)
      if (inside(core)) line.points.push_back({(core.x + 0.5) * magnification, (core.y + 0.5) * magnification});
    if (line.points.size() < 2) continue;
    const Point birth = line.points.front();
    drawing.add(std::move(line));
    if (cable.first_frame > 0) drawing.add(Disc{birth, radius, kBirth});
  }
  add_border(drawing);
  return drawing;
}

Drawing density_picture(const Plane& density, double magnification) {
  std::vector<float> values = density.values;
  float low = 0, high = 1;
  if (!values.empty()) {
    low = *std::min_element(values.begin(), values.end());
    std::erase(values, low);
  }
  if (!values.empty()) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    high = *nth;
  } else {
    high = low + 1;
  }
  Image image(density.width, density.height);
  for (std::size_t i = 0; i < density.values.size(); ++i) {
    const double share =
        std::clamp(static_cast<double>(density.values[i] - low) / static_cast<double>(high - low), 0.0, 1.0);
    const auto level = static_cast<std::uint8_t>(255.5 - 255 * std::pow(share, 0.7));
    image.pixels[i] = {level, level, level, 255};
  }
  Drawing drawing = sheet(density.width * magnification, density.height * magnification);
  drawing.add(Picture{{0, 0}, drawing.width, drawing.height, std::move(image)});
  add_border(drawing);
  return drawing;
}

Drawing picture_rows(const std::vector<PictureRow>& rows, double cell) {
  constexpr double kGap = 4, kCaption = 20;
  Drawing drawing = sheet(0, 0);
  for (const PictureRow& row : rows) {
    if (row.pictures.empty()) continue;
    drawing.add(Text{{0, drawing.height + 14}, row.caption, 13, kInk, Align::kLeft, false, false});
    const double top = drawing.height + kCaption;
    double height = 0;
    for (std::size_t k = 0; k < row.pictures.size(); ++k) {
      const Image& image = row.pictures[k];
      const double image_height = std::round(cell * image.height / std::max(1, image.width));
      drawing.add(Picture{{static_cast<double>(k) * (cell + kGap), top}, cell, image_height, image});
      height = std::max(height, image_height);
    }
    drawing.width = std::max(drawing.width, static_cast<double>(row.pictures.size()) * (cell + kGap) - kGap);
    drawing.height = top + height + 2 * kGap;
  }
  if (drawing.height <= 0) throw InvalidInput("there are no pictures to put in rows");
  return drawing;
}

}  // namespace motex
