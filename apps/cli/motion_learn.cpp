// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <sys/resource.h>

#include <algorithm>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_texture/learn.h"
#include "motex/project/load_clips.h"
#include "motex/project/motion_texture_file.h"
#include "motex/project/sweep.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

double peak_rss_mib() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

Index total_frames(const std::vector<Clip>& clips) {
  Index total = 0;
  for (const Clip& clip : clips) total += clip.num_frames();
  return total;
}

/// "a,b,c" as numbers above 0.
std::vector<double> parse_thresholds(const std::string& text) {
  std::vector<double> thresholds;
  for (const std::string& word : split_at_commas(text)) {
    parse_value("--sweep-thresholds", word, thresholds.emplace_back());
    if (thresholds.back() <= 0) throw InvalidInput("--sweep-thresholds: thresholds are above 0");
  }
  return thresholds;
}

Value report_value(const LearnReport& report) {
  Value object;
  object["frames"] = std::int64_t{report.num_frames};
  object["clips"] = report.num_clips;
  object["textons"] = report.num_textons;
  object["segments"] = report.num_segments;
  object["log_likelihood"] = report.objective;
  object["converged"] = report.converged;
  object["state_size"] = report.state_size;
  object["threshold"] = report.threshold;
  object["glitch_frames"] = std::int64_t{report.num_glitch_frames};
  object["dead_ends"] = report.num_dead_ends;
  object["components"] = report.num_components;
  object["largest_component"] = report.largest_component;
  return object;
}

Value sweep_value(const SweepPoint& point) {
  Value object;
  object["threshold"] = point.threshold;
  object["auto"] = point.is_auto;
  object["textons"] = point.num_textons;
  object["segments"] = point.num_segments;
  object["mean_length_secs"] = point.mean_length_secs;
  object["min_length_secs"] = point.min_length_secs;
  object["max_length_secs"] = point.max_length_secs;
  object["frames"] = std::int64_t{point.num_frames};
  object["parameters"] = point.num_parameters;
  object["training_log_likelihood_per_frame"] = point.training_log_likelihood_per_frame;
  object["held_out_log_likelihood_per_frame"] = point.held_out_log_likelihood_per_frame;
  object["held_out_global_lds_log_likelihood_per_frame"] = point.held_out_global_lds_log_likelihood_per_frame;
  object["bic"] = point.bic;
  object["mdl"] = point.mdl;
  return object;
}

std::string sweep_table(const std::vector<SweepPoint>& points) {
  std::vector<std::vector<std::string>> rows{
      {"threshold", "textons", "segments", "mean s", "min s", "max s", "held out", "global", "BIC", "MDL"}};
  for (const SweepPoint& p : points)
    rows.push_back({fixed(p.threshold, 2), std::to_string(p.num_textons), std::to_string(p.num_segments),
                    fixed(p.mean_length_secs, 2), fixed(p.min_length_secs, 2), fixed(p.max_length_secs, 2),
                    fixed(p.held_out_log_likelihood_per_frame, 2),
                    fixed(p.held_out_global_lds_log_likelihood_per_frame, 2), fixed(p.bic, 0), fixed(p.mdl, 0)});
  return text_table(rows);
}

struct Learn {
  std::vector<std::string> clip_paths;
  std::string output, sweep, sweep_thresholds;
  LearnOptions options;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("CLIP...", "clips of one skeleton, or folders of them", clip_paths);
    arguments.value("-o,--output", "MODEL", "model to write (.motex)", output);
    arguments.section("Learning");
    arguments.options(options);
    arguments.section("Choosing the threshold");
    arguments.value("--sweep", "PICTURE",
                    "learn with several thresholds and plot what comes of it (.png, .svg, .csv); a quarter of the "
                    "clips is held out",
                    sweep);
    arguments.value("--sweep-thresholds", "A,B,…", "those (default: auto and six more)", sweep_thresholds);
    arguments.section("Reading clips");
    arguments.options(read);
  }

  void run(Session& session) {
    const std::vector<double> thresholds = parse_thresholds(sweep_thresholds);
    check_targets(session);
    const std::vector<Clip> clips = load_clips({clip_paths.begin(), clip_paths.end()}, read, session.job(0, 0.05));
    session.say("learning from " + std::to_string(clips.size()) + (clips.size() == 1 ? " clip, " : " clips, ") +
                std::to_string(total_frames(clips)) + " frames at " + fixed(clips[0].frame_rate(), 2) + " Hz, seed " +
                std::to_string(options.seed));
    if (session.flags.dry_run) return report_dry_run(clips, session);
    Value object;
    std::string text;
    const double share_of_sweep = sweep.empty() ? 0 : output.empty() ? 0.95 : 0.8;
    if (!sweep.empty()) run_sweep(clips, thresholds, session, share_of_sweep, object, text);
    if (!output.empty()) run_learn(clips, session, share_of_sweep, object);
    object["seed"] = options.seed;
    object["secs"] = session.secs();
    object["peak_rss_mib"] = peak_rss_mib();
    session.result(object, text);
  }

 private:
  void check_targets(const Session& session) const {
    if (output.empty() && sweep.empty()) throw InvalidInput("-o MODEL missing; see --help");
    if (!output.empty()) check_output(output, {".motex"}, session);
    if (!sweep.empty()) check_output(sweep, {".png", ".svg", ".csv"}, session);
    if (sweep.empty() && !sweep_thresholds.empty()) throw InvalidInput("--sweep-thresholds needs --sweep PICTURE");
  }

  void report_dry_run(const std::vector<Clip>& clips, Session& session) const {
    Value object;
    object["dry_run"] = true;
    object["clips"] = static_cast<int>(clips.size());
    object["frames"] = std::int64_t{total_frames(clips)};
    object["model"] = output;
    session.result(object, "would write " + (output.empty() ? sweep : output) + "\n");
  }

  std::string threshold_unit() const {
    const bool greedy = options.init == Init::kGreedy || (options.init == Init::kAuto && options.basis == Basis::kOwn);
    const bool with_paths = options.basis == Basis::kShared && options.path_weight > 0;
    return greedy ? "cm" : with_paths ? "pieces a texton" : "nats";
  }

  void run_sweep(const std::vector<Clip>& clips, const std::vector<double>& thresholds, Session& session, double share,
                 Value& object, std::string& text) const {
    const auto points = sweep_threshold(split_clips(clips), thresholds, options, session.job(0.05, share));
    if (extension_of(sweep) == ".csv")
      write_file(sweep, sweep_csv(points));
    else
      write_picture(sweep, draw_sweep(points, threshold_unit()));
    session.say("wrote " + sweep);
    for (const SweepPoint& point : points) object["sweep"].append(sweep_value(point));
    text += sweep_table(points);
  }

  void run_learn(const std::vector<Clip>& clips, Session& session, double from, Value& object) const {
    LearnReport report;
    const JobContext job = session.job(std::max(from, 0.05), 0.99);
    const MotionTexture model = learn_motion_texture(clips, options, report, job);
    job.check_cancelled();
    save_motion_texture(output, model);
    const Value learned = report_value(report);
    for (const auto& [name, value] : std::get<Value::Members>(learned.data())) object[name] = value;
    object["model"] = output;
    object["options"] = options_value(options);
    session.say("wrote " + output + ": " + std::to_string(report.num_textons) + " textons in " +
                std::to_string(report.num_segments) + " segments, " + fixed(session.secs(), 1) + " s");
    session.say("next: motex motion synthesize " + output + " -o new.bvh --secs 60");
  }
};

}  // namespace

Command motion_learn() {
  return make_command<Learn>({"motion learn", "learn textons and their transitions from clips",
                              "Reads BVH, glTF/GLB and ASF/AMC clips of one skeleton. A minute of motion or more is "
                              "wanted; clips shorter than a "
                              "segment cannot be used.",
                              "motex motion learn dance1.bvh dance2.bvh -o dance.motex\n"
                              "motex motion learn clips/ -o paper.motex --basis own --seed 7\n"
                              "motex motion learn clips/ --sweep thresholds.png --json"});
}

}  // namespace motex::cli
