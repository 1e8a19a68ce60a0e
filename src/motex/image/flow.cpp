// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/flow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/wide.h"
#include "motex/image/pyramid.h"

namespace motex {

namespace {

constexpr int kPatch = 8;
constexpr int kBorder = 2 * kPatch;
constexpr int kSmallest = 24;               // pixels: the shorter side of the coarsest level
constexpr double kTexture = 40;             // grey levels² a pixel: gradient of a patch that may stand on its own
constexpr double kFarthest = 1.5 * kPatch;  // pixels of its level that a patch may move away from its start
constexpr double kArrived = 0.01;           // pixels

/// A plane with its edge repeated outwards.
struct Padded {
  int width = 0, height = 0;
  std::size_t stride = 0;
  std::vector<float> values;

  explicit Padded(const Plane& plane) : width(plane.width), height(plane.height) {
    stride = static_cast<std::size_t>(width + 2 * kBorder);
    values.resize(stride * static_cast<std::size_t>(height + 2 * kBorder));
    for (int y = -kBorder; y < height + kBorder; ++y) {
      const float* row = plane.row(std::clamp(y, 0, height - 1));
      for (int x = -kBorder; x < width + kBorder; ++x) *at(x, y) = row[std::clamp(x, 0, width - 1)];
    }
  }
  float* at(int x, int y) {
    return &values[static_cast<std::size_t>(y + kBorder) * stride + static_cast<std::size_t>(x + kBorder)];
  }
  const float* at(int x, int y) const {
    return &values[static_cast<std::size_t>(y + kBorder) * stride + static_cast<std::size_t>(x + kBorder)];
  }
};

using PatchRow = std::array<float, kPatch>;
using Patch = std::array<PatchRow, kPatch>;

/// A patch of `from` with its gradient.
struct Template {
  Patch value, dx, dy;
};

/// Σ r², Σ r ∂x, Σ r ∂y with r = to(p + u) − from(p).
struct Residual {
  float square = 0, x = 0, y = 0;
};

inline float sum_of(const PatchRow& v) { return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7])); }

/// The top left of the patch in `to` is first + (fx, fy).
MOTEX_WIDE void add_residual(const Template& patch, const float* first, std::size_t stride, float fx, float fy,
                             Residual& sums) {
  PatchRow square{}, along_x{}, along_y{};
  const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
  for (std::size_t y = 0; y < kPatch; ++y) {
    const float *above = first + y * stride, *below = above + stride;
    for (std::size_t x = 0; x < kPatch; ++x) {
      const float value = (w00 * above[x] + w10 * above[x + 1]) + (w01 * below[x] + w11 * below[x + 1]);
      const float r = value - patch.value[y][x];
      square[x] += r * r;
      along_x[x] += r * patch.dx[y][x];
      along_y[x] += r * patch.dy[y][x];
    }
  }
  sums.square += sum_of(square);
  sums.x += sum_of(along_x);
  sums.y += sum_of(along_y);
}

MOTEX_WIDE void fill_template(const float* first, std::size_t stride, Template& patch) {
  for (std::size_t y = 0; y < kPatch; ++y) {
    const float* row = first + y * stride;
    for (std::size_t x = 0; x < kPatch; ++x) {
      patch.value[y][x] = row[x];
      patch.dx[y][x] = (row[x + 1] - *(row + x - 1)) / 2;
      patch.dy[y][x] = (row[x + stride] - *(row + x - stride)) / 2;
    }
  }
}

struct Step {
  double x = 0, y = 0;
};

/// One level of both pictures.
class Level {
 public:
  Level(const Planes& from, const Planes& to) : width_(from[0].width), height_(from[0].height) {
    for (std::size_t c = 0; c < from.size(); ++c) from_.emplace_back(from[c]), to_.emplace_back(to[c]);
    templates_.resize(from.size());
  }

  /// Searches every grid point, row by row; `flow` holds where to begin.
  void search(WarpGrid& flow, std::vector<float>& texture, int num_iterations) {
    texture.assign(flow.x.size(), 0);
    for (int row = 0; row < flow.rows; ++row) {
      for (int column = 0; column < flow.columns; ++column) {
        begin(flow.left + column * flow.spacing, flow.top + row * flow.spacing);
        const std::size_t i = flow.index(column, row);
        std::array<Step, 3> starts{Step{flow.x[i], flow.y[i]}};
        std::size_t num_starts = 1;
        const auto add = [&](std::size_t j) { starts[num_starts++] = {flow.x[j], flow.y[j]}; };
        if (column > 0) add(i - 1);
        if (row > 0) add(flow.index(column, row - 1));
        const Step found = descend(best_of(starts, num_starts), num_iterations);
        flow.x[i] = static_cast<float>(found.x), flow.y[i] = static_cast<float>(found.y);
        texture[i] = static_cast<float>(texture_);
      }
    }
  }

 private:
  void begin(int x, int y) {
    x_ = x - kPatch / 2, y_ = y - kPatch / 2;
    hxx_ = hxy_ = hyy_ = 0;
    const int px = std::clamp(x_, 1 - kBorder, width_ + kBorder - kPatch - 1);
    const int py = std::clamp(y_, 1 - kBorder, height_ + kBorder - kPatch - 1);
    for (std::size_t c = 0; c < from_.size(); ++c) {
      fill_template(from_[c].at(px, py), from_[c].stride, templates_[c]);
      for (std::size_t v = 0; v < kPatch; ++v) {
        for (std::size_t u = 0; u < kPatch; ++u) {
          const float dx = templates_[c].dx[v][u], dy = templates_[c].dy[v][u];
          hxx_ += dx * dx, hxy_ += dx * dy, hyy_ += dy * dy;
        }
      }
    }
    const double mean = (hxx_ + hyy_) / 2, spread = std::hypot((hxx_ - hyy_) / 2, hxy_);
    texture_ = (mean - spread) / (kPatch * kPatch);
  }

  Residual residual(const Step& u) const {
    const double x = std::clamp(x_ + u.x, -kBorder + 0.0, width_ + kBorder - kPatch - 2.0);
    const double y = std::clamp(y_ + u.y, -kBorder + 0.0, height_ + kBorder - kPatch - 2.0);
    const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
    Residual sums;
    for (std::size_t c = 0; c < to_.size(); ++c)
      add_residual(templates_[c], to_[c].at(ix, iy), to_[c].stride, static_cast<float>(x - ix),
                   static_cast<float>(y - iy), sums);
    return sums;
  }

  Step best_of(const std::array<Step, 3>& starts, std::size_t count) const {
    Step best = starts[0];
    // The others must be clearly better: where nothing is to be seen the coarser level decides.
    float least = residual(best).square * 0.95F;
    for (std::size_t i = 1; i < count; ++i) {
      const float square = residual(starts[i]).square;
      if (square < least) least = square, best = starts[i];
    }
    return best;
  }

  /// The best place on the way of the Gauss–Newton steps; damped, so that a patch without texture stays.
  Step descend(const Step& start, int num_iterations) const {
    const double damping = 0.02 * (hxx_ + hyy_) + 1e-3 * kTexture * kPatch * kPatch;
    const double a = hxx_ + damping, b = hxy_, c = hyy_ + damping, determinant = a * c - b * b;
    Step u = start, best = start;
    double least = -1;
    for (int iteration = 0; iteration <= num_iterations; ++iteration) {
      const Residual r = residual(u);
      if (least < 0 || r.square < least) least = r.square, best = u;
      if (iteration == num_iterations || determinant <= 0) break;
      const Step step{(c * r.x - b * r.y) / determinant, (a * r.y - b * r.x) / determinant};
      u.x -= step.x, u.y -= step.y;
      if (!(std::hypot(u.x - start.x, u.y - start.y) <= kFarthest)) break;
      if (std::hypot(step.x, step.y) < kArrived) {
        if (residual(u).square < least) best = u;
        break;
      }
    }
    return best;
  }

  int width_, height_;
  std::vector<Padded> from_, to_;
  std::vector<Template> templates_;
  int x_ = 0, y_ = 0;
  double hxx_ = 0, hxy_ = 0, hyy_ = 0;
  double texture_ = 0;  // smaller eigenvalue of the gradient's second moments, a pixel
};

/// Weighted means over 3 × 3 grid points: the less texture, the more a point follows its neighbours.
WarpGrid smoothed(const WarpGrid& flow, const std::vector<float>& texture, double smoothing) {
  WarpGrid out = flow;
  const auto weight = [&](std::size_t i) { return texture[i] / (texture[i] + kTexture) + 0.01; };
  for (int row = 0; row < flow.rows; ++row) {
    for (int column = 0; column < flow.columns; ++column) {
      double x = 0, y = 0, sum = 0;
      for (int r = std::max(0, row - 1); r <= std::min(flow.rows - 1, row + 1); ++r) {
        for (int c = std::max(0, column - 1); c <= std::min(flow.columns - 1, column + 1); ++c) {
          const std::size_t j = flow.index(c, r);
          const double w = weight(j) * (r == row ? 1 : 0.5) * (c == column ? 1 : 0.5);
          x += w * flow.x[j], y += w * flow.y[j], sum += w;
        }
      }
      const std::size_t i = flow.index(column, row);
      const double follow = 1 - (1 - smoothing) * weight(i);
      out.x[i] = static_cast<float>(flow.x[i] + follow * (x / sum - flow.x[i]));
      out.y[i] = static_cast<float>(flow.y[i] + follow * (y / sum - flow.y[i]));
    }
  }
  return out;
}

/// The field of `source` (a level `source_scale` times as fine as the one of `target`) at the grid points of `target`.
void take_over(const WarpGrid& source, double source_scale, WarpGrid& target) {
  for (int row = 0; row < target.rows; ++row) {
    for (int column = 0; column < target.columns; ++column) {
      const auto u = source.at((target.left + column * target.spacing) * source_scale,
                               (target.top + row * target.spacing) * source_scale);
      target.x[target.index(column, row)] = static_cast<float>(u.x / source_scale);
      target.y[target.index(column, row)] = static_cast<float>(u.y / source_scale);
    }
  }
}

void check(const Planes& from, const Planes& to) {
  bool fits = !from.empty() && from.size() == to.size();
  for (std::size_t c = 0; fits && c < from.size(); ++c)
    fits = from[c].width == from[0].width && from[c].height == from[0].height && to[c].width == from[0].width &&
           to[c].height == from[0].height && !from[c].values.empty();
  if (!fits) throw InvalidInput("optical flow needs two pictures of one size with as many planes");
}

}  // namespace

WarpGrid optical_flow(const Planes& from, const Planes& to, const FlowOptions& options, const WarpGrid* start) {
  check(from, to);
  std::vector<Planes> from_levels{from}, to_levels{to};
  const auto halved = [](const Planes& planes) {
    Planes half;
    for (const Plane& plane : planes) half.push_back(halve(plane));
    return half;
  };
  while (std::min(from_levels.back()[0].width, from_levels.back()[0].height) >= 2 * kSmallest) {
    from_levels.push_back(halved(from_levels.back()));
    to_levels.push_back(halved(to_levels.back()));
  }
  WarpGrid flow;
  for (std::size_t level = from_levels.size(); level-- > 0;) {
    const Plane& size = from_levels[level][0];
    WarpGrid finer(0, 0, size.width, size.height, options.spacing);
    const double full_scale = std::ldexp(1.0, static_cast<int>(level));
    if (level + 1 == from_levels.size()) {
      if (start != nullptr) take_over(*start, full_scale, finer);
    } else {
      take_over(flow, 0.5, finer);
    }
    std::vector<float> texture;
    Level(from_levels[level], to_levels[level]).search(finer, texture, options.num_iterations);
    flow = smoothed(finer, texture, options.smoothing);
  }
  return flow;
}

}  // namespace motex
