// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "model_sources.h"
#include "motex/motion_texture/beats.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/project/load_beats.h"
#include "motex/project/model_file.h"
#include "options_value.h"
#include "output_file.h"
#include "skin_argument.h"
#include "text_table.h"
#include "texton_argument.h"

namespace motex::cli {
namespace {

constexpr double kMaxFrames = 2e7;

/// Learns anew where the feet stand, from the model's own examples, with these joints as feet.
void name_feet(MotionTexture& model, const std::vector<std::string>& names, const JobContext& job) {
  std::vector<Clip> examples;
  for (const Run& run : model.runs)
    examples.push_back(decode(model.features, model.corpus.middleRows(run.row, run.length).cast<double>()));
  model.feet = learn_foot_model(examples, names, job);
}

struct Synthesize {
  std::string model_path, path_text, feet_text, texton_text, beats_path, skin_path;
  std::vector<std::string> outputs;
  std::int64_t frames = 0;
  double secs = 0;
  bool has_frames = false, has_secs = false;
  bool unconstrained = false;
  SynthesizeOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments
        .value("-o,--output", "OUT",
               "motion to write: .bvh, .glb, .csv, .npz, a page that plays it (.html), a strip of poses (.png, .svg); "
               "may be given several times",
               outputs)
        .required = true;
    declare_length(arguments);
    arguments.value("--path", "T,T,…",
                    "textons to play, numbers or names, in this order; with --frames or --secs it goes on from there",
                    path_text);
    arguments.value("--beats", "FILE",
                    "textons begin on these beats: a time in seconds a line, or music to be listened to (.wav)",
                    beats_path);
    arguments.toggle("--unconstrained", "one texton by its dynamics and noise alone, without end poses (with --texton)",
                     unconstrained);
    arguments.value("--texton", "T", "that one, by number or name", texton_text);
    arguments.section("How");
    arguments.options(options);
    arguments.value("--feet", "NAME,…", "the joints that are feet, one a leg (default: found by the model)", feet_text);
    declare_skin(arguments, skin_path);
  }

  void run(Session& session) {
    check_request();
    check_outputs(outputs, clip_output_extensions(), session);
    MotionTexture model = load_model(model_path);
    const Index num_frames = wanted_frames(model.frame_time_secs());
    const std::vector<int> textons = texton_numbers(model, "--path", split_at_commas(path_text));
    const int texton = unconstrained ? texton_number(model, "--texton", texton_text) : -1;
    if (!beats_path.empty()) options.beats = load_beats(beats_path, session.job(0, 0.1));
    put_on_skin(skin_path, model.features.skeleton, session);
    if (session.flags.dry_run) return report_dry_run(num_frames, session);
    if (!feet_text.empty()) name_feet(model, split_at_commas(feet_text), session.job(0, 0.1));
    SynthesizeReport report;
    Clip clip = unconstrained ? synthesize_unconstrained(model, texton, num_frames, options, report)
                              : synthesize_motion(model, num_frames, textons, options, report, session.job(0, 0.9));
    clip.name = std::filesystem::path(model_path).stem().string() + "_seed" + std::to_string(options.seed);
    ClipPicture picture;
    picture.spans = played_spans(model, report, clip.num_frames());
    for (const std::string& path : outputs) write_clip_output(path, clip, picture, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(clip.num_frames()) + " frames, " +
                fixed(static_cast<double>(clip.num_frames()) * clip.frame_time_secs, 1) + " s, " +
                std::to_string(report.played.size()) + " textons, seed " + std::to_string(options.seed));
    Value object = report_value(model, clip, report, session);
    if (!options.beats.empty()) object["beats"] = beats_value(report_beats(model, report.played, options.beats));
    session.result(object, "");
  }

 private:
  void declare_length(Arguments& arguments) {
    arguments.value("--frames", "N", "length in frames", frames).set = [this](const std::string& text) {
      parse_value("--frames", text, frames);
      if (frames < 1 || static_cast<double>(frames) > kMaxFrames)
        throw InvalidInput("--frames: " + text + " is outside 1 … 2e7");
      has_frames = true;
    };
    arguments.value("--secs", "S", "length in seconds", secs).set = [this](const std::string& text) {
      parse_value("--secs", text, secs);
      if (!(secs > 0 && secs < 1e7)) throw InvalidInput("--secs: " + text + " is outside 0 … 1e7");
      has_secs = true;
    };
  }

  void check_request() const {
    if (has_frames && has_secs) throw InvalidInput("--frames and --secs say the same thing twice; name one");
    const bool has_length = has_frames || has_secs;
    if (!has_length && path_text.empty()) throw InvalidInput("--frames N, --secs S or --path missing; see --help");
    if (unconstrained && (texton_text.empty() || !has_length || !path_text.empty()))
      throw InvalidInput("--unconstrained goes with --texton T and --frames N or --secs S, without --path");
    if (unconstrained && !beats_path.empty())
      throw InvalidInput("--beats goes with textons in turn, not --unconstrained");
    if (!unconstrained && !texton_text.empty())
      throw InvalidInput("--texton goes with --unconstrained; for a path use --path");
  }

  Index wanted_frames(double frame_time_secs) const {
    if (has_frames) return frames;
    if (!has_secs) return 0;
    const double wanted = std::round(secs / frame_time_secs);
    if (wanted > kMaxFrames) throw InvalidInput("--secs: more than 2e7 frames");
    return std::max<Index>(1, static_cast<Index>(wanted));
  }

  static Value beats_value(const BeatReport& report) {
    Value object;
    object["textons_begun"] = report.num_boundaries;
    object["median_offset_frames"] = report.median_offset;
    object["largest_offset_frames"] = report.largest_offset;
    object["share_on_beat"] = report.share_on_beat;
    object["median_stretch"] = report.median_stretch;
    return object;
  }

  void report_dry_run(Index num_frames, Session& session) const {
    Value object;
    object["dry_run"] = true;
    object["frames"] = std::int64_t{num_frames};
    object["output"] = outputs;
    std::string text;
    for (const std::string& path : outputs) text += "would write " + path + "\n";
    session.result(object, text);
  }

  Value report_value(const MotionTexture& model, const Clip& clip, const SynthesizeReport& report,
                     const Session& session) const {
    std::vector<int> textons;
    for (const PlayedTexton& played : report.played) textons.push_back(played.texton);
    Value object;
    object["frames"] = std::int64_t{clip.num_frames()};
    object["frame_rate"] = clip.frame_rate();
    object["seed"] = options.seed;
    object["output"] = outputs;
    object["path"] = textons;
    object["instances"] = played_value(model, report);
    object["longest_copy"] = std::int64_t{report.longest_copy};
    object["options"] = options_value(options);
    object["secs"] = session.secs();
    return object;
  }
};

}  // namespace

Command motion_synthesize() {
  return make_command<Synthesize>(
      {"motion synthesize", "make new motion from a model",
       "Without --path the textons are chosen at random, as they follow one another in the examples. The same seed "
       "gives the same bytes.",
       "motex motion synthesize dance.motex -o new.bvh --secs 60\n"
       "motex motion synthesize dance.motex -o new.glb -o new.html --frames 3600 --seed 7\n"
       "motex motion synthesize dance.motex -o path.bvh --path 3,17,17,5\n"
       "motex motion synthesize dance.motex -o noise.bvh --unconstrained --texton 3 --frames 300"});
}

}  // namespace motex::cli
