// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/field_morph.h"

#include <algorithm>
#include <cmath>

#include "motex/core/wide.h"

namespace motex {

namespace {

/// One pair of lines ready for use: X' − X = (m X + t), which is affine, and what the distance needs.
struct LineField {
  double px, py, dx, dy;      // P, (Q − P)
  double per_square_length;   // 1 / ‖Q − P‖²
  double mxx, mxy, myx, myy;  // of X − P
  double tx, ty;              // P' − P
  double strength;            // length^(p b)
};

constexpr double kShortest = 0.5;

std::vector<LineField> line_fields(const std::vector<FeatureLine>& shown, const std::vector<FeatureLine>& source,
                                   const FieldMorphOptions& options) {
  std::vector<LineField> fields;
  for (std::size_t i = 0; i < std::min(shown.size(), source.size()); ++i) {
    const FeatureLine &to = shown[i], &from = source[i];
    const double length = to.length(), source_length = from.length();
    if (!(length >= kShortest && source_length >= kShortest)) continue;
    const double dx = to.qx - to.px, dy = to.qy - to.py, ex = from.qx - from.px, ey = from.qy - from.py;
    // u (Q' − P') + v ⊥(Q' − P') / ‖Q' − P'‖ with ⊥(x, y) = (−y, x)
    const double along = 1 / (length * length), across = 1 / (length * source_length);
    LineField field{};
    field.px = to.px, field.py = to.py, field.dx = dx, field.dy = dy, field.per_square_length = along;
    field.mxx = dx * ex * along + dy * ey * across - 1;
    field.mxy = dy * ex * along - dx * ey * across;
    field.myx = dx * ey * along - dy * ex * across;
    field.myy = dy * ey * along + dx * ex * across - 1;
    field.tx = from.px - to.px, field.ty = from.py - to.py;
    field.strength = options.length_power == 0 ? 1 : std::pow(length, 4 * options.length_power);
    fields.push_back(field);
  }
  return fields;
}

/// Sums of one row of grid points.
template <typename Number>
struct RowSums {
  Number weight = 0, x = 0, y = 0;
};

template <typename Number>
inline void add_line(const LineField& line, Number px, Number py, Number softness, RowSums<Number>& sums) {
  const Number x = px - static_cast<Number>(line.px), y = py - static_cast<Number>(line.py);
  const auto dx = static_cast<Number>(line.dx), dy = static_cast<Number>(line.dy);
  const Number u = (x * dx + y * dy) * static_cast<Number>(line.per_square_length);
  const Number inside = std::min(std::max(u, Number(0)), Number(1));
  const Number off_x = x - inside * dx, off_y = y - inside * dy;  // to the nearest point of the line
  const Number reach = softness + (off_x * off_x + off_y * off_y);
  const Number weight = static_cast<Number>(line.strength) / (reach * reach);
  sums.weight += weight;
  sums.x +=
      weight * (static_cast<Number>(line.mxx) * x + static_cast<Number>(line.mxy) * y + static_cast<Number>(line.tx));
  sums.y +=
      weight * (static_cast<Number>(line.myx) * x + static_cast<Number>(line.myy) * y + static_cast<Number>(line.ty));
}

/// The displacements of one row of grid points. weight, x, y: as long as the row.
MOTEX_WIDE void fill_row(const std::vector<LineField>& lines, float left, float py, float spacing, float softness,
                         int columns, float* __restrict weight, float* __restrict x, float* __restrict y) {
  const auto count = static_cast<std::size_t>(columns);
  for (std::size_t c = 0; c < count; ++c) weight[c] = x[c] = y[c] = 0;
  for (const LineField& line : lines) {
    for (std::size_t c = 0; c < count; ++c) {
      RowSums<float> sums;
      add_line(line, left + static_cast<float>(static_cast<int>(c)) * spacing, py, softness, sums);
      weight[c] += sums.weight;
      x[c] += sums.x;
      y[c] += sums.y;
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    x[c] /= weight[c];
    y[c] /= weight[c];
  }
}

}  // namespace

double FeatureLine::length() const { return std::hypot(qx - px, qy - py); }

FeatureLine between(const FeatureLinePair& pair, double weight) {
  const auto mix = [&](double a, double b) { return a + (b - a) * weight; };
  return {mix(pair.a.px, pair.b.px), mix(pair.a.py, pair.b.py), mix(pair.a.qx, pair.b.qx), mix(pair.a.qy, pair.b.qy)};
}

FeatureLine moved(const FeatureLine& line, double dx, double dy) {
  return {line.px + dx, line.py + dy, line.qx + dx, line.qy + dy};
}

WarpGrid field_warp(const std::vector<FeatureLine>& shown, const std::vector<FeatureLine>& source,
                    const BoundingBox& box, const FieldMorphOptions& options) {
  WarpGrid grid(box.left, box.top, box.width(), box.height(), options.spacing);
  // Relative to the box: single precision then has plenty of digits.
  std::vector<FeatureLine> near_shown, near_source;
  for (const FeatureLine& line : shown) near_shown.push_back(moved(line, -box.left, -box.top));
  for (const FeatureLine& line : source) near_source.push_back(moved(line, -box.left, -box.top));
  const std::vector<LineField> lines = line_fields(near_shown, near_source, options);
  if (lines.empty()) return grid;
  const auto softness = static_cast<float>(options.softness * options.softness);
  std::vector<float> weight(static_cast<std::size_t>(grid.columns));
  for (int row = 0; row < grid.rows; ++row)
    fill_row(lines, 0, static_cast<float>(row * grid.spacing), static_cast<float>(grid.spacing), softness, grid.columns,
             weight.data(), &grid.x[grid.index(0, row)], &grid.y[grid.index(0, row)]);
  return grid;
}

WarpGrid::Displacement field_displacement(const std::vector<FeatureLine>& shown, const std::vector<FeatureLine>& source,
                                          double x, double y, const FieldMorphOptions& options) {
  RowSums<double> sums;
  for (const LineField& line : line_fields(shown, source, options))
    add_line(line, x, y, options.softness * options.softness, sums);
  if (sums.weight == 0) return {};
  return {sums.x / sums.weight, sums.y / sums.weight};
}

Sprite field_morph(const PlacedSprite& a, const PlacedSprite& b, const std::vector<FeatureLinePair>& lines,
                   double weight, double dissolve, const FieldMorphOptions& options, int jobs) {
  std::vector<FeatureLine> in_a, in_b, shown;
  for (const FeatureLinePair& pair : lines) {
    in_a.push_back(pair.a), in_b.push_back(pair.b);
    shown.push_back(between(pair, weight));
  }
  const BoundingBox box = joined(box_of(a.sprite, a.placement), box_of(b.sprite, b.placement));
  if (box.empty()) return {};
  const auto warp_to = [&](const std::vector<FeatureLine>& source) { return field_warp(shown, source, box, options); };
  if (dissolve == 0) return warped({a, warp_to(in_a)}, box, jobs);
  if (dissolve == 1) return warped({b, warp_to(in_b)}, box, jobs);
  return dissolved({a, warp_to(in_a)}, {b, warp_to(in_b)}, dissolve, box, jobs);
}

Sprite cross_dissolve(const PlacedSprite& a, const PlacedSprite& b, double weight, int jobs) {
  return field_morph(a, b, {}, weight, weight, {}, jobs);
}

}  // namespace motex
