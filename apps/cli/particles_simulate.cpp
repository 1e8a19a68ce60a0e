// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <set>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/image/png.h"
#include "motex/particles/simulate.h"
#include "motex/video_io/video_writer.h"
#include "options_value.h"
#include "output_folder.h"
#include "text_table.h"

namespace motex::cli {
namespace {

std::string tracks_table(const SimulatedScene& scene) {
  std::string text = "track,frame,x,y,scale,angle,amplitude,state\n";
  char line[160];
  for (const SimulatedPoint& point : scene.points) {
    std::snprintf(line, sizeof line, "%lld,%lld,%.4f,%.4f,%.4f,%.4f,%.2f,%d\n", static_cast<long long>(point.track),
                  static_cast<long long>(point.frame), point.x, point.y, point.scale, point.angle, point.amplitude,
                  point.state);
    text += line;
  }
  return text;
}

Value truth_of(const SimulatedScene& scene) {
  Value truth;
  truth["width"] = scene.width;
  truth["height"] = scene.height;
  truth["frames"] = static_cast<std::int64_t>(scene.frames.size());
  truth["frames_per_sec"] = scene.frames_per_sec;
  std::set<std::int64_t> tracks;
  for (const SimulatedPoint& point : scene.points) tracks.insert(point.track);
  truth["tracks"] = static_cast<std::int64_t>(tracks.size());
  truth["points"] = static_cast<std::int64_t>(scene.points.size());
  truth["elements_per_frame"] = static_cast<double>(scene.points.size()) / static_cast<double>(scene.frames.size());
  truth["persistence"] = scene.persistence;
  truth["velocity_noise"] = scene.noise;
  truth["mean_velocity"] = Value::List{scene.mean_velocity_x, scene.mean_velocity_y};
  if (scene.wing_transitions.num_states() > 0) {
    for (int i = 0; i < scene.wing_transitions.num_states(); ++i) {
      Value row;
      for (int j = 0; j < scene.wing_transitions.num_states(); ++j)
        row.append(scene.wing_transitions.probability(i, j));
      truth["wing_transitions"].append(std::move(row));
    }
  }
  truth["bursts"] = Value::List();
  for (const SimulatedBurst& burst : scene.bursts) {
    Value entry;
    entry["frame"] = burst.frame;
    entry["x"] = burst.x;
    entry["y"] = burst.y;
    entry["sparks"] = burst.num_sparks;
    entry["first_track"] = burst.first_track;
    truth["bursts"].append(std::move(entry));
  }
  return truth;
}

template <typename Options, SimulatedScene (*simulate)(const Options&)>
struct Simulate {
  std::string output;
  Options options;

  void declare(Arguments& arguments) {
    arguments.value("-o,--output", "DIR", "folder for the scene", output).required = true;
    arguments.section("Scene");
    arguments.options(options);
  }

  void run(Session& session) {
    check_options(options);
    check_output_folder(output, session);
    Value object;
    object["output"] = output;
    object["seed"] = options.seed;
    object["options"] = options_value(options);
    if (session.flags.dry_run) {
      session.result(object, "");
      return;
    }
    JobContext job = session.job();
    job.progress("drawing frames", 0);
    const SimulatedScene scene = simulate(options);
    OutputFolder folder(output);
    VideoWriter video(folder.file("scene.mkv"), scene.width, scene.height, {scene.frames_per_sec, false}, job);
    for (std::size_t t = 0; t < scene.frames.size(); ++t) {
      job.check_cancelled();
      job.progress("writing frames", 0.5 + 0.5 * static_cast<double>(t) / static_cast<double>(scene.frames.size()));
      video.write(scene.frames[t]);
    }
    video.finish();
    const Value truth = truth_of(scene);
    object["truth"] = truth;
    write_file(folder.file("background.png"), encode_png(scene.background));
    write_file(folder.file("tracks.csv"), tracks_table(scene));
    Value with_options = truth;
    with_options["options"] = options_value(options);
    write_file(folder.file("truth.json"), to_json(with_options) + "\n");
    folder.commit();
    session.say("wrote " + output);
    session.result(object,
                   std::to_string(scene.frames.size()) + " frames, " +
                       fixed(static_cast<double>(scene.points.size()) / static_cast<double>(scene.frames.size()), 1) +
                       " elements in a frame, seed " + std::to_string(options.seed) + "\n");
  }
};

constexpr const char* kFiles =
    "Writes scene.mkv (every pixel exactly), tracks.csv (track, frame, x, y, scale, angle, amplitude, state; rows "
    "inside "
    "the picture), background.png and truth.json (all that is behind it).";

}  // namespace

Command particles_simulate_snow() {
  return make_command<Simulate<SimulateSnowOptions, simulate_snow>>(
      {"particles simulate snow", "snow whose every flake is known", kFiles,
       "motex particles simulate snow -o snow150\n"
       "motex particles simulate snow -o heavy --elements 1000 --seed 7\n"
       "motex particles simulate snow -o dense --width 256 --height 192 --frames 30 --elements 300"});
}

Command particles_simulate_birds() {
  return make_command<Simulate<SimulateBirdsOptions, simulate_birds>>(
      {"particles simulate birds", "birds whose every stroke of the wings is known",
       std::string(kFiles) + " state: wings 0 up, 1 level, 2 down.",
       "motex particles simulate birds -o birds\n"
       "motex particles simulate birds -o flock --elements 30 --group-size 8 --stay 0.5"});
}

Command particles_simulate_fireworks() {
  return make_command<Simulate<SimulateFireworksOptions, simulate_fireworks>>(
      {"particles simulate fireworks", "fireworks whose every spark is known",
       std::string(kFiles) + " truth.json has place and time of each burst.",
       "motex particles simulate fireworks -o fireworks\n"
       "motex particles simulate fireworks -o feast --bursts 12 --elements 100 --gravity 0.1"});
}

}  // namespace motex::cli
