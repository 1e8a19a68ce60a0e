// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/moveton_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "motex/core/rng.h"
#include "motex/particles/coils.h"
#include "motex/particles/moveton_patch.h"
#include "motex/particles/sample_moveton.h"
#include "motex/plot/charts.h"
#include "motex/project/base_sketch.h"

namespace motex {
namespace {

constexpr Rgba kLink{200, 60, 40, 255}, kInk{30, 30, 30, 255}, kFrame{210, 210, 210, 255};
constexpr double kAlways = 0.9;  // presence from which a link is drawn through

Drawing panel(double width, double height) {
  Drawing out;
  out.width = width;
  out.height = height;
  return out;
}

void add_frame(Drawing& drawing, double left, double top, double width, double height) {
  std::vector<Point> corners = rectangle({left, top}, width, height);
  corners.push_back(corners.front());
  drawing.add(Polyline{corners, kFrame, 1, 0});
}

double luma_mean(const std::array<Spread, 3>& coefficient, int num_planes) {
  if (num_planes < 3) return coefficient[0].mean;
  return luma_of(coefficient[0].mean, coefficient[1].mean, coefficient[2].mean);
}

/// One state: mean bases around a core of scale 1 at the origin, as a map of that size around it.
BaseMap mean_bases(const TemplatePose& pose, const Spread& angle, double sign, int num_planes, double half) {
  BaseMap map{static_cast<int>(std::ceil(2 * half)), static_cast<int>(std::ceil(2 * half)), 1, {}};
  Base core{pose.core_kind, half - 0.5, half - 0.5, 1, angle.mean, {}};
  core.coefficients[0] = static_cast<float>(sign);
  map.bases.push_back(core);
  for (const TemplateCoil& coil : pose.coils) {
    const RelativeBase mean{coil.kind,           coil.u.mean,     coil.v.mean,
                            coil.log_scale.mean, coil.angle.mean, {luma_mean(coil.coefficient, num_planes), 0, 0}};
    map.bases.push_back(placed_at(mean, core, 1));
  }
  return map;
}

/// Core scales from the middle to the outermost coil's rim.
double extent_of(const TemplatePose& pose) {
  double out = 2;
  for (const TemplateCoil& coil : pose.coils)
    out = std::max(out, std::hypot(coil.u.mean, coil.v.mean) + 1.5 * std::exp(coil.log_scale.mean));
  return out;
}

Drawing pose_sketch(const MovetonTemplate& of, const TemplatePose& pose, int num_planes, double size) {
  Drawing out = panel(size, size);
  double half = 3;
  for (const TemplatePose& each : of.poses) half = std::max(half, extent_of(each));
  half = std::ceil(half * 2) / 2;
  const BaseMap map = mean_bases(pose, of.angle, of.amplitude.mean < 0 ? -1 : 1, num_planes, half);
  const double magnification = size / (2 * half);
  const Point middle{size / 2, size / 2};
  append(out, base_sketch(map, magnification), {0, 0});
  for (std::size_t j = 0; j < pose.coils.size(); ++j) {
    const Base& base = map.bases[j + 1];
    const Point there{(base.x + 0.5) * magnification, (base.y + 0.5) * magnification};
    out.add(Polyline{{middle, there}, kLink, 1.2, pose.coils[j].presence < kAlways ? 4.0 : 0.0});
    out.add(Disc{there, 2, kLink});
  }
  out.add(Disc{middle, 3, kLink});
  add_frame(out, 0.5, 0.5, size - 1, size - 1);
  return out;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

/// What is around (x, y) rendered from bases over a level, enlarged.
Image lit(const std::vector<Base>& bases, const std::array<float, 3>& level, int num_planes, int side) {
  Planes planes;
  for (int k = 0; k < num_planes; ++k) planes.emplace_back(side, side, level[static_cast<std::size_t>(k)]);
  for (const Base& base : bases) {
    const BasePatch patch = render_patch(base, side, side);
    for (int k = 0; k < num_planes; ++k)
      add_patch(planes[static_cast<std::size_t>(k)], patch, base.coefficients[static_cast<std::size_t>(k)]);
  }
  return to_image(planes);
}

std::array<float, 3> mean_level(const Planes& background) {
  std::array<float, 3> out{};
  for (std::size_t k = 0; k < std::min<std::size_t>(3, background.size()); ++k) {
    double sum = 0;
    for (const float value : background[k].values) sum += static_cast<double>(value);
    out[k] = static_cast<float>(sum / std::max<double>(1, static_cast<double>(background[k].values.size())));
  }
  return out;
}

/// Pixels from the centre that show a moveton of usual size, over all templates.
int usual_half(const TexturedMotion& model) {
  double half = 4;
  for (const MovetonTemplate& each : model.templates)
    for (const TemplatePose& pose : each.poses)
      half = std::max(half, std::exp(each.log_scale.mean + each.log_scale.deviation) * (extent_of(pose) + 0.5));
  return static_cast<int>(std::clamp(std::ceil(half), 6.0, 60.0));
}

Drawing tiles(const std::vector<Image>& images, int columns, double size) {
  const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;
  Drawing out = panel(columns * (size + 3) + 3, rows * (size + 3) + 3);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto column = static_cast<double>(i % static_cast<std::size_t>(columns));
    const auto row = std::floor(static_cast<double>(i) / columns);
    out.add(Picture{
        {3 + column * (size + 3), 3 + row * (size + 3)}, size, size * images[i].height / images[i].width, images[i]});
  }
  return out;
}

/// An element of the clip that nothing else is near and that lies wholly inside.
struct Instance {
  const Cable* cable;
  std::size_t at;
};

std::vector<Instance> instances_of(const TexturedMotion& model, int half, std::size_t num) {
  std::vector<Instance> all;
  const std::vector<std::vector<char>> isolated = isolated_frames(model.cables, 2);
  for (std::size_t c = 0; c < model.cables.size(); ++c) {
    const Cable& cable = model.cables[c];
    std::vector<std::size_t> usable;
    for (std::size_t at = 0; at < cable.core.size(); ++at) {
      const Base& core = cable.core[at];
      if (isolated[c][at] != 0 && core.x >= half && core.y >= half && core.x < model.width - 1 - half &&
          core.y < model.height - 1 - half)
        usable.push_back(at);
    }
    // some moments of each cable, apart in time
    for (std::size_t k = 0; k < std::min<std::size_t>(6, usable.size()); ++k)
      all.push_back({&cable, usable[(2 * k + 1) * usable.size() / (2 * std::min<std::size_t>(6, usable.size()))]});
  }
  std::vector<Instance> out;
  for (std::size_t k = 0; k < std::min(num, all.size()); ++k)
    out.push_back(all[k * all.size() / std::min(num, all.size())]);
  return out;
}

}  // namespace

Drawing template_sketch(const MovetonTemplate& moveton_template, int num_planes, double size) {
  const auto num = static_cast<double>(moveton_template.poses.size());
  Drawing out = panel(num * (size + 6), size + 20);
  for (std::size_t p = 0; p < moveton_template.poses.size(); ++p) {
    const double left = static_cast<double>(p) * (size + 6);
    append(out, pose_sketch(moveton_template, moveton_template.poses[p], num_planes, size), {left, 0});
    const std::string caption = moveton_template.poses.size() > 1
                                    ? "state " + std::to_string(p) + ": " + percent(moveton_template.poses[p].share)
                                    : percent(moveton_template.share) + " of all";
    out.add(Text{{left + size / 2, size + 14}, caption, 11, kInk, Align::kCentre, false, false});
  }
  return out;
}

Drawing templates_picture(const TexturedMotion& model) {
  Drawing out = panel(10, 4);
  for (std::size_t k = 0; k < model.templates.size(); ++k) {
    const Drawing row = template_sketch(model.templates[k], model.num_planes);
    append(out, row, {4, out.height});
    out.width = std::max(out.width, row.width + 8);
    out.height += row.height + 6;
  }
  return out;
}

Drawing sampled_movetons_picture(const TexturedMotion& model, int num, int columns, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> shares;
  for (const MovetonTemplate& each : model.templates) shares.push_back(std::max(1e-9, each.share));
  const int half = usual_half(model), side = 2 * half + 1;
  std::vector<Image> images;
  for (int k = 0; k < num && !shares.empty(); ++k) {
    const MovetonTemplate& of = model.templates[rng.weighted(shares)];
    images.push_back(lit(sample_moveton(of, model.num_planes, half, half, rng), mean_level(model.background),
                         model.num_planes, side));
  }
  return tiles(images, columns, 44);
}

Drawing moveton_instances_picture(const TexturedMotion& model, const ClipFrames& clip, int num, int columns) {
  const int half = usual_half(model), side = 2 * half + 1;
  std::vector<Image> images;
  for (const Instance& one : instances_of(model, half, static_cast<std::size_t>(num))) {
    const std::int64_t frame = one.cable->first_frame + static_cast<std::int64_t>(one.at);
    if (frame < 0 || frame >= clip.num_frames()) continue;
    const auto idx = static_cast<std::size_t>(frame);
    const Base& core = one.cable->core[one.at];
    const int left = static_cast<int>(std::lround(core.x)) - half, top = static_cast<int>(std::lround(core.y)) - half;
    std::vector<Base> bases{core};
    for (const std::vector<Base>& coil : one.cable->coils) bases.push_back(coil[one.at]);
    Planes around;
    for (const Plane& plane : model.background) {
      Plane piece(side, side);
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) piece.at(x, y) = plane.at(left + x, top + y);
      around.push_back(std::move(piece));
    }
    for (Base base : bases) {
      base.x -= left;
      base.y -= top;
      const BasePatch patch = render_patch(base, side, side);
      for (std::size_t k = 0; k < around.size(); ++k) add_patch(around[k], patch, base.coefficients[k]);
    }
    const Image whole = clip.colour.empty() ? to_image(clip.luma[idx]) : clip.colour[idx];
    Image pair(side, 2 * side + 1, {255, 255, 255, 255});
    paste(pair, crop(whole, left, top, side, side), 0, 0);
    paste(pair, to_image(around), 0, side + 1);
    images.push_back(std::move(pair));
  }
  if (images.empty()) return panel(10, 10);
  const double size = 44, height = size * images[0].height / images[0].width;
  const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;
  Drawing out = panel(columns * (size + 3) + 3, rows * (height + 5) + 3);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto column = static_cast<double>(i % static_cast<std::size_t>(columns));
    const auto row = std::floor(static_cast<double>(i) / columns);
    out.add(Picture{{3 + column * (size + 3), 3 + row * (height + 5)}, size, height, images[i]});
  }
  return out;
}

Drawing movetons_figure(const TexturedMotion& model, const ClipFrames* clip, int num_samples, std::uint64_t seed) {
  struct Part {
    std::string title;
    Drawing drawing;
  };
  const int columns = 20;
  std::vector<Part> parts;
  parts.push_back({"templates: core and coils; dashed: not always there", templates_picture(model)});
  parts.push_back({std::to_string(num_samples) + " movetons sampled from them",
                   sampled_movetons_picture(model, num_samples, columns, seed)});
  if (clip != nullptr)
    parts.push_back(
        {"of the clip, and as core and coils", moveton_instances_picture(model, *clip, 2 * columns, columns)});
  Drawing out = panel(20, 8);
  for (const Part& part : parts) {
    out.add(Text{{8, out.height + 14}, part.title, 12, kInk, Align::kLeft, true, false});
    append(out, part.drawing, {8, out.height + 22});
    out.width = std::max(out.width, part.drawing.width + 16);
    out.height += part.drawing.height + 34;
  }
  return out;
}

}  // namespace motex
