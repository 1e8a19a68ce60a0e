// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <set>

#include "clip_info.h"
#include "commands.h"
#include "motex/project/motion_texture_file.h"
#include "motex/project/texton_audit.h"
#include "motion_texton.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

/// What one texton's instances say.
struct TextonSummary {
  Index num_frames = 0, shortest = 0, longest = 0;
  int num_instances = 0, num_successors = 0;
};

std::vector<TextonSummary> summarise(const MotionTexture& model) {
  std::vector<TextonSummary> summaries(model.textons.size());
  for (const Instance& instance : model.instances) {
    TextonSummary& summary = summaries.at(static_cast<std::size_t>(instance.texton));
    summary.shortest = summary.num_instances == 0 ? instance.length : std::min(summary.shortest, instance.length);
    summary.longest = std::max(summary.longest, instance.length);
    summary.num_frames += instance.length;
    ++summary.num_instances;
  }
  for (const TransitionCount& transition : model.transitions.counts())
    ++summaries.at(static_cast<std::size_t>(transition.from)).num_successors;
  return summaries;
}

double mean_length_secs(const TextonSummary& summary, const MotionTexture& model) {
  return static_cast<double>(summary.num_frames) * model.frame_time_secs() / std::max(summary.num_instances, 1);
}

Value textons_value(const MotionTexture& model, const std::vector<TextonSummary>& summaries) {
  Value list = Value::List();
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    Value entry;
    entry["texton"] = static_cast<int>(i);
    entry["name"] = model.textons[i].name;
    entry["instances"] = summaries[i].num_instances;
    entry["frames"] = std::int64_t{summaries[i].num_frames};
    entry["mean_length_secs"] = mean_length_secs(summaries[i], model);
    entry["successors"] = summaries[i].num_successors;
    list.append(std::move(entry));
  }
  return list;
}

Value clips_value(const MotionTexture& model) {
  Value list = Value::List();
  for (std::size_t i = 0; i < model.clip_names.size(); ++i) {
    Value entry;
    entry["clip"] = model.clip_names[i];
    entry["frames"] = std::int64_t{model.clip_lengths.at(i)};
    list.append(std::move(entry));
  }
  return list;
}

/// Of all textons' segments.
struct LengthRange {
  double mean = 0, shortest = 0, longest = 0;
};
LengthRange length_range(const MotionTexture& model) {
  LengthRange range;
  if (model.instances.empty()) return range;
  Index sum = 0, shortest = model.instances[0].length, longest = 0;
  for (const Instance& instance : model.instances) {
    sum += instance.length;
    shortest = std::min(shortest, instance.length);
    longest = std::max(longest, instance.length);
  }
  const double secs = model.frame_time_secs();
  return {static_cast<double>(sum) * secs / static_cast<double>(model.instances.size()),
          static_cast<double>(shortest) * secs, static_cast<double>(longest) * secs};
}

Index max_state_size(const MotionTexture& model) {
  Index largest = 0;
  for (const Texton& texton : model.textons) largest = std::max(largest, texton.dynamics.state_size());
  return largest;
}

struct Info {
  std::string model_path, audit;
  int audit_page = 0;
  bool list_textons = false, list_parts = false;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn; or a clip, or markers (.c3d, .trc)", model_path);
    arguments.toggle("--textons", "a table of all textons too", list_textons);
    arguments.value("--audit", "PICTURE",
                    "of a model: a row a texton, its segments side by side (.png, .svg); ten textons a page", audit);
    arguments.value("--audit-page", "N", "which ten: 0 = those with most segments (default 0)", audit_page);
    arguments.toggle("--list", "of a clip or markers: a line a joint or marker", list_parts);
  }

  void run(Session& session) {
    if (!audit.empty()) check_output(audit, {".png", ".svg"}, session);
    if (is_motion_file(model_path)) {
      if (!audit.empty()) throw InvalidInput("--audit shows textons; name a model");
      return report_motion_file(model_path, list_parts, session);
    }
    const MotionTexture model = load_motion_texture(model_path);
    if (!audit.empty()) draw_audit(model, session);
    const auto summaries = summarise(model);
    session.result(value(model, summaries), text(model, summaries));
  }

 private:
  void draw_audit(const MotionTexture& model, Session& session) const {
    const Drawing drawing = texton_audit(model, audit_page);
    if (session.flags.dry_run) return;
    write_picture(audit, drawing);
    session.say("wrote " + audit + ", page " + std::to_string(audit_page) + " of 0 … " +
                std::to_string(num_audit_pages(model) - 1));
  }

  Value value(const MotionTexture& model, const std::vector<TextonSummary>& summaries) const {
    const LengthRange lengths = length_range(model);
    Value object;
    object["model"] = model_path;
    object["bytes"] = static_cast<std::int64_t>(std::filesystem::file_size(model_path));
    object["textons"] = static_cast<int>(model.textons.size());
    object["segments"] = static_cast<int>(model.instances.size());
    object["frames"] = std::int64_t{model.corpus.rows()};
    object["frame_rate"] = 1 / model.frame_time_secs();
    object["joints"] = model.features.skeleton.num_joints();
    object["channels"] = std::int64_t{model.features.size()};
    object["state_size"] = std::int64_t{max_state_size(model)};
    object["mean_length_secs"] = lengths.mean;
    object["min_length_secs"] = lengths.shortest;
    object["max_length_secs"] = lengths.longest;
    object["cm_per_unit"] = model.features.cm_per_unit;
    object["outside_deviation_cm"] = model.outside_deviation;
    object["feet"] = static_cast<int>(model.feet.legs.size());
    object["seed"] = model.options.seed;
    object["options"] = options_value(model.options);
    object["clips"] = clips_value(model);
    object["edits"] = edits_value(model);
    object["texton_list"] = textons_value(model, summaries);
    return object;
  }

  std::string text(const MotionTexture& model, const std::vector<TextonSummary>& summaries) const {
    const LengthRange lengths = length_range(model);
    const auto num_textons = std::to_string(model.textons.size());
    const double secs = static_cast<double>(model.corpus.rows()) * model.frame_time_secs();
    const double reuse =
        static_cast<double>(model.instances.size()) / std::max<double>(1, static_cast<double>(model.textons.size()));
    const auto used = std::count_if(summaries.begin(), summaries.end(),
                                    [](const TextonSummary& summary) { return summary.num_instances > 1; });
    std::string out = text_pairs(
        {{"model", model_path},
         {"learned from", std::to_string(model.clip_names.size()) + " clips, " + std::to_string(model.corpus.rows()) +
                              " frames at " + fixed(1 / model.frame_time_secs(), 2) + " Hz (" + fixed(secs, 1) + " s)"},
         {"body", std::to_string(model.features.skeleton.num_joints()) + " joints, " +
                      std::to_string(model.features.size()) + " channels, " + std::to_string(model.feet.legs.size()) +
                      " feet known"},
         {"textons", num_textons + ", " + std::to_string(used) + " of them seen more than once"},
         {"segments", std::to_string(model.instances.size()) + ", " + fixed(reuse, 2) + " a texton, " +
                          fixed(lengths.shortest, 2) + " – " + fixed(lengths.longest, 2) + " s, mean " +
                          fixed(lengths.mean, 2) + " s"},
         {"state", std::to_string(max_state_size(model)) + " dimensions"},
         {"seed", std::to_string(model.options.seed)}});
    for (std::size_t i = 0; i < model.clip_names.size(); ++i)
      out += (i == 0 ? "clips         " : "              ") + model.clip_names[i] + ", " +
             std::to_string(model.clip_lengths.at(i)) + " frames\n";
    for (std::size_t i = 0; i < model.edits.size(); ++i)
      out += (i == 0 ? "edits         " : "              ") + edit_text(model.edits[i]) + "\n";
    return list_textons ? out + "\n" + textons_table(model, summaries) : out;
  }

  static std::string textons_table(const MotionTexture& model, const std::vector<TextonSummary>& summaries) {
    std::vector<std::vector<std::string>> rows{{"texton", "segments", "frames", "mean s", "successors"}};
    for (std::size_t i = 0; i < summaries.size(); ++i)
      rows.push_back({std::to_string(i), std::to_string(summaries[i].num_instances),
                      std::to_string(summaries[i].num_frames), fixed(mean_length_secs(summaries[i], model), 2),
                      std::to_string(summaries[i].num_successors)});
    return text_table(rows);
  }
};

}  // namespace

Command motion_info() {
  return make_command<Info>({"motion info", "what a model, a clip or a file of markers holds", "",
                             "motex motion info dance.motex\n"
                             "motex motion info dance.motex --textons\n"
                             "motex motion info dance.motex --json\n"
                             "motex motion info dance.motex --audit textons.png\n"
                             "motex motion info take3.c3d --list"});
}

}  // namespace motex::cli
