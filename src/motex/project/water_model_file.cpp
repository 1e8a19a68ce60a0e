// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/water_model_file.h"

#include <algorithm>
#include <cmath>

#include "motex/project/textured_motion_rows.h"

namespace motex {
namespace {

constexpr double kMostReach = 16;    // pixels, of a neighbour
constexpr double kMostPast = 8;      // frames
constexpr double kMostSpeed = 1000;  // pixels a frame

FrameMatrixF matrix_of(const Plane& plane) {
  FrameMatrixF out(plane.height, plane.width);
  std::copy(plane.values.begin(), plane.values.end(), out.data());
  return out;
}

Plane plane_of(const ArchiveReader& in, const std::string& name, int width, int height, float least, float most) {
  const FrameMatrixF values = in.matrix_f(name, height, width);
  Plane out(width, height);
  std::copy(values.data(), values.data() + values.size(), out.values.begin());
  for (const float value : out.values)
    if (!(value >= least && value <= most)) in.fail("the water's " + name + " is out of range");
  return out;
}

}  // namespace

void write_water(ArchiveWriter& out, const TexturedMotion& model) {
  if (!model.water) return;
  const FlowField& flow = model.water->flow;
  const StarModel& light = model.water->light;
  const double numbers[] = {static_cast<double>(flow.spacing), light.noise};
  out.add("water", numbers);
  out.add("water_flow_x", matrix_of(flow.vx));
  out.add("water_flow_y", matrix_of(flow.vy));
  out.add("water_flow_strength", matrix_of(flow.strength));
  out.add("water_light_mean", matrix_of(light.mean));
  out.add("water_light_deviation", matrix_of(light.deviation));
  TableWriter neighbours(4);
  for (const StarModel::Neighbour& n : light.neighbours)
    neighbours.row({static_cast<double>(n.dx), static_cast<double>(n.dy), static_cast<double>(n.dt), n.weight});
  out.add("water_light_neighbours", neighbours.matrix());
}

void read_water(const ArchiveReader& in, TexturedMotion& model) {
  if (!in.has("water")) return;
  WaterModel water;
  const std::vector<double> numbers = in.doubles("water", 2);
  if (!(numbers[0] >= 1 && numbers[0] <= 4096) || numbers[0] != std::floor(numbers[0]) ||
      !(numbers[1] >= 0 && numbers[1] <= 100))
    in.fail("the description of the water is out of range");
  FlowField& flow = water.flow;
  flow.spacing = static_cast<int>(numbers[0]);
  const int across = (model.width + flow.spacing - 1) / flow.spacing,
            down = (model.height + flow.spacing - 1) / flow.spacing;
  const auto speed = static_cast<float>(kMostSpeed);
  flow.vx = plane_of(in, "water_flow_x", across, down, -speed, speed);
  flow.vy = plane_of(in, "water_flow_y", across, down, -speed, speed);
  flow.strength = plane_of(in, "water_flow_strength", across, down, 0, 1);
  StarModel& light = water.light;
  light.noise = numbers[1];
  light.flow = flow;
  light.mean = plane_of(in, "water_light_mean", model.width, model.height, -1000, 1000);
  light.deviation = plane_of(in, "water_light_deviation", model.width, model.height, 0, 1000);
  TableReader neighbours(in, "water_light_neighbours", 4);
  while (neighbours.next_row_if_any()) {
    StarModel::Neighbour& n = light.neighbours.emplace_back();
    const double dx = neighbours.take(), dy = neighbours.take(), dt = neighbours.take();
    n.weight = neighbours.take();
    const bool whole = dx == std::floor(dx) && dy == std::floor(dy) && dt == std::floor(dt);
    const bool known = dt < 0 || dy < 0 || (dy == 0 && dx < 0);  // drawn before the pixel in question
    if (!whole || !known || std::abs(dx) > kMostReach || std::abs(dy) > kMostReach || dt > 0 || dt < -kMostPast ||
        !(dt < 0 || dy <= 0) || !(std::abs(n.weight) <= 100))
      in.fail("a neighbour of the water's light is out of range");
    n.dx = static_cast<int>(dx);
    n.dy = static_cast<int>(dy);
    n.dt = static_cast<int>(dt);
  }
  model.water = std::move(water);
}

}  // namespace motex
