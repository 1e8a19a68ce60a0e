// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/particle_styles.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/project/base_sketch.h"
#include "motex/project/moveton_shape.h"

namespace motex {
namespace {

constexpr int kNumFills = 5;
constexpr double kOutlineWidth = 0.9;  // pixels of the model
constexpr double kFullInkShare = 0.9;  // of bases are drawn in less than full ink
constexpr Rgba kPaper{255, 255, 255, 255}, kDarkInk{24, 26, 40, 255};

double strength(const Base& base) { return std::abs(static_cast<double>(base.coefficients[0])) / base.scale; }

bool in_view(const Base& base, const TexturedMotion& model) {
  return base.x >= -0.5 && base.y >= -0.5 && base.x < model.width - 0.5 && base.y < model.height - 0.5;
}

/// Where the cable is strongest: the frame, and how strong.
std::pair<std::int64_t, double> strongest_frame(const Cable& cable) {
  std::pair<std::int64_t, double> best{cable.first_frame, 0};
  for (std::int64_t t = cable.first_frame; t < cable.end_frame(); ++t)
    if (const double here = strength(cable.at(t)); here > best.second) best = {t, here};
  return best;
}

/// The background under the core plus its peak, as shown.
LevelTriple colour_at_peak(const TexturedMotion& model, const Base& core) {
  LevelTriple colour{};
  const int x = std::clamp(static_cast<int>(std::lround(core.x)), 0, model.width - 1);
  const int y = std::clamp(static_cast<int>(std::lround(core.y)), 0, model.height - 1);
  const double per_unit =
      peak_amplitude(core) / std::max(1e-9F, std::abs(core.coefficients[0])) * (core.coefficients[0] < 0 ? -1 : 1);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t plane = model.num_planes == 3 ? k : 0;
    const double behind = model.background.empty() ? 128 : model.background[plane].at(x, y);
    colour[k] = static_cast<float>(std::clamp(behind + per_unit * core.coefficients[plane], 0.0, 255.0));
  }
  return colour;
}

Rgba rgba(const LevelTriple& colour) {
  const auto byte = [](float level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F); };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), 255};
}

/// Away from grey, as flat colours ask for.
LevelTriple vivid(const LevelTriple& colour) {
  const float mean = (colour[0] + colour[1] + colour[2]) / 3;
  LevelTriple out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::clamp(mean + 1.35F * (colour[k] - mean), 0.0F, 255.0F);
  return out;
}

}  // namespace

StylePainter::StylePainter(const TexturedMotion& model, const std::vector<Cable>& cables, DrawnStyle style,
                           double magnification)
    : model_(model), cables_(cables), style_(style), magnification_(magnification) {
  if (!(magnification >= 0.1 && magnification <= 16))
    throw InvalidInput("a style is drawn at 0.1 … 16 times the model's size, not " + std::to_string(magnification));
  if (style == DrawnStyle::kCartoon) {
    background_ = flat_colours(model.background, magnification);
    choose_colours();
    return;
  }
  background_ = Image(std::max(1, static_cast<int>(std::lround(model.width * magnification))),
                      std::max(1, static_cast<int>(std::lround(model.height * magnification))), kPaper);
  std::vector<double> strengths;
  for (const Cable& cable : cables)
    for (const Base& base : cable.core) strengths.push_back(std::abs(static_cast<double>(base.coefficients[0])));
  if (strengths.empty()) return;
  const auto nth =
      strengths.begin() + static_cast<std::ptrdiff_t>(kFullInkShare * static_cast<double>(strengths.size()));
  std::nth_element(strengths.begin(), nth, strengths.end());
  symbol_strength_ = std::max(1e-9, *nth);
}

void StylePainter::choose_colours() {
  const auto colours_of = [&](const std::vector<Cable>& cables, std::vector<double>& weights) {
    std::vector<LevelTriple> colours;
    for (const Cable& cable : cables) {
      const Base& core = cable.at(strongest_frame(cable).first);
      colours.push_back(colour_at_peak(model_, core));
      weights.push_back(static_cast<double>(cable.num_frames()) * core.scale * core.scale);
    }
    return colours;
  };
  std::vector<double> weights, unused;
  const std::vector<LevelTriple> shown = colours_of(cables_, unused);
  const std::vector<LevelTriple> learned = colours_of(model_.cables, weights);
  if (shown.empty()) return;
  const std::vector<LevelTriple> fills =
      learned.empty() ? palette(shown, unused, kNumFills) : palette(learned, weights, kNumFills);
  for (std::size_t i = 0; i < cables_.size(); ++i) {
    const LevelTriple& fill = fills[static_cast<std::size_t>(nearest_colour(fills, shown[i]))];
    const Rgba colour = rgba(vivid(fill));
    looks_.push_back({colour, mix(colour, kDarkInk, 0.6), strongest_frame(cables_[i]).second});
  }
}

void StylePainter::draw_symbols(std::int64_t frame, Drawing& drawing) const {
  BaseMap map;
  map.width = model_.width;
  map.height = model_.height;
  for (const Cable& cable : cables_)
    if (cable.covers(frame))
      for (const Base& base : bases_at(cable, frame))
        if (in_view(base, model_)) map.bases.push_back(base);
  append(drawing, base_sketch(map, magnification_, symbol_strength_), {0, 0});
}

void StylePainter::draw_shapes(std::int64_t frame, Drawing& drawing) const {
  for (std::size_t i = 0; i < cables_.size(); ++i) {
    if (!cables_[i].covers(frame)) continue;
    const Looks& looks = looks_[i];
    const double share = looks.strongest > 0 ? strength(cables_[i].at(frame)) / looks.strongest : 0;
    if (share < 0.02) continue;
    for (std::vector<Point>& outline : cartoon_outlines(cables_[i], frame, std::sqrt(share))) {
      for (Point& p : outline) p = {p.x * magnification_, p.y * magnification_};
      drawing.add(Polygon{outline, {looks.fill, {}, {}, {}}});
      outline.push_back(outline.front());
      drawing.add(Polyline{std::move(outline), looks.outline, kOutlineWidth * magnification_, 0});
    }
  }
}

Drawing StylePainter::draw(std::int64_t frame) const {
  Drawing drawing{static_cast<double>(width()), static_cast<double>(height()), {0, 0, 0, 0}, {}};
  style_ == DrawnStyle::kSymbolic ? draw_symbols(frame, drawing) : draw_shapes(frame, drawing);
  return drawing;
}

StyledFrame StylePainter::paint(std::int64_t frame) const {
  StyledFrame result{background_, render(draw(frame))};
  paste(result.picture, result.layer, 0, 0);
  return result;
}

}  // namespace motex
