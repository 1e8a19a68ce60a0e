// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/motion_texture/texton_stretch.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"
#include "texton_example.h"

namespace motex::cli {
namespace {

struct Stretch {
  std::string model_path;
  std::vector<std::string> outputs;
  TextonExample example;
  std::int64_t frames = 0;
  StretchOptions options;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    example.declare(arguments);
    arguments.value("--frames", "N", "length in frames", frames).required = true;
    declare_clip_outputs(arguments, outputs).required = true;
    arguments.section("How");
    arguments.options(options);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    example.check();
    check_clip_outputs(outputs, adapt, session);
    const MotionTexture model = load_motion_texture(model_path);
    const int instance = example.choose(model);
    if (session.flags.dry_run) return would_write(outputs, frames, session);
    StretchReport report;
    const Clip clip = stretch_texton(model, instance, frames, options, report, session.job(0, 0.9));
    ClipPicture picture;
    picture.title = described(source_of(model, instance)) + " in " + std::to_string(frames) + " frames";
    picture.spans = spans_of(model, report);
    write_clip_outputs(outputs, clip, picture, adapt, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(report.source_length) + " frames in " +
                std::to_string(frames) + ", at " + fixed(report.speed_ratio, 3) + " of the speed, seed " +
                std::to_string(options.seed));
    session.result(report_value(model, instance, report, session), table(model, report));
  }

 private:
  static InstanceSource source_of_visit(const MotionTexture& model, const PlayedVisit& visit) {
    InstanceSource source = source_of(model, visit.instance);
    source.start += visit.source_start;
    source.length = visit.source_length;
    return source;
  }

  static std::vector<TextonSpan> spans_of(const MotionTexture& model, const StretchReport& report) {
    std::vector<TextonSpan> spans;
    for (std::size_t k = 0; k < report.visits.size(); ++k) {
      const PlayedVisit& visit = report.visits[k];
      const Index shared = k + 1 < report.visits.size() ? 2 : 0;
      spans.push_back(
          {static_cast<int>(k), visit.start, visit.length - shared, described(source_of_visit(model, visit))});
    }
    return spans;
  }

  Value report_value(const MotionTexture& model, int instance, const StretchReport& report,
                     const Session& session) const {
    Value list = Value::List();
    for (const PlayedVisit& visit : report.visits) {
      const InstanceSource source = source_of_visit(model, visit);
      Value entry;
      entry["output_start"] = std::int64_t{visit.start};
      entry["length"] = std::int64_t{visit.length};
      entry["clip"] = source.clip;
      entry["start"] = std::int64_t{source.start};
      entry["source_length"] = std::int64_t{source.length};
      list.append(std::move(entry));
    }
    Value object;
    object["frames"] = frames;
    object["seed"] = options.seed;
    object["output"] = outputs;
    describe_example(model, instance, object);
    object["speed_ratio"] = report.speed_ratio;
    object["gain"] = report.gain;
    object["largest_cut_cm"] = report.largest_cut;
    object["visits"] = std::move(list);
    object["options"] = options_value(options);
    object["secs"] = session.secs();
    return object;
  }

  static std::string table(const MotionTexture& model, const StretchReport& report) {
    std::vector<std::vector<std::string>> rows{{"frames", "played from"}};
    for (const PlayedVisit& visit : report.visits)
      rows.push_back({std::to_string(visit.start) + "–" + std::to_string(visit.start + visit.length - 1),
                      described(source_of_visit(model, visit))});
    return text_table(rows);
  }
};

}  // namespace

Command motion_stretch() {
  return make_command<Stretch>(
      {"motion stretch", "one texton in more, or fewer, frames",
       "The texton moves as fast as its example: in more frames it does more, visiting some of its frames again, and "
       "in "
       "fewer it leaves some out. First and last poses stay. --method warp slows it down or speeds it up instead.",
       "motex motion stretch dance.motex --texton 7 --frames 188 -o longer.bvh\n"
       "motex motion stretch dance.motex --example salsa_01@100 --frames 60 -o shorter.glb"});
}

}  // namespace motex::cli
