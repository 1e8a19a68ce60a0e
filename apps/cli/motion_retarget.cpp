// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/core/files.h"
#include "motex/motion/retarget.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/joint_map_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

/// "rest" or a frame.
struct PostureName {
  std::string text = "rest";

  void declare(Arguments& arguments, const std::string& flag, const std::string& whose) {
    arguments
        .value(flag, "FRAME",
               "frame of " + whose + " that shows the common posture (default: rest; with a skin, as it was bound)",
               text)
        .set = [this, flag](const std::string& value) {
      std::int64_t frame = 0;
      if (value != "rest") parse_value(flag, value, frame);
      text = value;
    };
  }
  PosedSkeleton of(const Clip& clip) const {
    return text == "rest" ? as_bound(clip.skeleton) : at_frame(clip, std::stol(text));
  }
};

struct Retarget {
  std::string clip_path, body_path, map_path, write_map_path;
  std::vector<std::string> outputs;
  PostureName source_pose, target_pose;
  RetargetOptions options;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("CLIP", "motion to move to another body", clip_path);
    declare_clip_outputs(arguments, outputs);
    arguments.value("--to", "FILE", "clip whose skeleton is the new body", body_path).required = true;
    arguments.section("Which joint is which");
    arguments.value("--map", "FILE", "pairs of joints: .csv with target,source lines, or .json", map_path);
    arguments.value("--write-map", "FILE", "write the pairs that were found, to start a map from", write_map_path);
    arguments.section("How");
    arguments.options(options);
    source_pose.declare(arguments, "--source-pose", "CLIP");
    target_pose.declare(arguments, "--target-pose", "--to");
    arguments.section("Reading the clip");
    arguments.options(read);
  }

  void run(Session& session) {
    if (outputs.empty() && write_map_path.empty() && !session.flags.dry_run)
      throw InvalidInput("-o OUT, --write-map FILE or --dry-run missing; see --help");
    check_outputs(outputs, clip_output_extensions(), session);
    if (!write_map_path.empty()) check_output(write_map_path, {".csv", ".json"}, session);
    const Clip source = read_clip(clip_path, read, session.job(0, 0.3));
    const Clip body = read_clip(body_path, {}, session.job(0.3, 0.4));
    const JointMap map = map_path.empty()
                             ? match_joints(source.skeleton, body.skeleton)
                             : joint_map_by_names(source.skeleton, body.skeleton, read_joint_map(map_path));
    RetargetReport report;
    const Clip out = retarget(source, source_pose.of(source).pose, target_pose.of(body), map, options, report,
                              session.job(0.4, 0.9));
    if (!session.flags.dry_run) write(source, body, map, out, session);
    session.result(result(source, body, map, report, out),
                   session.flags.dry_run ? map_table(source, body, map) : summary(report));
  }

 private:
  void write(const Clip& source, const Clip& body, const JointMap& map, const Clip& out, Session& session) const {
    if (!write_map_path.empty())
      write_file(write_map_path, joint_map_text(source.skeleton, body.skeleton, map, write_map_path));
    for (const std::string& path : outputs) write_clip_output(path, out, {}, session);
    std::vector<std::string> written = outputs;
    if (!write_map_path.empty()) written.push_back(write_map_path);
    session.say("wrote " + enumerate(written) + ": " + std::to_string(map.num_matched()) + " of " +
                std::to_string(body.skeleton.num_joints()) + " joints have a source");
  }

  static std::string map_table(const Clip& source, const Clip& body, const JointMap& map) {
    std::vector<std::vector<std::string>> rows{{"target", "source"}};
    for (std::size_t j = 0; j < map.source_of.size(); ++j) {
      const int s = map.source_of[j];
      rows.push_back(
          {body.skeleton.joints[j].name, s < 0 ? "–" : source.skeleton.joints[static_cast<std::size_t>(s)].name});
    }
    return text_table(rows);
  }

  static std::string summary(const RetargetReport& report) {
    std::string text;
    if (!report.unmatched.empty()) text += "kept at rest: " + enumerate(report.unmatched) + "\n";
    if (!report.unused.empty()) text += "not used: " + enumerate(report.unused) + "\n";
    return text;
  }

  Value result(const Clip& source, const Clip& body, const JointMap& map, const RetargetReport& report,
               const Clip& out) const {
    Value object, pairs = Value(Value::Members{});
    for (std::size_t j = 0; j < map.source_of.size(); ++j)
      if (const int s = map.source_of[j]; s >= 0)
        pairs[body.skeleton.joints[j].name] = source.skeleton.joints[static_cast<std::size_t>(s)].name;
    object["frames"] = std::int64_t{out.num_frames()};
    object["frame_rate"] = out.frame_rate();
    object["map"] = pairs;
    object["unmatched"] = report.unmatched;
    object["unused"] = report.unused;
    object["scale"] = report.scale;
    object["height_shift"] = report.height_shift;
    object["num_limbs"] = report.num_limbs;
    object["mean_direction_error_degrees"] = report.mean_direction_error;
    object["max_direction_error_degrees"] = report.max_direction_error;
    object["source_contact_speed"] = report.source_contact_speed;
    object["contact_speed_before"] = report.contact_speed_before;
    object["contact_speed_after"] = report.contact_speed_after;
    object["output"] = outputs;
    object["options"] = options_value(options);
    return object;
  }
};

}  // namespace

Command motion_retarget() {
  return make_command<Retarget>(
      {"motion retarget", "a motion on another body",
       "Joints are matched by what they are in the usual rigs (CMU, Acclaim, Mixamo, Daz, Biped, Unreal, VRM), or by a "
       "map. World directions of the bones are kept; joints without a source stay at rest; planted feet are held. "
       "--dry-run lists the pairs.",
       "motex motion retarget salsa.bvh -o hero_salsa.bvh --to hero.bvh\n"
       "motex motion retarget salsa.bvh --to hero.glb --write-map map.csv\n"
       "motex motion retarget salsa.bvh -o hero_salsa.glb --to hero.glb --map map.csv --target-pose 0"});
}

}  // namespace motex::cli
