// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/particle_styles.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"
#include "motex/particles/cable_tracks.h"
#include "motex/project/base_sketch.h"
#include "motex/project/moveton_shape.h"

namespace motex {
namespace {

constexpr int kNumFills = 5;
constexpr double kOutlineWidth = 0.7;  // pixels of the model
constexpr double kFullInkShare = 0.9;  // of bases are drawn in less than full ink
constexpr double kWeakest = 0.02;      // of its strongest, from which on a shape is drawn
constexpr float kContrast = 1.5F, kSaturation = 1.3F;
constexpr Rgba kPaper{255, 255, 255, 255}, kDarkInk{24, 26, 40, 255};

/// About its peak, up to a factor.
double strength(const Base& base, int num_planes) { return std::abs(luma_coefficient(base, num_planes)) / base.scale; }

const Base& strongest_core(const Cable& cable, int num_planes) {
  return *std::max_element(cable.core.begin(), cable.core.end(), [&](const Base& a, const Base& b) {
    return strength(a, num_planes) < strength(b, num_planes);
  });
}

/// With its luma for coefficient.
Base in_grey(Base base, int num_planes) {
  base.coefficients[0] = static_cast<float>(luma_coefficient(base, num_planes));
  return base;
}

Rgba rgba(const LevelTriple& colour) {
  const auto byte = [](float level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F); };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), 255};
}

/// Farther from what is behind it, and from grey: flat colours ask for both.
LevelTriple stressed(const LevelTriple& colour, const LevelTriple& behind) {
  LevelTriple out{};
  float mean = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = behind[k] + kContrast * (colour[k] - behind[k]);
    mean += out[k] / 3;
  }
  for (float& level : out) level = std::clamp(mean + kSaturation * (level - mean), 0.0F, 255.0F);
  return out;
}

LevelTriple mean_of(const Planes& planes) {
  LevelTriple mean{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Plane& plane = planes[planes.size() == 3 ? k : 0];
    double sum = 0;
    for (const float value : plane.values) sum += static_cast<double>(value);
    mean[k] = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, plane.values.size())));
  }
  return mean;
}

/// The coefficient that nine of ten cores of the model stay below.
double usual_full_ink(const TexturedMotion& model) {
  std::vector<double> sizes;
  for (const Cable& cable : model.cables)
    for (const Base& base : cable.core) sizes.push_back(std::abs(luma_coefficient(base, model.num_planes)));
  if (sizes.empty()) return 0;
  const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(kFullInkShare * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), nth, sizes.end());
  return *nth;
}

}  // namespace

StylePainter::StylePainter(const TexturedMotion& model, DrawnStyle style, double magnification)
    : style_(style),
      magnification_(magnification),
      model_width_(model.width),
      model_height_(model.height),
      num_planes_(model.num_planes),
      model_background_(model.background) {
  if (!(magnification >= 0.1 && magnification <= 16))
    throw InvalidInput("a style is drawn at 0.1 … 16 times the model's size, not " + std::to_string(magnification));
  if (style == DrawnStyle::kSymbolic) {
    background_ = Image(std::max(1, static_cast<int>(std::lround(model.width * magnification))),
                        std::max(1, static_cast<int>(std::lround(model.height * magnification))), kPaper);
    full_ink_ = usual_full_ink(model);
    return;
  }
  background_ = flat_colours(model.background, magnification);
  std::vector<LevelTriple> colours;
  std::vector<double> weights;
  for (const Cable& cable : model.cables) {
    if (cable.core.empty()) continue;
    const Base& core = strongest_core(cable, num_planes_);
    colours.push_back(colour_at_peak(core));
    weights.push_back(static_cast<double>(cable.num_frames()) * core.scale * core.scale);
  }
  if (colours.empty()) return;
  const LevelTriple behind = mean_of(model.background);
  for (const LevelTriple& colour : palette(colours, weights, kNumFills)) fills_.push_back(stressed(colour, behind));
}

/// The background under the core plus its peak, as shown.
LevelTriple StylePainter::colour_at_peak(const Base& core) const {
  LevelTriple colour{};
  const int x = std::clamp(static_cast<int>(std::lround(core.x)), 0, model_width_ - 1);
  const int y = std::clamp(static_cast<int>(std::lround(core.y)), 0, model_height_ - 1);
  Base unit = core;
  unit.coefficients[0] = 1;
  const double per_unit = peak_amplitude(unit);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t plane = num_planes_ == 3 ? k : 0;
    const double behind = static_cast<double>(model_background_[plane].at(x, y));
    colour[k] =
        static_cast<float>(std::clamp(behind + per_unit * static_cast<double>(core.coefficients[plane]), 0.0, 255.0));
  }
  return colour;
}

void StylePainter::choose_fill(const Base& core, Looks& looks) const {
  if (strength(core, num_planes_) <= looks.strongest) return;
  looks.strongest = strength(core, num_planes_);
  const LevelTriple shown = stressed(colour_at_peak(core), mean_of(model_background_));
  looks.fill = rgba(fills_.empty() ? shown : fills_[static_cast<std::size_t>(nearest_colour(fills_, shown))]);
  looks.outline = mix(looks.fill, kDarkInk, 0.6);
}

void StylePainter::draw_symbols(const MovetonFrame& frame, Drawing& drawing) const {
  BaseMap map;
  map.width = model_width_;
  map.height = model_height_;
  for (const Base& base : frame.bases)
    if (base.scale > 0 && is_inside(base.x, base.y, map.width, map.height))
      map.bases.push_back(in_grey(base, num_planes_));
  append(drawing, base_sketch(map, magnification_, full_ink_), {0, 0});
}

void StylePainter::draw_shapes(const MovetonFrame& frame, Drawing& drawing) {
  for (const Moveton& moveton : frame.movetons) {
    const Base& core = frame.core_of(moveton);
    if (!(core.scale > 0)) continue;
    Looks& looks = looks_[moveton.track];
    looks.frame = frame.frame;
    choose_fill(core, looks);
    const double share = looks.strongest > 0 ? strength(core, num_planes_) / looks.strongest : 0;
    if (share < kWeakest) continue;
    std::vector<Base> bases;
    for (const Base& base : frame.bases_of(moveton)) bases.push_back(in_grey(base, num_planes_));
    for (std::vector<Point>& outline : cartoon_outlines(bases, moveton.vx, moveton.vy, std::sqrt(share))) {
      for (Point& p : outline) p = {p.x * magnification_, p.y * magnification_};
      drawing.add(Polygon{outline, {looks.fill, {}, {}, {}}});
      outline.push_back(outline.front());
      drawing.add(Polyline{std::move(outline), looks.outline, kOutlineWidth * magnification_, 0});
    }
  }
  std::erase_if(looks_, [&](const auto& entry) { return entry.second.frame != frame.frame; });
}

Drawing StylePainter::draw(const MovetonFrame& frame) {
  Drawing drawing{static_cast<double>(width()), static_cast<double>(height()), {0, 0, 0, 0}, {}};
  style_ == DrawnStyle::kSymbolic ? draw_symbols(frame, drawing) : draw_shapes(frame, drawing);
  return drawing;
}

void StylePainter::paint(const MovetonFrame& frame, Image& picture, Image& layer) {
  layer = render(draw(frame));
  picture = background_;
  paste(picture, layer, 0, 0);
}

}  // namespace motex
