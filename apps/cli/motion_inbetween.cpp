// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "clip_beside.h"
#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/motion_texture/inbetween.h"
#include "motex/motion_texture/placing.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Inbetween {
  std::string model_path, from, to;
  std::vector<std::string> outputs;
  std::int64_t frames = 0;
  bool join = false;
  InbetweenOptions options;
  ReadClipOptions read;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.value("--from", "CLIP@FRAME", "the last frame before the gap; CLIP: a file, or a clip of the model", from)
        .required = true;
    arguments.value("--to", "CLIP@FRAME", "the first frame after the gap", to).required = true;
    arguments.value("--frames", "GAP", "frames between these two, at the model's frame rate", frames).required = true;
    arguments
        .value("-o,--output", "OUT", "motion, page or picture of the frames in the gap; may be given several times",
               outputs)
        .required = true;
    arguments.toggle("--join", "write what comes before and after too: FROM's clip, the gap, TO's clip", join);
    arguments.section("How");
    arguments.options(options);
    arguments.section("Reading clips");
    arguments.options(read);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    const ClipFrame first = parse_clip_frame("--from", from), last = parse_clip_frame("--to", to);
    if (frames < 1 || frames > 1'000'000) throw InvalidInput("--frames: a gap has 1 to 1000000 frames");
    check_clip_outputs(outputs, adapt, session);
    const MotionTexture model = load_motion_texture(model_path);
    const Clip before = clip_beside(model, first, Beside::kUpTo, read, session);
    const Clip after = clip_beside(model, last, Beside::kFrom, read, session);
    InbetweenReport report;
    Clip clip = inbetween(model, before, after, frames, options, report, session.job(0.1, 0.9));
    const Index gap_start = join ? before.num_frames() : 0;
    if (join) clip = joined(model, before, clip, after, report);
    clip.name = "in-between";
    if (session.flags.dry_run) return would_write(outputs, clip.num_frames(), session);
    ClipPicture picture;
    picture.title = from + " → " + to;
    write_clip_outputs(outputs, clip, picture, adapt, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(clip.num_frames()) + " frames" +
                (join ? ", the gap from frame " + std::to_string(gap_start) + " on" : ""));
    session.result(report_value(clip, gap_start, report, session), table(report));
  }

 private:
  /// The clip after the gap stands where the report says.
  static Clip joined(const MotionTexture& model, const Clip& before, const Clip& gap, const Clip& after,
                     const InbetweenReport& report) {
    Clip out = make_held_clip(model.features, before.num_frames() + gap.num_frames() + after.num_frames());
    const Clip placed = stand_at(model.features, after, report.end);
    Index at = 0;
    for (const Clip* part : {&before, &gap, &placed}) {
      out.translations.middleRows(at, part->num_frames()) = part->translations;
      out.rotations.middleRows(at, part->num_frames()) = part->rotations;
      at += part->num_frames();
    }
    return out;
  }

  Value report_value(const Clip& clip, Index gap_start, const InbetweenReport& report, const Session& session) const {
    Value followed = Value::List();
    for (const FollowedExample& example : report.followed) {
      Value entry;
      entry["clip"] = example.clip;
      entry["start"] = std::int64_t{example.start};
      entry["length"] = std::int64_t{example.length};
      entry["texton"] = example.texton;
      followed.append(std::move(entry));
    }
    Value end;
    end["x"] = report.end.x;
    end["z"] = report.end.z;
    end["heading"] = report.end.heading;
    Value object;
    object["frames"] = std::int64_t{clip.num_frames()};
    object["frame_rate"] = clip.frame_rate();
    object["gap_start"] = std::int64_t{gap_start};
    object["gap_frames"] = frames;
    object["output"] = outputs;
    object["followed"] = std::move(followed);
    object["distance_cm"] = report.distance;
    object["end_place"] = std::move(end);
    object["options"] = options_value(options);
    object["secs"] = session.secs();
    return object;
  }

  static std::string table(const InbetweenReport& report) {
    std::vector<std::vector<std::string>> rows{{"followed", "frames", "texton"}};
    for (const FollowedExample& example : report.followed)
      rows.push_back({example.clip,
                      std::to_string(example.start) + "–" + std::to_string(example.start + example.length - 1),
                      std::to_string(example.texton)});
    return text_table(rows) + "the nearest is " + fixed(report.distance, 1) + " cm away (root mean square)\n";
  }
};

}  // namespace

Command motion_inbetween() {
  return make_command<Inbetween>(
      {"motion inbetween", "fill the gap between two clips or poses",
       "The frames lead from one clip into the other without a jump of pose or speed, and end where the other one "
       "stands. Neither clip need be in the model; both have its skeleton.",
       "motex motion inbetween dance.motex --from take1.bvh@200 --to take1.bvh@231 --frames 30 -o gap.bvh\n"
       "motex motion inbetween dance.motex --from a.bvh@90 --to b.bvh@10 --frames 45 --no-place-end --join -o "
       "both.glb"});
}

}  // namespace motex::cli
