// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_state.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kCellSize = 8;  // pixels

}  // namespace

CableState::CableState(const std::vector<Plane>& residuals, const std::vector<Cable>& start, const CableLaw& law) {
  if (residuals.empty() || residuals[0].width < 1 || residuals[0].height < 1)
    throw InvalidInput("sampling cables: there are no pictures");
  width_ = residuals[0].width;
  height_ = residuals[0].height;
  cells_across_ = (width_ + kCellSize - 1) / kCellSize;
  cells_down_ = (height_ + kCellSize - 1) / kCellSize;
  frames_.reserve(residuals.size());
  for (const Plane& plane : residuals) {
    if (plane.width != width_ || plane.height != height_)
      throw InvalidInput("sampling cables: the pictures differ in size");
    frames_.emplace_back(plane);
    frames_.back().cells.resize(static_cast<std::size_t>(num_cells()));
  }
  for (const Cable& cable : start) {
    int before = -1;
    for (std::int64_t t = cable.first_frame; t < cable.end_frame(); ++t) {
      const int frame = static_cast<int>(t);
      const CoreState z = core_state(cable.at(t));
      const BaseKind kind = cable.at(t).kind;
      if (t < 0 || t >= num_frames() || !law.is_possible(kind, z) ||
          static_cast<int>(live(frame).size()) >= law.prior().max_per_frame) {
        before = -1;
        continue;
      }
      const int idx = add(frame, kind, z);
      if (before >= 0 && element(frame - 1, before).kind == kind) link(frame - 1, before, idx);
      before = idx;
    }
  }
}

int CableState::cell_of(const CoreState& z) const {
  const int x = std::clamp(static_cast<int>(std::lround(z[kCoreX])), 0, width_ - 1),
            y = std::clamp(static_cast<int>(std::lround(z[kCoreY])), 0, height_ - 1);
  return y / kCellSize * cells_across_ + x / kCellSize;
}

PictureCell CableState::cell(int idx) const {
  const int left = idx % cells_across_ * kCellSize, top = idx / cells_across_ * kCellSize;
  return {left, top, std::min(kCellSize, width_ - left), std::min(kCellSize, height_ - top)};
}

void CableState::list_in(Frame& frame, int idx, int cell) {
  std::vector<int>& list = frame.cells[static_cast<std::size_t>(cell)];
  CoreElement& element = frame.elements[static_cast<std::size_t>(idx)];
  element.cell = cell;
  element.place = static_cast<int>(list.size());
  list.push_back(idx);
}

void CableState::unlist(Frame& frame, int idx) {
  const CoreElement& element = frame.elements[static_cast<std::size_t>(idx)];
  std::vector<int>& list = frame.cells[static_cast<std::size_t>(element.cell)];
  const int last = list.back();
  list[static_cast<std::size_t>(element.place)] = last;
  frame.elements[static_cast<std::size_t>(last)].place = element.place;
  list.pop_back();
}

int CableState::add(int frame, BaseKind kind, const CoreState& z) {
  Frame& f = at(frame);
  int idx = static_cast<int>(f.elements.size());
  if (f.free.empty()) {
    f.elements.emplace_back();
  } else {
    idx = f.free.back();
    f.free.pop_back();
  }
  CoreElement& element = f.elements[static_cast<std::size_t>(idx)];
  element = CoreElement{};
  element.z = z;
  element.kind = kind;
  element.live_place = static_cast<int>(f.live.size());
  f.live.push_back(idx);
  list_in(f, idx, cell_of(z));
  paint_core(f.image, kind, z, -1);
  return idx;
}

void CableState::remove(int frame, int idx) {
  Frame& f = at(frame);
  CoreElement& element = f.elements[static_cast<std::size_t>(idx)];
  paint_core(f.image, element.kind, element.z, 1);
  unlist(f, idx);
  const int last = f.live.back();
  f.live[static_cast<std::size_t>(element.live_place)] = last;
  f.elements[static_cast<std::size_t>(last)].live_place = element.live_place;
  f.live.pop_back();
  element.live_place = -1;
  f.free.push_back(idx);
}

void CableState::place(int frame, int idx, const CoreState& z) {
  Frame& f = at(frame);
  CoreElement& element = f.elements[static_cast<std::size_t>(idx)];
  element.z = z;
  const int cell = cell_of(z);
  if (cell == element.cell) return;
  unlist(f, idx);
  list_in(f, idx, cell);
}

void CableState::paint(int frame, int idx, float sign) {
  Frame& f = at(frame);
  const CoreElement& element = f.elements[static_cast<std::size_t>(idx)];
  paint_core(f.image, element.kind, element.z, sign);
}

void CableState::link(int frame, int idx, int next_idx) {
  at(frame).elements[static_cast<std::size_t>(idx)].next = next_idx;
  at(frame + 1).elements[static_cast<std::size_t>(next_idx)].previous = idx;
}

void CableState::cut_after(int frame, int idx) {
  int& next = at(frame).elements[static_cast<std::size_t>(idx)].next;
  if (next >= 0) at(frame + 1).elements[static_cast<std::size_t>(next)].previous = -1;
  next = -1;
}

void CableState::near(int frame, double x, double y, double radius, std::vector<int>& out) const {
  const Frame& f = at(frame);
  const auto clamp_cell = [](double v, int size, int cells) {
    return std::clamp(static_cast<int>(std::lround(std::clamp(v, 0.0, size - 1.0))) / kCellSize, 0, cells - 1);
  };
  const int left = clamp_cell(x - radius, width_, cells_across_), right = clamp_cell(x + radius, width_, cells_across_);
  const int top = clamp_cell(y - radius, height_, cells_down_), bottom = clamp_cell(y + radius, height_, cells_down_);
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column)
      for (const int idx : f.cells[static_cast<std::size_t>(row * cells_across_ + column)]) {
        const CoreState& z = f.elements[static_cast<std::size_t>(idx)].z;
        const double dx = z[kCoreX] - x, dy = z[kCoreY] - y;
        if (dx * dx + dy * dy <= radius * radius) out.push_back(idx);
      }
}

void CableState::save(int first, int end, Snapshot& snapshot) const {
  snapshot.first = first;
  snapshot.end = end;
  for (int t = first; t < end; ++t) {
    const auto k = static_cast<std::size_t>(t - first);
    if (k < snapshot.frames.size())
      snapshot.frames[k] = at(t);
    else
      snapshot.frames.push_back(at(t));
  }
}

void CableState::restore(const Snapshot& snapshot) {
  for (int t = snapshot.first; t < snapshot.end; ++t)
    at(t) = snapshot.frames[static_cast<std::size_t>(t - snapshot.first)];
}

std::vector<Cable> CableState::cables() const {
  std::vector<Cable> all;
  for (int t = 0; t < num_frames(); ++t) {
    std::vector<int> starts;
    for (const int idx : live(t))
      if (element(t, idx).previous < 0) starts.push_back(idx);
    std::sort(starts.begin(), starts.end(), [&](int a, int b) {
      const CoreState &u = element(t, a).z, &v = element(t, b).z;
      return u[kCoreX] != v[kCoreX] ? u[kCoreX] < v[kCoreX] : u[kCoreY] < v[kCoreY];
    });
    for (const int start : starts) {
      Cable cable;
      cable.first_frame = t;
      for (int frame = t, idx = start; idx >= 0; idx = element(frame, idx).next, ++frame)
        cable.core.push_back(core_base(element(frame, idx).kind, element(frame, idx).z));
      all.push_back(std::move(cable));
    }
  }
  return all;
}

std::int64_t CableState::num_elements() const {
  std::int64_t sum = 0;
  for (const Frame& frame : frames_) sum += static_cast<std::int64_t>(frame.live.size());
  return sum;
}

double log_posterior(const CableState& state, const CableLaw& law) {
  const double noise = law.prior().noise;
  double sum = 0;
  for (int t = 0; t < state.num_frames(); ++t) {
    const ResidualFrame& image = state.image(t);
    sum -= image.squared_error() / (2 * noise * noise) +
           static_cast<double>(image.width()) * image.height() * std::log(noise);
    for (const int idx : state.live(t)) {
      const CoreElement& now = state.element(t, idx);
      const CoreElement* before = now.previous < 0 ? nullptr : &state.element(t - 1, now.previous);
      const CoreElement* before2 =
          before == nullptr || before->previous < 0 ? nullptr : &state.element(t - 2, before->previous);
      if (before == nullptr) sum += law.log_birth(now.z, t);
      if (before != nullptr && before2 == nullptr) sum += law.log_first_step(now.kind, before->z, now.z);
      if (before2 != nullptr) sum += law.log_step(now.kind, before2->z, before->z, now.z);
      sum += law.log_end(before == nullptr ? nullptr : &before->z, now.z, t, now.next >= 0);
    }
  }
  return sum;
}

}  // namespace motex
