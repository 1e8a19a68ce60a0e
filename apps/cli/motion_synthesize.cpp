// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "model_sources.h"
#include "motex/motion/crowd.h"
#include "motex/project/dance.h"
#include "motex/project/load_beats.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "skin_argument.h"
#include "text_table.h"
#include "texton_argument.h"

namespace motex::cli {
namespace {

constexpr double kMaxFrames = 2e7;
constexpr double kApartCm = 100;

/// Learns anew where the feet stand, from the model's own examples, with these joints as feet.
void name_feet(MotionTexture& model, const std::vector<std::string>& names, const JobContext& job) {
  std::vector<Clip> examples;
  for (const Run& run : model.runs)
    examples.push_back(decode(model.features, model.corpus.middleRows(run.row, run.length).cast<double>()));
  model.feet = learn_foot_model(examples, names, job);
}

struct Synthesize {
  std::string model_path, path_text, feet_text, texton_text, beats_path, skin_path, loop_step;
  std::vector<std::string> outputs;
  std::int64_t frames = 0;
  double secs = 0;
  bool has_frames = false, has_secs = false;
  bool unconstrained = false, loop = false;
  int dancers = 1;
  double speed = 1;
  SynthesizeOptions options;
  AdaptClipOptions adapt;

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
    arguments.toggle("--loop", "the first frame follows the last", loop);
    arguments.value("--loop-step", "X,Z,HEADING",
                    "where the next round of a loop begins, seen from where this one began, heading in degrees "
                    "(default: in place)",
                    loop_step);
    arguments.value("--dancers", "K",
                    "several, with this seed and the following: OUT-1.bvh …, and one page or .glb of all", dancers);
    arguments.value("--speed", "X", "times as fast as the examples, 0.25 to 4 (default 1)", speed);
    arguments.toggle("--unconstrained", "one texton by its dynamics and noise alone, without end poses (with --texton)",
                     unconstrained);
    arguments.value("--texton", "T", "that one, by number or name", texton_text);
    arguments.section("How");
    arguments.options(options);
    arguments.value("--feet", "NAME,…", "the joints that are feet, one a leg (default: found by the model)", feet_text);
    declare_skin(arguments, skin_path);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    check_request();
    check_outputs(written_paths(), clip_output_extensions(), session);
    check_adapt(adapt, outputs);
    MotionTexture model = load_motion_texture(model_path);
    const Index num_frames = wanted_frames(model.frame_time_secs());
    const std::vector<int> textons = texton_numbers(model, "--path", split_at_commas(path_text));
    const int texton = unconstrained ? texton_number(model, "--texton", texton_text) : -1;
    if (!beats_path.empty()) options.beats = load_beats(beats_path, session.job(0, 0.1));
    put_on_skin(skin_path, model.features.skeleton, session);
    if (session.flags.dry_run) return would_write(written_paths(), num_frames, session);
    if (!feet_text.empty()) name_feet(model, split_at_commas(feet_text), session.job(0, 0.1));
    std::vector<Dance> dances = dance(model, num_frames, textons, texton, session);
    const std::string stem = std::filesystem::path(model_path).stem().string();
    for (Dance& dance : dances) dance.clip.name = stem + "_seed" + std::to_string(dance.seed);
    write(model, dances, session);
    const Clip& clip = dances[0].clip;
    session.say("wrote " + enumerate(written_paths()) + ": " + std::to_string(clip.num_frames()) + " frames, " +
                fixed(static_cast<double>(clip.num_frames()) * clip.frame_time_secs, 1) + " s, " +
                std::to_string(dances[0].report.played.size()) + " textons, seed " + std::to_string(options.seed));
    session.result(report_value(model, dances, session), "");
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
    if (unconstrained && (!beats_path.empty() || loop || dancers != 1 || speed != 1))
      throw InvalidInput("--beats, --loop, --dancers and --speed go with textons in turn, not --unconstrained");
    if (dancers < 1 || dancers > 100) throw InvalidInput("--dancers: 1 to 100");
    if (!(speed >= kSlowestPlay && speed <= kFastestPlay)) throw InvalidInput("--speed: 0.25 to 4");
    if (loop && (!path_text.empty() || !beats_path.empty()))
      throw InvalidInput("--loop finds its own way: it goes without --path and --beats");
    if (!loop && !loop_step.empty()) throw InvalidInput("--loop-step goes with --loop");
    parse_loop_step(1);
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

  std::vector<Dance> dance(const MotionTexture& model, Index num_frames, const std::vector<int>& textons, int texton,
                           Session& session) const {
    if (unconstrained) {
      Dance dance;
      dance.clip = synthesize_unconstrained(model, texton, num_frames, options, dance.report);
      dance.seed = options.seed;
      return {dance};
    }
    DanceRequest request{num_frames, textons, speed, loop, parse_loop_step(model.features.cm_per_unit)};
    if (dancers == 1) return {make_dance(model, request, options, session.job(0, 0.9))};
    return make_dances(model, request, options, dancers, session.job(0, 0.9));
  }

  /// "x,z,heading" in the skeleton's unit and degrees.
  RootStep parse_loop_step(double cm_per_unit) const {
    RootStep step = RootStep::Zero();
    if (loop_step.empty()) return step;
    const std::vector<std::string> words = split_at_commas(loop_step);
    if (words.size() != 3) throw InvalidInput("--loop-step: '" + loop_step + "' is not X,Z,HEADING");
    for (std::size_t i = 0; i < 3; ++i) parse_value("--loop-step", words[i], step[static_cast<Index>(i)]);
    if (!step.allFinite()) throw InvalidInput("--loop-step: '" + loop_step + "' is not finite");
    return {step[0] * cm_per_unit, step[1] * cm_per_unit, step[2] * std::numbers::pi / 180};
  }

  /// Of several dancers: one file for all; of other formats one each.
  static bool holds_all(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".glb" || extension == ".html";
  }
  std::vector<std::string> paths_of_dancer(int k) const {
    std::vector<std::string> paths;
    for (const std::string& path : outputs) {
      const std::filesystem::path whole(path);
      if (!holds_all(path))
        paths.push_back(
            (whole.parent_path() / (whole.stem().string() + "-" + std::to_string(k + 1) + whole.extension().string()))
                .string());
    }
    return paths;
  }
  std::vector<std::string> written_paths() const {
    if (dancers == 1) return outputs;
    std::vector<std::string> paths;
    for (int k = 0; k < dancers; ++k)
      for (std::string& path : paths_of_dancer(k)) paths.push_back(std::move(path));
    for (const std::string& path : outputs)
      if (holds_all(path)) paths.push_back(path);
    return paths;
  }

  void write(const MotionTexture& model, const std::vector<Dance>& dances, Session& session) const {
    if (dances.size() == 1) {
      ClipPicture picture;
      picture.spans = played_spans(model, dances[0].report, dances[0].clip.num_frames());
      return write_clip_outputs(outputs, dances[0].clip, picture, adapt, session);
    }
    std::vector<Clip> clips;
    std::vector<std::string> shared;
    for (std::size_t k = 0; k < dances.size(); ++k) {
      clips.push_back(dances[k].clip);
      write_clip_outputs(paths_of_dancer(static_cast<int>(k)), dances[k].clip, {}, adapt, session);
    }
    for (const std::string& path : outputs)
      if (holds_all(path)) shared.push_back(path);
    if (shared.empty()) return;
    write_clip_outputs(shared, side_by_side(clips, kApartCm / model.features.cm_per_unit), {}, adapt, session);
  }

  Value report_value(const MotionTexture& model, const std::vector<Dance>& dances, const Session& session) const {
    Value object = dance_value(model, dances[0]);
    object["output"] = written_paths();
    object["options"] = options_value(options);
    object["speed"] = speed;
    if (dancers > 1) {
      Value list = Value::List();
      for (const Dance& dance : dances) list.append(dance_value(model, dance));
      object["dancers"] = std::move(list);
    }
    object["secs"] = session.secs();
    return object;
  }

  Value dance_value(const MotionTexture& model, const Dance& dance) const {
    std::vector<int> textons;
    for (const PlayedTexton& played : dance.report.played) textons.push_back(played.texton);
    Value object;
    object["frames"] = std::int64_t{dance.clip.num_frames()};
    object["frame_rate"] = dance.clip.frame_rate();
    object["seed"] = dance.seed;
    object["path"] = textons;
    object["instances"] = played_value(model, dance.report);
    object["longest_copy"] = std::int64_t{dance.report.longest_copy};
    if (!options.beats.empty()) object["beats"] = beats_value(dance.beats);
    if (loop) object["seam_ratio"] = dance.seam_ratio;
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
       "motex motion synthesize dance.motex -o noise.bvh --unconstrained --texton 3 --frames 300\n"
       "motex motion synthesize dance.motex -o music.bvh --secs 60 --beats song.wav\n"
       "motex motion synthesize dance.motex -o idle.glb --loop --frames 300\n"
       "motex motion synthesize dance.motex -o crowd.bvh -o crowd.html --dancers 5 --secs 30"});
}

}  // namespace motex::cli
