// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "commands.h"
#include "motex/motion_texture/liveliness.h"
#include "motex/project/motion_texture_file.h"
#include "motion_texton.h"
#include "text_table.h"

namespace motex::cli {
namespace {

constexpr std::size_t kMostNext = 3;

/// A texton as a person wants to know it.
struct TextonRow {
  int number = 0;
  double secs = 0;                    ///< of all its examples
  double speed = 0;                   ///< mean of joints, cm/s
  bool is_danced = false;             ///< the endless dance plays it
  std::vector<TransitionCount> next;  ///< likeliest first
};

std::vector<TextonRow> describe(const MotionTexture& model) {
  std::vector<TextonRow> rows(model.textons.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].number = static_cast<int>(i);
    const auto followers = model.transitions.counts_from(static_cast<int>(i));
    rows[i].next.assign(followers.begin(), followers.end());
    std::stable_sort(rows[i].next.begin(), rows[i].next.end(),
                     [](const auto& a, const auto& b) { return a.count > b.count; });
  }
  const std::vector<double> speeds = mean_speeds(model);
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const Instance& x = model.instances[k];
    TextonRow& row = rows[static_cast<std::size_t>(x.texton)];
    const double secs = static_cast<double>(x.length) * model.frame_time_secs();
    row.secs += secs;
    row.speed += secs * speeds[k] / model.frame_time_secs();
  }
  for (TextonRow& row : rows)
    if (row.secs > 0) row.speed /= row.secs;
  for (const int i : danced_textons(model)) rows[static_cast<std::size_t>(i)].is_danced = true;
  return rows;
}

std::string state_of(const MotionTexture& model, const TextonRow& row) {
  const Texton& texton = model.textons[static_cast<std::size_t>(row.number)];
  if (texton.merged_into >= 0) return "merged into " + std::to_string(texton.merged_into);
  if (texton.is_dropped) return "dropped";
  return row.is_danced ? "" : "not reached";
}

struct ListTextons {
  std::string model_path;

  void declare(Arguments& arguments) { arguments.positional("MODEL", "made by motex motion learn", model_path); }

  void run(Session& session) {
    const MotionTexture model = load_motion_texture(model_path);
    const std::vector<TextonRow> rows = describe(model);
    Value object;
    object["model"] = model_path;
    object["textons"] = value(model, rows);
    object["edits"] = edits_value(model);
    session.result(object, text(model, rows));
  }

 private:
  static Value value(const MotionTexture& model, const std::vector<TextonRow>& rows) {
    Value list = Value::List();
    for (const TextonRow& row : rows) {
      const Texton& texton = model.textons[static_cast<std::size_t>(row.number)];
      Value entry;
      entry["texton"] = row.number;
      entry["name"] = texton.name;
      entry["instances"] = static_cast<int>(texton.instances.size());
      entry["secs"] = row.secs;
      entry["mean_speed_cm_per_sec"] = row.speed;
      entry["dropped"] = texton.is_dropped;
      entry["merged_into"] = texton.merged_into < 0 ? Value() : Value(texton.merged_into);
      entry["in_endless_dance"] = row.is_danced;
      entry["next"] = Value::List();
      for (const TransitionCount& c : row.next) {
        Value next;
        next["texton"] = c.to;
        next["probability"] = model.transitions.probability(c.from, c.to);
        entry["next"].append(std::move(next));
      }
      list.append(std::move(entry));
    }
    return list;
  }

  static std::string text(const MotionTexture& model, const std::vector<TextonRow>& rows) {
    std::vector<std::vector<std::string>> table{{"texton", "name", "examples", "secs", "cm/s", "likeliest next", ""}};
    for (const TextonRow& row : rows) {
      const Texton& texton = model.textons[static_cast<std::size_t>(row.number)];
      std::string next;
      for (std::size_t k = 0; k < std::min(kMostNext, row.next.size()); ++k)
        next += (k > 0 ? ", " : "") + texton_label(model, row.next[k].to) + " " +
                fixed(100 * model.transitions.probability(row.number, row.next[k].to), 0) + " %";
      table.push_back({std::to_string(row.number), texton.name, std::to_string(texton.instances.size()),
                       fixed(row.secs, 1), fixed(row.speed, 0), next, state_of(model, row)});
    }
    std::string out = text_table(table);
    for (std::size_t k = 0; k < model.edits.size(); ++k)
      out +=
          (k == 0 ? "\nedits\n" : "") + std::string("  ") + std::to_string(k) + "  " + edit_text(model.edits[k]) + "\n";
    return out;
  }
};

}  // namespace

Command motion_texton_list() {
  return make_command<ListTextons>({"motion texton list", "textons, what they are called, what follows them, and edits",
                                    "cm/s says how lively a texton is: mean speed of the body's joints and root.",
                                    "motex motion texton list dance.motex\n"
                                    "motex motion texton list dance.motex --json"});
}

}  // namespace motex::cli
