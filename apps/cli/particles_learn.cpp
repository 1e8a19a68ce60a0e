// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "commands.h"
#include "motex/particles/learn.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/textured_motion_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

Value report_value(const LearnTexturedMotionReport& report) {
  Value object;
  object["background_psnr"] = report.background_psnr;
  object["rounds"] = Value::List();
  for (const LearnRound& round : report.rounds) {
    Value one;
    one["psnr"] = round.psnr;
    one["noise"] = round.noise;
    one["log_posterior"] = round.log_posterior;
    one["cables"] = round.num_cables;
    object["rounds"].append(std::move(one));
  }
  object["moves"] = Value::List();
  for (const MoveCount& move : report.moves) {
    Value one;
    one["move"] = move.name;
    one["proposed"] = move.proposed;
    one["accepted"] = move.accepted;
    object["moves"].append(std::move(one));
  }
  object["log_posterior_trace"] = Value::List();
  for (const double value : report.log_posterior_trace) object["log_posterior_trace"].append(value);
  object["bases_per_frame"] = report.bases_per_frame;
  object["expected_wrong_links"] = report.expected_wrong_links;
  return object;
}

std::string moves_table(const std::vector<MoveCount>& moves) {
  std::vector<std::vector<std::string>> rows{{"move", "proposed", "accepted", "%"}};
  for (const MoveCount& move : moves)
    rows.push_back(
        {move.name, std::to_string(move.proposed), std::to_string(move.accepted),
         fixed(100 * static_cast<double>(move.accepted) / static_cast<double>(std::max<std::int64_t>(1, move.proposed)),
               1)});
  return moves.empty() ? "" : "\n" + text_table(rows);
}

struct Learn {
  std::string video, output;
  LearnTexturedMotionOptions options;
  LoadVideoClipOptions load;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO", "video file, folder of pictures, pattern (f_%04d.png) or TIFF stack", video);
    arguments.value("-o,--output", "MODEL", "model to write (.motex)", output).required = true;
    arguments.section("Learning");
    arguments.options(options);
    arguments.section("Reading the clip");
    arguments.options(load);
  }

  void run(Session& session) {
    check_output(output, {".motex"}, session);
    const ClipFrames clip = load_video_clip(video, load, session.job(0, 0.05));
    session.say("learning from " + std::to_string(clip.num_frames()) + " frames of " + std::to_string(clip.width) +
                " × " + std::to_string(clip.height) + ", seed " + std::to_string(options.seed));
    if (session.flags.dry_run) return would_write({output}, -1, session);
    LearnedTexturedMotion learned = learn_textured_motion(clip, options, session.job(0.05, 0.99));
    learned.model.source = video;
    session.job().check_cancelled();
    save_textured_motion(output, learned.model);
    const bool is_water = learned.model.water.has_value();
    session.say("wrote " + output + ": " + std::to_string(learned.model.cables.size()) +
                (is_water ? " bases carried" : " elements followed") + ", " + fixed(session.secs(), 1) + " s");
    if (is_water && options.tracking == TrackingKind::kAuto)
      session.say(
          "learned as water, since its light goes up and down all the time; --tracking cores follows elements that can "
          "be told apart");
    session.say("next: motex particles synthesize " + output + " -o new.mp4 --frames 300");
    session.result(value(clip, learned), text(learned));
  }

 private:
  Value value(const ClipFrames& clip, const LearnedTexturedMotion& learned) const {
    Value object;
    object["model"] = output;
    object["video"] = video;
    object["frames"] = clip.num_frames();
    object["water"] = learned.model.water.has_value();
    object["cables"] = static_cast<std::int64_t>(learned.model.cables.size());
    object["templates"] = static_cast<std::int64_t>(learned.model.templates.size());
    object["learning"] = report_value(learned.report);
    object["options"] = options_value(options);
    object["seed"] = options.seed;
    object["secs"] = Session::secs();
    return object;
  }

  static std::string text(const LearnedTexturedMotion& learned) {
    const bool is_water = learned.model.water.has_value();
    std::vector<std::vector<std::string>> rows{{"round", "PSNR dB", "noise", is_water ? "bases" : "elements"},
                                               {"background", fixed(learned.report.background_psnr, 2), "", ""}};
    for (std::size_t k = 0; k < learned.report.rounds.size(); ++k) {
      const LearnRound& round = learned.report.rounds[k];
      const char* first = is_water ? "carried" : "linked";
      rows.push_back({k == 0 ? first : "sampled " + std::to_string(k), fixed(round.psnr, 2), fixed(round.noise, 2),
                      std::to_string(round.num_cables)});
    }
    if (is_water) return text_table(rows);
    return text_table(rows) + "\nlinks expected wrong  " + fixed(100 * learned.report.expected_wrong_links, 2) +
           " %\n" + moves_table(learned.report.moves);
  }
};

}  // namespace

Command particles_learn() {
  return make_command<Learn>(
      {"particles learn", "learn the moving elements of a video: how they look, move, are born and die",
       "For clips of many small moving things before a still background: snow, birds, sparks, falling water. A few "
       "seconds of video are enough; the camera should stand still.",
       "motex particles learn snow.mp4 -o snow.motex\n"
       "motex particles learn birds.mov -o birds.motex --first-frame 100 --num-frames 150\n"
       "motex particles learn f_%04d.png -o sparks.motex --background low --json"});
}

}  // namespace motex::cli
