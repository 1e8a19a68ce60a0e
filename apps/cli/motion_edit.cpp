// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "clip_beside.h"
#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/motion_texture/texton_edit.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"
#include "texton_example.h"

namespace motex::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// "60:lShldr=0,0,40" in its parts.
struct EditText {
  std::string flag, text;
  Index frame = 0;
  std::string target;
  std::vector<double> values;
};

[[noreturn]] void refuse(const std::string& flag, const std::string& text, const std::string& form) {
  throw InvalidInput(flag + ": '" + text + "' is not " + form);
}

Index parse_frame(const std::string& flag, const std::string& text) {
  std::int64_t frame = 0;
  parse_value(flag, text, frame);
  return frame;
}

EditText parse_edit(const std::string& flag, const std::string& text) {
  const std::size_t equals = text.rfind('='), colon = text.find(':');
  if (equals == std::string::npos || colon == std::string::npos || colon > equals)
    refuse(flag, text, "FRAME:JOINT=X,Y,Z");
  EditText edit{flag, text, parse_frame(flag, text.substr(0, colon)), text.substr(colon + 1, equals - colon - 1), {}};
  for (const std::string& word : split_at_commas(text.substr(equals + 1)))
    parse_value(flag, word, edit.values.emplace_back());
  return edit;
}

void need(const EditText& edit, std::size_t count, const std::string& form) {
  if (edit.values.size() != count) refuse(edit.flag, edit.text, form);
}

int find_joint(const Skeleton& skeleton, const EditText& edit) {
  const int joint = skeleton.find(edit.target);
  if (joint >= 0) return joint;
  std::vector<std::string> names{"height", "tilt"};
  for (const Joint& j : skeleton.joints) names.push_back(j.name);
  throw InvalidInput(edit.flag + ": the model has no joint '" + edit.target + "'" + did_you_mean(edit.target, names));
}

/// --set or --turn, for the skeleton that it is meant for.
PoseEdit make_edit(const Skeleton& skeleton, const EditText& edit, bool absolute) {
  PoseEdit out;
  out.frame = edit.frame;
  const bool is_joint = skeleton.find(edit.target) >= 0;
  if (!is_joint && edit.target == "height") {
    if (!absolute) throw InvalidInput("--turn: the height is raised by --raise FRAME=H");
    need(edit, 1, "FRAME:height=H");
    out.kind = EditKind::kSetHeight;
    out.height = edit.values[0];
  } else if (!is_joint && edit.target == "tilt") {
    need(edit, 2, "FRAME:tilt=X,Z");
    out.kind = absolute ? EditKind::kSetTilt : EditKind::kMoveTilt;
    out.tilt_x = edit.values[0] * kDegree, out.tilt_z = edit.values[1] * kDegree;
  } else {
    out.joint = find_joint(skeleton, edit);
    need(edit, 3, "FRAME:JOINT=X,Y,Z");
    const Vector3 angles = kDegree * Vector3(edit.values[0], edit.values[1], edit.values[2]);
    out.kind = absolute ? EditKind::kSetJoint : EditKind::kTurnJoint;
    out.rotation = absolute ? quat_from_euler(euler_order(skeleton.joints[static_cast<std::size_t>(out.joint)]), angles)
                            : exp_map(angles);
  }
  return out;
}

struct Edit {
  std::string model_path;
  std::vector<std::string> outputs, set, turn, raise, pose;
  TextonExample example;
  ReadClipOptions read;
  EditOptions options;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    example.declare(arguments);
    declare_clip_outputs(arguments, outputs).required = true;
    arguments.section("Edits; frames count from the texton's first, each flag may be given again");
    arguments.value("--turn", "FRAME:JOINT=X,Y,Z",
                    "turn the joint by so many degrees about its parent's axes (the axis is X,Y,Z, the angle its "
                    "length); JOINT tilt: X,Z, the lean of the body",
                    turn);
    arguments.value("--set", "FRAME:JOINT=A,B,C",
                    "the joint's angles in degrees, in the order of its channels in the file; JOINT height: H, in the "
                    "file's unit; JOINT tilt: X,Z",
                    set);
    arguments.value("--raise", "FRAME=H", "raise the body by H, in the file's unit", raise);
    arguments.value("--pose", "FRAME=CLIP@K", "the pose of frame K of a file, or of a clip of the model", pose);
    arguments.section("Reading that file");
    arguments.options(read);
    arguments.section("How");
    arguments.options(options);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    example.check();
    const std::vector<EditText> set_edits = parsed("--set", set), turn_edits = parsed("--turn", turn);
    if (set.empty() && turn.empty() && raise.empty() && pose.empty())
      throw InvalidInput("nothing to edit: give --turn, --set, --raise or --pose");
    check_clip_outputs(outputs, adapt, session);
    const MotionTexture model = load_motion_texture(model_path);
    const int instance = example.choose(model);
    std::vector<PoseEdit> edits;
    for (const EditText& edit : set_edits) edits.push_back(make_edit(model.features.skeleton, edit, true));
    for (const EditText& edit : turn_edits) edits.push_back(make_edit(model.features.skeleton, edit, false));
    for (const std::string& text : raise) edits.push_back(raised(text));
    for (const std::string& text : pose) edits.push_back(posed(model, text, session));
    EditReport report;
    const Clip clip = edit_texton(model, instance, edits, options, report, session.job(0.1, 0.9));
    if (session.flags.dry_run) return would_write(outputs, -1, session);
    write_clip_outputs(outputs, clip, example_picture(model, instance, "edited", clip.num_frames()), adapt, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(clip.num_frames()) + " frames, " +
                std::to_string(edits.size()) + (edits.size() == 1 ? " edit" : " edits") + ", seed " +
                std::to_string(options.seed));
    session.result(report_value(model, instance, clip, report, session), table(report));
  }

 private:
  static std::vector<EditText> parsed(const std::string& flag, const std::vector<std::string>& texts) {
    std::vector<EditText> edits;
    for (const std::string& text : texts) edits.push_back(parse_edit(flag, text));
    return edits;
  }

  static PoseEdit raised(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) refuse("--raise", text, "FRAME=H");
    PoseEdit edit;
    edit.kind = EditKind::kMoveHeight;
    edit.frame = parse_frame("--raise", text.substr(0, equals));
    parse_value("--raise", text.substr(equals + 1), edit.height);
    return edit;
  }

  PoseEdit posed(const MotionTexture& model, const std::string& text, Session& session) const {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) refuse("--pose", text, "FRAME=CLIP@K");
    const ClipFrame at = parse_clip_frame("--pose", text.substr(equals + 1));
    PoseEdit edit;
    edit.kind = EditKind::kSetPose;
    edit.frame = parse_frame("--pose", text.substr(0, equals));
    const Clip clip = clip_beside(model, at, Beside::kFrom, read, session);
    if (clip.num_frames() > 1) {
      edit.pose = encode(model.features, slice(clip, 0, 2)).row(0).transpose();
    } else {
      const Clip before = clip_beside(model, at, Beside::kUpTo, read, session);
      edit.pose = encode(model.features, before).bottomRows(1).transpose();
    }
    return edit;
  }

  Value report_value(const MotionTexture& model, int instance, const Clip& clip, const EditReport& report,
                     const Session& session) const {
    Value list = Value::List();
    for (const EditedPart& part : report.parts) {
      Value entry, frames = Value::List();
      for (const Index frame : part.frames) frames.append(std::int64_t{frame});
      entry["part"] = part.name;
      entry["frames"] = std::move(frames);
      entry["size_cm"] = part.size;
      entry["strain"] = part.strain;
      list.append(std::move(entry));
    }
    Value object;
    object["frames"] = std::int64_t{clip.num_frames()};
    object["seed"] = options.seed;
    object["output"] = outputs;
    describe_example(model, instance, object);
    object["parts"] = std::move(list);
    object["options"] = options_value(options);
    object["secs"] = session.secs();
    return object;
  }

  static std::string table(const EditReport& report) {
    std::vector<std::vector<std::string>> rows{{"edited", "at frame", "moved, cm", "against chance"}};
    for (const EditedPart& part : report.parts) {
      std::string frames;
      for (const Index frame : part.frames) frames += (frames.empty() ? "" : ", ") + std::to_string(frame);
      rows.push_back({part.name, frames, fixed(part.size, 1), fixed(part.strain, 1)});
    }
    return text_table(rows);
  }
};

}  // namespace

Command motion_edit() {
  return make_command<Edit>(
      {"motion edit", "change poses inside a texton",
       "The pose asked for is met exactly, the motion leads to it and away from it as the texton's joints move, and "
       "what was not edited stays. The two first and the two last frames cannot be edited.",
       "motex motion edit dance.motex --texton 7 --turn 60:lShldr=0,0,40 -o edited.bvh\n"
       "motex motion edit dance.motex --example salsa_01@100 --set 40:head=0,0,30 --raise 40=-4 -o edited.glb\n"
       "motex motion edit dance.motex --texton 7 --pose 50=other.bvh@120 -o edited.html"});
}

}  // namespace motex::cli
