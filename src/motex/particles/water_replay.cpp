// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/water_replay.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/particles/render.h"

namespace motex {
namespace {

constexpr int kSmall = 4;              // pixels of the picture to one of the small pictures
constexpr double kWidth = 0.3;         // τ / cell_size
constexpr double kReach = 3.2;         // τ beyond which a cell has no weight
constexpr double kCrowded = 0.55;      // of cell_size: nearer cells are one too many
constexpr double kHole = 0.9;          // of cell_size: a place that far from all cells gets one
constexpr double kLeastWeight = 0.08;  // bases with less are not drawn
constexpr std::int64_t kShortest = 4;  // frames that a cell is shown between coming and going, at least
constexpr std::int64_t kFewestFrames = 12;
constexpr double kBalance = 6;  // weight of a place's mean light in the choice of a moment

double square(double a) { return a * a; }

Plane small_picture(std::span<const Base> bases, int width, int height, BaseRenderer& renderer) {
  Planes out{Plane((width + kSmall - 1) / kSmall, (height + kSmall - 1) / kSmall)};
  renderer.add(bases, out);
  return std::move(out[0]);
}

/// Frames in which water passes a cell, at its mean speed where it moves.
double frames_to_pass(const FlowField& flow, double cell_size) {
  double speed = 0, weight = 1e-9;
  for (std::size_t i = 0; i < flow.vx.values.size(); ++i) {
    const double v = std::hypot(static_cast<double>(flow.vx.values[i]), static_cast<double>(flow.vy.values[i]));
    speed += v * v;
    weight += v;
  }
  return std::clamp(cell_size / (speed / weight + 1e-9), 4.0, 24.0);
}

}  // namespace

WaterReplay::WaterReplay(const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height,
                         const FlowField& flow, const WaterReplayOptions& options, std::uint64_t seed)
    : cables_(cables),
      flow_(flow),
      options_(options),
      num_frames_(num_frames),
      width_(width),
      height_(height),
      alive_in_(static_cast<std::size_t>(std::max<std::int64_t>(0, num_frames))),
      rng_(seed) {
  check_options(options);
  if (options_.blend_frames == 0) options_.blend_frames = frames_to_pass(flow, options_.cell_size);
  options_.blend_frames = std::min(options_.blend_frames, static_cast<double>(num_frames) / 4);
  if (num_frames < kFewestFrames) throw InvalidInput("water is synthesized from at least 12 frames");
  for (std::size_t k = 0; k < cables.size(); ++k)
    for (std::int64_t t = std::max<std::int64_t>(0, cables[k].first_frame);
         t < std::min(num_frames, cables[k].end_frame()); ++t)
      alive_in_[static_cast<std::size_t>(t)].push_back(static_cast<int>(k));
  BaseRenderer renderer(1.0 / kSmall);
  for (std::int64_t t = 0; t < num_frames; ++t) {
    std::vector<Base> bases;
    for (const int k : alive_in_[static_cast<std::size_t>(t)])
      bases.push_back(cables[static_cast<std::size_t>(k)].at(t));
    seen_.push_back(small_picture(bases, width, height, renderer));
  }
  sums_.emplace_back(seen_[0].width, seen_[0].height);
  for (const Plane& seen : seen_) {
    sums_.push_back(sums_.back());
    for (std::size_t i = 0; i < seen.values.size(); ++i) sums_.back().values[i] += seen.values[i];
  }
  drift_ = Plane(seen_[0].width, seen_[0].height);
  // so that the first cells belong together
  now_ = seen_[static_cast<std::size_t>(rng_.below(static_cast<std::uint64_t>(num_frames)))];
  energies_ = Plane(now_.width, now_.height);
}

void WaterReplay::move_cells() {
  const double margin = options_.cell_size / 2, step = 1 / options_.blend_frames;
  for (Cell& cell : cells_) {
    const FlowField::Velocity v = flow_.at(cell.x, cell.y);
    cell.x += v.x;
    cell.y += v.y;
    ++cell.moment;
    const auto fade = static_cast<std::int64_t>(options_.blend_frames);
    const bool outside = cell.x < -margin || cell.y < -margin || cell.x > width_ + margin || cell.y > height_ + margin;
    cell.ending = cell.ending || outside || cell.moment >= std::min(cell.last, num_frames_ - fade);
    cell.strength = std::clamp(cell.strength + (cell.ending ? -step : step), 0.0, 1.0);
  }
  std::erase_if(cells_,
                [&](const Cell& cell) { return (cell.ending && cell.strength <= 1e-6) || cell.moment >= num_frames_; });
}

/// Of two that are too near, the one that would end sooner ends now.
void WaterReplay::end_crowded() {
  const double least = square(kCrowded * options_.cell_size);
  for (std::size_t a = 0; a < cells_.size(); ++a)
    for (std::size_t b = a + 1; b < cells_.size(); ++b) {
      if (cells_[a].ending || cells_[b].ending) continue;
      if (square(cells_[a].x - cells_[b].x) + square(cells_[a].y - cells_[b].y) >= least) continue;
      const bool first_sooner = cells_[a].last - cells_[a].moment < cells_[b].last - cells_[b].moment;
      cells_[first_sooner ? a : b].ending = true;
    }
}

void WaterReplay::begin_in_holes() {
  const double gap = options_.cell_size / 3, far = square(kHole * options_.cell_size);
  const double shift_x = rng_.uniform(0, gap), shift_y = rng_.uniform(0, gap);
  for (double y = shift_y; y < height_ + gap; y += gap)
    for (double x = shift_x; x < width_ + gap; x += gap) {
      bool is_hole = true;
      for (const Cell& cell : cells_)
        is_hole = is_hole && (cell.ending || square(cell.x - x) + square(cell.y - y) > far);
      if (is_hole) begin_cell(x, y);
    }
}

void WaterReplay::begin_cell(double x, double y) {
  Cell cell{x, y, choose_moment(x, y), 0, 1 / options_.blend_frames, false, 0};
  const auto life = static_cast<std::int64_t>(std::lround(options_.cell_life * rng_.uniform(0.6, 1.4)));
  cell.last = cell.moment + std::max<std::int64_t>(2, life);
  if (num_shown_ == 0) {  // the first cells are of all ages
    cell.strength = 1;
    cell.last = cell.moment +
                static_cast<std::int64_t>(rng_.below(static_cast<std::uint64_t>(std::max<std::int64_t>(2, life))));
  }
  cell.first_track = num_begun_++ * static_cast<std::int64_t>(cables_.size());
  cells_.push_back(cell);
}

/// Around (x, y): mean squared difference between what is there now and what was there just before that moment, and the
/// square of the mean light that the place would come to by what follows it.
double WaterReplay::mismatch(std::int64_t moment, double x, double y) const {
  const Plane& then = seen_[static_cast<std::size_t>(moment - 1)];
  const auto life = std::min(static_cast<std::int64_t>(options_.cell_life), num_frames_ - moment);
  const Plane &from = sums_[static_cast<std::size_t>(moment)], &to = sums_[static_cast<std::size_t>(moment + life)];
  const Plane& all = sums_.back();
  const auto share = static_cast<float>(static_cast<double>(life) / static_cast<double>(num_frames_));
  const auto part = 1 / static_cast<float>(num_frames_);
  const double reach = 0.75 * options_.cell_size / kSmall;
  const int left = std::max(0, static_cast<int>(x / kSmall - reach)),
            right = std::min(now_.width - 1, static_cast<int>(x / kSmall + reach));
  const int top = std::max(0, static_cast<int>(y / kSmall - reach)),
            bottom = std::min(now_.height - 1, static_cast<int>(y / kSmall + reach));
  double sum = 1e-3;
  int count = 1;
  for (int j = top; j <= bottom; ++j)
    for (int i = left; i <= right; ++i, ++count) {
      const float follows = part * (to.at(i, j) - from.at(i, j) - share * all.at(i, j));
      sum += square(static_cast<double>(then.at(i, j) - now_.at(i, j))) +
             kBalance * square(static_cast<double>(drift_.at(i, j) + follows));
    }
  return sum / count;
}

std::int64_t WaterReplay::choose_moment(double x, double y) {
  const auto choices = static_cast<std::uint64_t>(
      std::max<std::int64_t>(1, num_frames_ - kShortest - static_cast<std::int64_t>(options_.blend_frames)));
  std::vector<std::int64_t> moments;
  std::vector<double> weights;
  double best = 1e300;
  for (int k = 0; k < options_.candidates; ++k) {
    moments.push_back(1 + static_cast<std::int64_t>(rng_.below(choices)));
    weights.push_back(mismatch(moments.back(), x, y));
    best = std::min(best, weights.back());
  }
  const double spread = std::max(1e-9, options_.choice_spread * best);
  for (double& weight : weights) weight = std::exp(-std::min(700.0, (weight - best) / spread));
  return moments[rng_.weighted(weights)];
}

double WaterReplay::falloff(const Cell& cell, double x, double y) const {
  const double distance = (square(x - cell.x) + square(y - cell.y)) / square(kWidth * options_.cell_size);
  return distance < square(kReach) ? cell.strength * std::exp(-distance / 2) : 0;
}

void WaterReplay::sum_energies() {
  std::fill(energies_.values.begin(), energies_.values.end(), 1e-9F);
  const double reach = kReach * kWidth * options_.cell_size;
  for (const Cell& cell : cells_) {
    const int left = std::max(0, static_cast<int>((cell.x - reach) / kSmall)),
              right = std::min(energies_.width - 1, static_cast<int>((cell.x + reach) / kSmall));
    const int top = std::max(0, static_cast<int>((cell.y - reach) / kSmall)),
              bottom = std::min(energies_.height - 1, static_cast<int>((cell.y + reach) / kSmall));
    for (int j = top; j <= bottom; ++j)
      for (int i = left; i <= right; ++i)
        energies_.at(i, j) += static_cast<float>(square(falloff(cell, i * kSmall, j * kSmall)));
  }
}

double WaterReplay::weight_of(const Cell& cell, double x, double y) const {
  const double own = falloff(cell, x, y);
  if (own <= 0) return 0;
  const int i = std::clamp(static_cast<int>(std::lround(x / kSmall)), 0, energies_.width - 1);
  const int j = std::clamp(static_cast<int>(std::lround(y / kSmall)), 0, energies_.height - 1);
  return std::min(1.0, own / std::sqrt(static_cast<double>(energies_.at(i, j))));
}

void WaterReplay::show_cell(const Cell& cell, MovetonFrame& frame) const {
  for (const int k : alive_in_[static_cast<std::size_t>(cell.moment)]) {
    const Cable& cable = cables_[static_cast<std::size_t>(k)];
    const Base& core = cable.at(cell.moment);
    const double weight = weight_of(cell, core.x, core.y);
    if (weight < kLeastWeight) continue;
    const auto age = static_cast<std::size_t>(cell.moment - cable.first_frame);
    const std::size_t before = age > 0 ? age - 1 : 0, after = std::min(age + 1, cable.core.size() - 1);
    const double span = static_cast<double>(std::max<std::size_t>(1, after - before));
    frame.movetons.push_back(
        {cell.first_track + k, cable.species, 0, 0, (cable.core[after].x - cable.core[before].x) / span,
         (cable.core[after].y - cable.core[before].y) / span, frame.bases.size(), 1 + cable.coils.size()});
    const std::size_t first = frame.bases.size();
    frame.bases.push_back(core);
    for (const std::vector<Base>& coil : cable.coils) frame.bases.push_back(coil[age]);
    for (std::size_t b = first; b < frame.bases.size(); ++b)
      for (float& coefficient : frame.bases[b].coefficients) coefficient *= static_cast<float>(weight);
  }
}

void WaterReplay::next(MovetonFrame& frame) {
  move_cells();
  end_crowded();
  begin_in_holes();
  sum_energies();
  frame.clear();
  frame.frame = num_shown_++;
  for (const Cell& cell : cells_) show_cell(cell, frame);
  BaseRenderer renderer(1.0 / kSmall);
  now_ = small_picture(frame.bases, width_, height_, renderer);
  const auto part = 1 / static_cast<float>(num_frames_);
  for (std::size_t i = 0; i < drift_.values.size(); ++i)
    drift_.values[i] += part * (now_.values[i] - part * sums_.back().values[i] - drift_.values[i]);
}

}  // namespace motex
