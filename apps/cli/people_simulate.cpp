// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/image/png.h"
#include "motex/project/simulate_actor.h"
#include "motex/video_io/video_writer.h"
#include "options_value.h"
#include "output_folder.h"
#include "particles_model.h"
#include "text_table.h"

namespace motex::cli {
namespace {

constexpr int kBlock = 16;  // frames drawn together

std::string actions_table(const ActorSimulation& scene) {
  std::string text = "start,length,action,person\n";
  for (const ActorPerformance& one : scene.performances())
    text += std::to_string(one.start) + "," + std::to_string(one.length) + "," +
            actor_actions()[static_cast<std::size_t>(one.action)] + "," + std::to_string(one.person) + "\n";
  return text;
}

Value truth_of(const ActorSimulation& scene) {
  Value truth;
  truth["options"] = options_value(scene.options());
  truth["performances"] = Value::List();
  for (const ActorPerformance& one : scene.performances()) {
    Value entry;
    entry["start"] = one.start;
    entry["length"] = one.length;
    entry["action"] = actor_actions()[static_cast<std::size_t>(one.action)];
    entry["person"] = one.person;
    entry["amplitude"] = one.amplitude;
    truth["performances"].append(std::move(entry));
  }
  return truth;
}

struct Simulate {
  std::string output, size;
  SimulateActorOptions options;
  bool lossless = false;

  void declare(Arguments& arguments) {
    arguments.value("-o,--output", "DIR", "folder for the scene", output).required = true;
    arguments.value("--size", "WxH", "width and height of the picture in one", size);
    arguments.toggle("--lossless", "scene.mkv with every pixel exactly in place of scene.mp4", lossless);
    arguments.section("Scene");
    arguments.options(options);
  }

  void run(Session& session) {
    if (!size.empty()) std::tie(options.width, options.height) = parse_picture_size(size);
    check_options(options);
    check_output_folder(output, session);
    const ActorSimulation scene(options);
    Value object;
    object["output"] = output;
    object["seed"] = options.seed;
    object["options"] = options_value(options);
    object["performances"] = static_cast<std::int64_t>(scene.performances().size());
    if (session.flags.dry_run) {
      session.result(object, "");
      return;
    }
    OutputFolder folder(output);
    write_videos(scene, folder, session.job());
    write_file(folder.file("screen.png"), encode_png(scene.screen()));
    write_file(folder.file("actions.csv"), actions_table(scene));
    write_file(folder.file("truth.json"), to_json(truth_of(scene)) + "\n");
    folder.commit();
    session.say("wrote " + output);
    session.result(object, text(scene));
  }

 private:
  void write_videos(const ActorSimulation& scene, const OutputFolder& folder, const JobContext& job) const {
    VideoWriter film(folder.file(lossless ? "scene.mkv" : "scene.mp4"), options.width, options.height,
                     {options.frames_per_sec, false}, job);
    VideoWriter matte(folder.file("matte.mkv"), options.width, options.height, {options.frames_per_sec, false}, job);
    std::vector<ActorSimulation::Frame> frames(kBlock);
    for (int first = 0; first < options.frames; first += kBlock) {
      job.check_cancelled();
      job.progress("drawing frames", static_cast<double>(first) / options.frames);
      const int count = std::min(kBlock, options.frames - first);
      parallel_for(job.jobs, count, [&](int k) { frames[static_cast<std::size_t>(k)] = scene.frame(first + k); });
      for (int k = 0; k < count; ++k) {
        film.write(frames[static_cast<std::size_t>(k)].image);
        matte.write(frames[static_cast<std::size_t>(k)].matte);
      }
    }
    film.finish();
    matte.finish();
  }

  std::string text(const ActorSimulation& scene) const {
    std::map<std::string, int> counts;
    for (const ActorPerformance& one : scene.performances())
      ++counts[actor_actions()[static_cast<std::size_t>(one.action)]];
    std::vector<std::vector<std::string>> rows{{"action", "performed"}};
    for (const auto& [name, count] : counts) rows.push_back({name, std::to_string(count)});
    return std::to_string(options.frames) + " frames, seed " + std::to_string(options.seed) + "\n" + text_table(rows);
  }
};

}  // namespace

Command people_simulate() {
  return make_command<Simulate>(
      {"people simulate", "film of an actor before a screen, every matte, action and repetition known",
       "A puppet that motion capture moves. Writes scene.mp4 (as a camera would: H.264 with 4:2:0 colour; with "
       "--lossless scene.mkv), matte.mkv (grey, the true alpha), screen.png (the empty screen), actions.csv (start, "
       "length, action, person; frames from 0) and truth.json.",
       "motex people simulate -o puppet\n"
       "motex people simulate -o kicks --actions left_kick,right_kick --repetitions 6 --frames 900 --screen blue\n"
       "motex people simulate -o three --persons 3 --size 1280x720 --lossless --seed 7"});
}

}  // namespace motex::cli
