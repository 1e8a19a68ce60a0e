// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/particles/bursts.h"
#include "motex/plot/charts.h"
#include "output_folder.h"
#include "particles_model.h"
#include "text_table.h"

namespace motex::cli {
namespace {

template <typename... Numbers>
std::string line(const char* format, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

std::string ends_table(const std::vector<CableEnd>& ends) {
  std::string text = "track,frame,x,y,vx,vy\n";
  for (const CableEnd& end : ends)
    text += line("%d,%lld,%.3f,%.3f,%.4f,%.4f\n", end.cable, static_cast<long long>(end.frame), end.x, end.y, end.vx,
                 end.vy);
  return text;
}

std::string bursts_table(const std::vector<Burst>& bursts) {
  std::string text = "burst,frame,x,y,elements\n";
  for (std::size_t i = 0; i < bursts.size(); ++i)
    text += line("%zu,%.3f,%.3f,%.3f,%zu\n", i, bursts[i].frame, bursts[i].x, bursts[i].y, bursts[i].cables.size());
  return text;
}

Value spread_value(const Spread& spread) {
  Value object;
  object["mean"] = spread.mean;
  object["deviation"] = spread.deviation;
  return object;
}

/// Colours end at the 99.5 % quantile, so that one bright pixel does not darken all others.
Drawing heat_map(const std::string& title, const std::string& unit, const Plane& plane, double factor) {
  HeatMap map;
  map.title = title;
  map.value_label = unit;
  map.values.resize(plane.height, plane.width);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) map.values(y, x) = factor * static_cast<double>(plane.at(x, y));
  std::vector<double> sorted(map.values.data(), map.values.data() + map.values.size());
  const auto place = static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
  map.min = 0;
  map.max = std::max(sorted[static_cast<std::size_t>(place)], 1e-12);
  map.size = {460, 100 + 360.0 * plane.height / plane.width};
  return draw(map);
}

Drawing picture_of(const BirthDeathMaps& maps, std::int64_t num_frames) {
  const double deaths_per_frame =
      static_cast<double>(maps.deaths.size()) / static_cast<double>(std::max<std::int64_t>(1, num_frames - 1));
  return grid({heat_map("source", "births per frame and 1000 pixels", maps.source, 1000 * maps.births_per_frame),
               heat_map("sink", "deaths per frame and 1000 pixels", maps.sink, 1000 * deaths_per_frame),
               heat_map("hazard", "probability to die before the next frame", maps.hazard, 1),
               heat_map("occupancy", "elements in 1000 pixels", maps.occupancy, 1000)},
              2, "");
}

struct Maps {
  std::string model_path, output;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex particles learn", model_path);
    arguments.value("-o,--output", "DIR", "folder for the maps", output).required = true;
  }

  void run(Session& session) {
    check_output_folder(output, session);
    const TexturedMotion model = load_particles_model(model_path);
    const BirthDeathMaps& maps = model.maps;
    if (model.water)
      throw InvalidInput(model_path +
                         ": is a model of water, whose bases are born together: it has no maps (learn with --tracking "
                         "cores where there are elements)");
    if (maps.source.values.empty()) throw InvalidInput(model_path + ": holds no birth and death maps; learn it again");
    const Value object = value(model);
    if (!session.flags.dry_run) {
      OutputFolder folder(output);
      write_file(folder.file("source.png"), encode_png(image_of_density(maps.source)));
      write_file(folder.file("sink.png"), encode_png(image_of_density(maps.sink)));
      write_file(folder.file("occupancy.png"), encode_png(image_of_density(maps.occupancy)));
      write_file(folder.file("hazard.png"), encode_png(image_of_hazard(maps.hazard)));
      write_file(folder.file("births.csv"), ends_table(maps.births));
      write_file(folder.file("deaths.csv"), ends_table(maps.deaths));
      write_file(folder.file("bursts.csv"), bursts_table(maps.bursts));
      write_picture(folder.file("maps.png"), picture_of(maps, model.num_frames));
      write_file(folder.file("maps.json"), to_json(object) + "\n");
      folder.commit();
      session.say("wrote " + output);
    }
    session.result(object, text_pairs({{"births", std::to_string(maps.births.size())},
                                       {"births per frame", fixed(maps.births_per_frame, 3)},
                                       {"deaths", std::to_string(maps.deaths.size())},
                                       {"bursts", std::to_string(maps.bursts.size())},
                                       {"bandwidth px", fixed(maps.bandwidth, 2)}}));
  }

 private:
  Value value(const TexturedMotion& model) const {
    const BirthDeathMaps& maps = model.maps;
    Value object;
    object["model"] = model_path;
    object["output"] = output;
    object["width"] = maps.width;
    object["height"] = maps.height;
    object["births"] = static_cast<std::int64_t>(maps.births.size());
    object["births_per_frame"] = maps.births_per_frame;
    object["deaths"] = static_cast<std::int64_t>(maps.deaths.size());
    object["bandwidth"] = maps.bandwidth;
    double elements = 0;
    for (const float here : maps.occupancy.values) elements += static_cast<double>(here);
    object["elements_per_frame"] = elements;
    object["bursts_per_frame"] = maps.bursts_per_frame;
    object["bursts"] = Value::List();
    for (const Burst& burst : maps.bursts) {
      Value entry;
      entry["frame"] = burst.frame;
      entry["x"] = burst.x;
      entry["y"] = burst.y;
      entry["elements"] = static_cast<std::int64_t>(burst.cables.size());
      object["bursts"].append(std::move(entry));
    }
    if (!maps.bursts.empty()) {
      const BurstStatistics statistics = burst_statistics(maps.bursts, model.cables, model.num_frames);
      Value& entry = object["burst"];
      entry["elements"] = spread_value(statistics.num_cables);
      entry["speed"] = spread_value(statistics.speed);
      entry["life_frames"] = spread_value(statistics.life);
      entry["angle_coverage"] = statistics.angle_coverage;
    }
    return object;
  }
};

}  // namespace

Command particles_maps() {
  return make_command<Maps>(
      {"particles maps", "where elements are born, are, and die",
       "source.png, sink.png and occupancy.png are densities, 255 = the largest; hazard.png is 255 times the square "
       "root "
       "of the probability to die before the next frame. source.png, sink.png and hazard.png can be painted and given "
       "to "
       "particles synthesize (--source-map, --sink-map, --hazard-map); of the first two only proportions count. "
       "maps.png shows all with scales; "
       "births.csv, deaths.csv, bursts.csv, maps.json.",
       "motex particles maps snow.motex -o snow_maps\n"
       "motex particles maps fireworks.motex -o maps --json"});
}

}  // namespace motex::cli
