// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/textured_motion_rows.h"

#include <cmath>

namespace motex {
namespace {

using Ints = std::vector<std::int64_t>;

FrameMatrix ends_matrix(const std::vector<CableEnd>& ends) {
  TableWriter table(6);
  for (const CableEnd& end : ends)
    table.row({end.x, end.y, end.vx, end.vy, static_cast<double>(end.frame), static_cast<double>(end.cable)});
  return table.matrix();
}

std::vector<CableEnd> read_ends(const ArchiveReader& in, const char* name, std::size_t num_cables) {
  TableReader table(in, name, 6);
  std::vector<CableEnd> ends;
  while (table.next_row_if_any()) {
    CableEnd& end = ends.emplace_back();
    end.x = table.take();
    end.y = table.take();
    end.vx = table.take();
    end.vy = table.take();
    const double frame = table.take();
    if (!(std::abs(frame) < 1e9)) in.fail("a birth or death is out of range");
    end.frame = static_cast<std::int64_t>(frame);
    end.cable = table.take_count(static_cast<double>(num_cables) - 1);
  }
  return ends;
}

void write_plane(ArchiveWriter& out, const char* name, const Plane& plane) {
  out.add(name, FrameMatrixF(Eigen::Map<const FrameMatrixF>(plane.values.data(), plane.height, plane.width)));
}

Plane read_plane(const ArchiveReader& in, const char* name, const BirthDeathMaps& maps) {
  const FrameMatrixF values = in.matrix_f(name, maps.height, maps.width);
  Plane plane(maps.width, maps.height);
  std::copy(values.data(), values.data() + values.size(), plane.values.begin());
  for (const float value : plane.values)
    if (!(value >= 0)) in.fail(std::string("the map '") + name + "' has a negative value");
  return plane;
}

}  // namespace

FrameMatrix TableWriter::matrix() const {
  return Eigen::Map<const FrameMatrix>(values_.data(), num_rows_, num_columns_);
}

TableReader::TableReader(const ArchiveReader& in, std::string name, Index num_columns)
    : in_(in), name_(std::move(name)), values_(in.matrix(name_, -1, num_columns)) {}

bool TableReader::next_row_if_any() {
  column_ = 0;
  return ++row_ < values_.rows();
}

void TableReader::next_row() {
  if (!next_row_if_any()) in_.fail("the array '" + name_ + "' ends too early");
}

double TableReader::take() { return values_(row_, column_++); }

int TableReader::take_count(double most) {
  const double value = take();
  if (!(value >= 0 && value <= most) || value != std::floor(value))
    in_.fail("the array '" + name_ + "' has a number that is out of range");
  return static_cast<int>(value);
}

Spread TableReader::take_spread() {
  Spread spread{take(), 0};
  spread.deviation = take();
  return spread;
}

void write_maps(ArchiveWriter& out, const BirthDeathMaps& maps) {
  if (maps.source.values.empty()) return;
  const double rates[] = {maps.births_per_frame, maps.bursts_per_frame, maps.bandwidth};
  out.add("map_rates", rates);
  out.add("births", ends_matrix(maps.births));
  out.add("deaths", ends_matrix(maps.deaths));
  TableWriter bursts(4);
  Ints burst_cables;
  for (const Burst& burst : maps.bursts) {
    bursts.row({burst.x, burst.y, burst.frame, static_cast<double>(burst.cables.size())});
    burst_cables.insert(burst_cables.end(), burst.cables.begin(), burst.cables.end());
  }
  out.add("bursts", bursts.matrix());
  out.add("burst_cables", burst_cables);
  write_plane(out, "source_map", maps.source);
  write_plane(out, "sink_map", maps.sink);
  write_plane(out, "occupancy_map", maps.occupancy);
  write_plane(out, "hazard_map", maps.hazard);
}

void read_maps(const ArchiveReader& in, TexturedMotion& model) {
  BirthDeathMaps& maps = model.maps;
  maps.width = model.width;
  maps.height = model.height;
  if (!in.has("source_map")) return;
  const auto rates = in.doubles("map_rates", 3);
  maps.births_per_frame = rates[0];
  maps.bursts_per_frame = rates[1];
  maps.bandwidth = rates[2];
  if (!(rates[0] >= 0 && rates[0] < 1e7 && rates[1] >= 0 && rates[1] < 1e7 && rates[2] >= 0))
    in.fail("the rate of births is out of range");
  maps.births = read_ends(in, "births", model.cables.size());
  maps.deaths = read_ends(in, "deaths", model.cables.size());
  TableReader bursts(in, "bursts", 4);
  const Ints cables = in.ints("burst_cables");
  std::size_t next = 0;
  while (bursts.next_row_if_any()) {
    Burst& burst = maps.bursts.emplace_back();
    burst.x = bursts.take();
    burst.y = bursts.take();
    burst.frame = bursts.take();
    for (int left = bursts.take_count(static_cast<double>(cables.size() - next)); left > 0; --left) {
      const std::int64_t cable = cables[next++];
      if (cable < 0 || cable >= static_cast<std::int64_t>(model.cables.size())) in.fail("a burst has no such cable");
      burst.cables.push_back(static_cast<int>(cable));
    }
  }
  maps.source = read_plane(in, "source_map", maps);
  maps.sink = read_plane(in, "sink_map", maps);
  maps.occupancy = read_plane(in, "occupancy_map", maps);
  maps.hazard = read_plane(in, "hazard_map", maps);
}

}  // namespace motex
