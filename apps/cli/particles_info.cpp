// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>

#include "commands.h"
#include "motex/project/compression.h"
#include "motex/project/textured_motion_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

/// Counts over a model's cables.
struct CableCounts {
  std::int64_t elements = 0;  ///< frames of cables inside the picture
  std::int64_t bases = 0;
  double mean_life = 0;
};

CableCounts count(const TexturedMotion& model) {
  CableCounts counts;
  for (const Cable& cable : model.cables)
    for (const Base& base : cable.core)
      if (is_inside(base.x, base.y, model.width, model.height)) {
        ++counts.elements;
        counts.bases += 1 + static_cast<std::int64_t>(cable.coils.size());
      }
  if (!model.cables.empty())
    counts.mean_life = static_cast<double>(counts.elements) / static_cast<double>(model.cables.size());
  return counts;
}

Value coordinate_value(const CoordinateDynamics& z) {
  Value object;
  object["a"] = z.a;
  object["b"] = z.b;
  object["c"] = z.c;
  object["d"] = z.d;
  object["a0"] = z.a0;
  object["c0"] = z.c0;
  object["d0"] = z.d0;
  object["c_spread"] = z.c_spread;
  return object;
}

Value dynamics_value(const MovetonDynamics& one) {
  Value object;
  object["persistence_x"] = one.x.persistence();
  object["persistence_y"] = one.y.persistence();
  object["mean_velocity_x"] = one.x.mean_velocity();
  object["mean_velocity_y"] = one.y.mean_velocity();
  object["x"] = coordinate_value(one.x);
  object["y"] = coordinate_value(one.y);
  object["log_scale"] = coordinate_value(one.log_scale);
  object["angle"] = coordinate_value(one.angle);
  object["amplitude"] = coordinate_value(one.amplitude);
  return object;
}

Value pose_transitions_value(const MovetonTemplate& one) {
  Value rows = Value::List();
  const int n = one.pose_transitions.num_states();
  for (int i = 0; i < n; ++i) {
    Value row = Value::List();
    for (int j = 0; j < n; ++j) row.append(one.pose_transitions.probability(i, j));
    rows.append(std::move(row));
  }
  return rows;
}

Value template_value(const MovetonTemplate& one, const MovetonDynamics& dynamics) {
  Value object;
  object["share"] = one.share;
  object["scale"] = std::exp(one.log_scale.mean);
  object["amplitude"] = one.amplitude.mean;
  object["poses"] = static_cast<std::int64_t>(one.poses.size());
  object["coils"] = static_cast<std::int64_t>(one.poses.empty() ? 0 : one.poses[0].coils.size());
  object["pose_transitions"] = pose_transitions_value(one);
  object["dynamics"] = dynamics_value(dynamics);
  return object;
}

struct Info {
  std::string model_path;

  void declare(Arguments& arguments) { arguments.positional("MODEL", "made by motex particles learn", model_path); }

  void run(Session& session) {
    const TexturedMotion model = load_textured_motion(model_path);
    const CableCounts counts = count(model);
    const CompressionSummary sizes = measure_compression(model);
    session.result(value(model, counts, sizes), text(model, counts, sizes));
  }

 private:
  double per_frame(const TexturedMotion& model, std::int64_t number) const {
    return static_cast<double>(number) / static_cast<double>(std::max<std::int64_t>(1, model.num_frames));
  }

  Value value(const TexturedMotion& model, const CableCounts& counts, const CompressionSummary& sizes) const {
    Value object;
    object["model"] = model_path;
    object["bytes"] = static_cast<std::int64_t>(std::filesystem::file_size(model_path));
    object["source"] = model.source;
    object["width"] = model.width;
    object["height"] = model.height;
    object["planes"] = model.num_planes;
    object["frames"] = model.num_frames;
    object["frames_per_sec"] = model.frames_per_sec;
    object["seed"] = model.seed;
    object["background"] = name_of(model.background_kind);
    object["noise"] = model.noise;
    object["flow_x"] = model.flow.vx;
    object["flow_y"] = model.flow.vy;
    object["flow_peak_ratio"] = model.flow.peak_ratio;
    object["water"] = model.water.has_value();
    object["cables"] = static_cast<std::int64_t>(model.cables.size());
    object["elements_per_frame"] = per_frame(model, counts.elements);
    object["bases_per_frame"] = per_frame(model, counts.bases);
    object["mean_life_frames"] = counts.mean_life;
    object["births_per_frame"] = model.maps.births_per_frame;
    object["bursts"] = static_cast<std::int64_t>(model.maps.bursts.size());
    object["raw_bytes"] = sizes.raw_bytes;
    object["clip_bytes"] = sizes.clip_bytes;
    object["clip_ratio"] = sizes.clip_ratio();
    object["model_bytes"] = sizes.model_bytes;
    object["model_ratio"] = sizes.model_ratio();
    object["templates"] = Value::List();
    for (std::size_t k = 0; k < model.templates.size(); ++k)
      object["templates"].append(template_value(model.templates[k], model.dynamics[k]));
    return object;
  }

  std::string text(const TexturedMotion& model, const CableCounts& counts, const CompressionSummary& sizes) const {
    std::string out = text_pairs(
        {{"model", model_path},
         {"learned from", model.source + ", " + std::to_string(model.num_frames) + " frames of " +
                              std::to_string(model.width) + " × " + std::to_string(model.height) + " at " +
                              fixed(model.frames_per_sec, 2) + " a second"},
         {"background",
          std::string(name_of(model.background_kind)) + ", noise " + fixed(model.noise, 2) + " grey levels"},
         {model.water ? "water" : "elements",
          std::to_string(model.cables.size()) + (model.water ? " bases carried, " : " followed, ") +
              fixed(per_frame(model, counts.elements), 1) + " a frame, " + fixed(counts.mean_life, 1) + " frames long"},
         {"bases", fixed(per_frame(model, counts.bases), 1) + " a frame"},
         {"shared flow", fixed(model.flow.vx, 2) + ", " + fixed(model.flow.vy, 2) + " px a frame, " +
                             (model.flow.peak_ratio < 20 ? "not to be trusted" : "clear") + " (peak " +
                             fixed(model.flow.peak_ratio, 0) + " × the median)"},
         {"births",
          fixed(model.maps.births_per_frame, 2) + " a frame, " + std::to_string(model.maps.bursts.size()) + " bursts"},
         {"compression", "clip " + fixed(sizes.clip_ratio(), 0) + " × (" + std::to_string(sizes.clip_bytes) +
                             " bytes), model alone " + fixed(sizes.model_ratio(), 0) + " × (" +
                             std::to_string(sizes.model_bytes) + " bytes)"},
         {"seed", std::to_string(model.seed)}});
    std::vector<std::vector<std::string>> rows{
        {"species", "share %", "scale px", "peak", "poses", "coils", "velocity", "persistence"}};
    for (std::size_t k = 0; k < model.templates.size(); ++k) {
      const MovetonTemplate& one = model.templates[k];
      const MovetonDynamics& moves = model.dynamics[k];
      rows.push_back({std::to_string(k), fixed(100 * one.share, 1), fixed(std::exp(one.log_scale.mean), 2),
                      fixed(one.amplitude.mean, 1), std::to_string(one.poses.size()),
                      std::to_string(one.poses.empty() ? 0 : one.poses[0].coils.size()),
                      fixed(moves.x.mean_velocity(), 2) + ", " + fixed(moves.y.mean_velocity(), 2),
                      fixed(moves.x.persistence(), 2) + ", " + fixed(moves.y.persistence(), 2)});
    }
    return model.templates.empty() ? out : out + "\n" + text_table(rows);
  }
};

}  // namespace

Command particles_info() {
  return make_command<Info>({"particles info", "what a model of moving elements holds", "",
                             "motex particles info snow.motex\n"
                             "motex particles info snow.motex --json"});
}

}  // namespace motex::cli
